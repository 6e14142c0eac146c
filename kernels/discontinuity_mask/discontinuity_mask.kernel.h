// Whether surfaces end between a pixel and its neighbours: bit 0 right, 1 below, 2 left, 3 above. Between p and q they do
// where neither side's plane, carried on (1/z is linear on a plane), meets the other's depth within depth_threshold of it, or
// where normals turn by more than normal_threshold. Symmetric: both pixels hold the same verdict of the edge between them.

// 1/z; 0 for sky; NaN where there is no depth.
FN float inverse_at(CTX, int x, int y) {
    const float z = load(depth, y * params.width + x);
    return z >= 1.0e10f ? 0.0f : z > 0.0f ? 1.0f / z : uintBitsToFloat(0x7fc00000u);
}

// How far the plane through b and a lies off c, the three in a row; 1e30 where one of them is no surface.
FN float off_plane(float a, float b, float c) { return a > 0.0f && b > 0.0f && c > 0.0f ? abs((c - b) - (b - a)) : 1.0e30f; }

#if NORMALS == 1
FN vec3 normal_at(CTX, int x, int y) {
    const vec4 v = load_pixel(normals, params.width, x, y);
    return vec3(params.scale * v.x + params.offset, params.scale * v.y + params.offset, params.scale * v.z + params.offset);
}
#endif

FN bool ends(CTX, int x, int y, int dx, int dy) {
    const int qx = x + dx;
    const int qy = y + dy;
    if (qx < 0 || qy < 0 || qx >= params.width || qy >= params.height) return true;
    const float p = inverse_at(ctx, x, y);
    const float q = inverse_at(ctx, qx, qy);
    if (p == 0.0f && q == 0.0f) return false;
    if (!(p > 0.0f && q > 0.0f)) return true;
    const int bx = x - dx;
    const int by = y - dy;
    const int ax = qx + dx;
    const int ay = qy + dy;
    float off = abs(p - q);
    if (bx >= 0 && by >= 0 && bx < params.width && by < params.height)
        off = min(off, off_plane(inverse_at(ctx, bx, by), p, q));
    if (ax >= 0 && ay >= 0 && ax < params.width && ay < params.height)
        off = min(off, off_plane(inverse_at(ctx, ax, ay), q, p));
    // Parts of the nearer depth: |1/p - 1/q| over the larger of them.
    if (!(off <= params.depth_threshold * max(p, q))) return true;
#if NORMALS == 1
    const vec3 n = normal_at(ctx, x, y);
    const vec3 m = normal_at(ctx, qx, qy);
    if (!(n.x * m.x + n.y * m.y + n.z * m.z >= params.normal_threshold)) return true;
#endif
    return false;
}

KERNEL(discontinuity_mask) {
    const int x = invocation_x();
    const int y = invocation_y();
    if (x >= params.width || y >= params.height) return;
    uint bits = 0u;
    if (ends(ctx, x, y, 1, 0)) bits = bits | 1u;
    if (ends(ctx, x, y, 0, 1)) bits = bits | 2u;
    if (ends(ctx, x, y, -1, 0)) bits = bits | 4u;
    if (ends(ctx, x, y, 0, -1)) bits = bits | 8u;
    store(mask, y * params.width + x, bits);
}
