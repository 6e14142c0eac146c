// What premultiplied colour and opacity of a voxel are multiplied by where k times its reference length is crossed:
// s = (1 - (1-a)^k) / a; k at a = 0, 1 at a = 1. Emission and absorption along a path of constant extinction (Max 1995).
// By log(1-a) and 1 - e^x: the power itself, in floats, is wrong by 138 % at a = 1e-7. Needs math/opacity.h.
FN float extinction_part(float a, float k) {
    if (!(a >= 1.0e-20f)) return k;
    if (a >= 1.0f) return 1.0f / a;
    float x = k * log_transmittance(a);
    return one_minus_exp(x > -64.0f ? x : -64.0f) / a;
}
