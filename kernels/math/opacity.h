// Premultiplied colour and opacity. Only + - * / and bits: the same result on every device.

// A fully transparent voxel whose colour is NaN or infinite has none; a finite colour without opacity is emission.
#if CHANNELS == 4
FN bool colour_is_finite(pixel v) {
    vec4 zero = v - v;  // or NaN
    return zero.x + zero.y + zero.z == 0.0f;
}
FN pixel drop_hidden_colour(pixel v) { return v.w == 0.0f && !colour_is_finite(v) ? vec4(0.0f) : v; }
#else
FN bool colour_is_finite(pixel v) { return v - v == 0.0f; }
FN pixel drop_hidden_colour(pixel v) { return v; }
#endif

// What lies behind opacity 1 does not matter, whatever it is.
FN vec4 composite(vec4 front, vec4 back) { return front.w >= 1.0f ? front : front + (1.0f - front.w) * back; }

// ln(1 - a) for 0 <= a < 1, relative error 1e-7 in float, 1e-10 in double: 1 - a = 2^k r, r in [sqrt(1/2), sqrt(2)),
// ln r = 2 atanh((r - 1) / (r + 1)).
FN float log_transmittance(float a) {
    float z = a / (a - 2.0f);
    int k = 0;
    if (a > 0.25f) {
        k = (int(floatBitsToUint(1.0f - a)) - 0x3f3504f3) >> 23;
        float r = (1.0f - a) * uintBitsToFloat(uint(127 - k) << 23);
        z = (r - 1.0f) / (r + 1.0f);
    }
    float q = z * z;
    float series = 0.142857142857f + q * (0.111111111111f + q * 0.090909090909f);
    series = 1.0f + q * (0.333333333333f + q * (0.2f + q * series));
    return float(k) * 0.693147180559945f + 2.0f * z * series;
}

// 1 - e^x for -64 <= x <= 0: e^x = 2^j e^t with |t| <= ln(2)/2.
FN float one_minus_exp(float x) {
    int j = int(x * 1.44269504088896f - 0.5f);
    float t = x - float(j) * 0.693147180559945f;
    float p = 1.0f / 40320.0f + t * (1.0f / 362880.0f);
    p = 1.0f / 720.0f + t * (1.0f / 5040.0f + t * p);
    p = 1.0f / 24.0f + t * (1.0f / 120.0f + t * p);
    p = t * (1.0f + t * (0.5f + t * (1.0f / 6.0f + t * p)));
    return j == 0 ? -p : 1.0f - uintBitsToFloat(uint(127 + j) << 23) * (1.0f + p);
}

// (1 - (1-a)^f) / a, what colour and opacity of a layer are multiplied by when only the part f of its thickness is
// crossed: f at a = 0, 1 at a = 1.
FN float layer_part(float a, float f) {
    if (f >= 1.0f || a >= 1.0f) return 1.0f;
    if (a < 1.0e-20f) return f;
    return one_minus_exp(f * log_transmittance(a)) / a;
}
