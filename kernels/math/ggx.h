// The GGX lobe (Walter et al., Microfacet Models for Refraction through Rough Surfaces, 2007) and its sampling. alpha is
// roughness^2; needs math/vector.h.

// Below this width lobes are sampled and weighed as this wide: f32 does not tell their directions apart.
#define NARROWEST 0.001f
FN float alpha_of(float roughness) {
    const float r = clamp(roughness, 0.0f, 1.0f);
    return max(r * r, NARROWEST);
}

// Integer hash (PCG; Jarzynski and Olano, Hash Functions for GPU Rendering, 2020), and [0, 1) in steps of 2^-24.
FN uint hashed(uint v) {
    const uint state = v * 747796405u + 2891336453u;
    const uint word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}
FN float fraction_of(uint h) { return float(int(h >> 8)) * 5.9604644775390625e-8f; }

// Cosine and sine of 2 pi u for 0 <= u <= 1, within 3e-7: the quarter, then series on [-pi/4, pi/4].
FN vec2 circle(float u) {
    const float q = 4.0f * u;
    const float k = floor(q + 0.5f);
    const float x = (q - k) * 1.5707963267948966f;
    const float y = x * x;
    const float s = x * (1.0f + y * (-0.166666666667f + y * (0.00833333333333f + y * (-0.000198412698413f + y * 2.75573192e-6f))));
    const float c = 1.0f + y * (-0.5f + y * (0.0416666666667f + y * (-0.00138888888889f + y * (0.0000248015873f - y * 2.7557319e-7f))));
    const int quarter = int(k) & 3;
    if (quarter == 0) return vec2(c, s);
    if (quarter == 1) return vec2(-s, c);
    if (quarter == 2) return vec2(-c, -s);
    return vec2(s, -c);
}

// D: density of normals; sine2 = 1 - cosine^2 of the angle to the surface's normal, given apart as it cancels.
FN float ggx_density(float cosine, float sine2, float alpha) {
    const float a2 = alpha * alpha;
    const float k = a2 * cosine * cosine + sine2;
    return a2 / (3.14159265358979f * k * k);
}
// Smith's masking of one direction, and the height-correlated masking of two (Heitz 2014).
FN float ggx_lambda2(float cosine, float alpha) {  // 1 + 2 lambda
    const float c2 = cosine * cosine;
    return sqrt(c2 + alpha * alpha * (1.0f - c2)) / cosine;
}
FN float ggx_seen(float cosine, float alpha) { return 2.0f / (1.0f + ggx_lambda2(cosine, alpha)); }
FN float ggx_seen_both(float a, float b, float alpha) { return 2.0f / (ggx_lambda2(a, alpha) + ggx_lambda2(b, alpha)); }

// A normal of the lobe as seen from v (unit, z along the surface's normal, z > 0), by two numbers of [0, 1): Dupuy and
// Benyoub, Sampling Visible GGX Normals with Spherical Caps, 2023.
FN vec3 ggx_normal(vec3 v, float alpha, vec2 u) {
    const vec3 w = unit(vec3(alpha * v.x, alpha * v.y, v.z));
    const float z = (1.0f - u.y) * (1.0f + w.z) - w.z;
    const float r = sqrt(max(1.0f - z * z, 0.0f));
    const vec2 c = circle(u.x);
    return unit(vec3(alpha * (r * c.x + w.x), alpha * (r * c.y + w.y), max(z + w.z, 0.0f)));
}

// Density, per steradian, of directions that ggx_normal mirrors v into.
FN float ggx_pdf(float v_cosine, float density, float alpha) { return ggx_seen(v_cosine, alpha) * density / (4.0f * v_cosine); }

// Two unit vectors that make a right-handed frame with the unit vector n (Duff et al., Building an Orthonormal Basis,
// Revisited, 2017): the first; the second is n x first.
FN vec3 tangent_to(vec3 n) {
    const float s = n.z >= 0.0f ? 1.0f : -1.0f;
    const float a = -1.0f / (s + n.z);
    return vec3(1.0f + s * n.x * n.x * a, s * n.x * n.y * a, -s * n.x);
}
