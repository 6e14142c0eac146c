// The share that a GGX surface mirrors of an even environment, per unit of reflectance at normal incidence and beside it: with
// Fresnel's reflectance after Schlick it is F0 A + B (Karis, Real Shading in Unreal Engine 4, 2013, second sum). Columns: cosine
// of the view direction, rows: roughness, at (i + 1/2) / size. Visible normals are sampled, so that a sample's weight is
// the masking of both directions over that of the view's.

// i / count and its radical inverse in base 2, moved to the middle.
// Digit by digit, exact in the 16 digits that there are: masks and shifts become an instruction that not every driver has.
FN vec2 hammersley(int i, int count) {
    float inverse = 0.0f;
    float digit = 0.5f;
    for (int rest = i; rest > 0; rest = rest >> 1) {
        inverse += digit * float(rest & 1);
        digit *= 0.5f;
    }
    return vec2((float(i) + 0.5f) / float(count), inverse + 0.5f / float(count));
}

KERNEL(hiz_ssr_split_sum) {
    const int x = invocation_x();
    const int y = invocation_y();
    if (x >= params.size || y >= params.size) return;
    const float cosine = (float(x) + 0.5f) / float(params.size);
    const float alpha = alpha_of((float(y) + 0.5f) / float(params.size));
    const vec3 v = vec3(sqrt(1.0f - cosine * cosine), 0.0f, cosine);
    vec2 sum = vec2(0.0f, 0.0f);
    for (int i = 0; i < params.samples; ++i) {
        const vec3 h = ggx_normal(v, alpha, hammersley(i, params.samples));
        const float v_h = dot3(v, h);
        const float l_cosine = 2.0f * v_h * h.z - v.z;
        if (l_cosine > 0.0f && v_h > 0.0f) {
            const float weight = ggx_seen_both(cosine, l_cosine, alpha) / ggx_seen(cosine, alpha);
            const float m = 1.0f - v_h;
            const float fresnel = m * m * (m * m) * m;
            sum = sum + vec2((1.0f - fresnel) * weight, fresnel * weight);
        }
    }
    store_pixel(split_sum, params.size, x, y, sum / float(params.samples));
}
