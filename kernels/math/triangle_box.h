// Whether a closed triangle meets a closed box: the separating axes of Akenine-Moeller (Fast 3D Triangle-Box Overlap
// Testing, 2001) in the one-sided form of Schwarz and Seidel (2010), in integers. Vertices in 2^-16 voxel, |v| < 2^29;
// boxes by centre c and half extents h in half voxels, 0 <= c, h < 2^13. A box may be flat, a segment or a point.
//
// A line a x + b y + d >= 0 with d in 2^-32 and boxes at whole half voxels: a x + b y is a multiple of 2^-17 voxel times
// 2^-16, so that d may be rounded down to one without changing any answer. What is left fits two ints.

FN ivec2 projected(ivec3 v, int axis) {
    return axis == 0 ? ivec2(v.y, v.z) : (axis == 1 ? ivec2(v.z, v.x) : ivec2(v.x, v.y));
}
FN int along(ivec3 v, int axis) { return axis == 0 ? v.x : (axis == 1 ? v.y : v.z); }
FN int greatest(ivec2 e) { return int(max(magnitude(e.x), magnitude(e.y))); }

// The component of (q - p) x (r - p) along the axis of a projection.
FN uvec2 double_area(ivec2 p, ivec2 q, ivec2 r) {
    return add_64(product_64(q.x - p.x, r.y - p.y), negate_64(product_64(q.y - p.y, r.x - p.x)));
}

// The half plane left of p -> q (sign 1) or right of it (-1), or everywhere (0): a, b, and d / 2^15 as a multiple of
// 2^16 and a rest of up to 17 bits.
FN ivec4 edge_line(ivec2 p, ivec2 q, int sign_) {
    const ivec2 e = sign_ * (q - p);
    const uvec2 d = add_64(product_64(e.y, p.x), negate_64(product_64(e.x, p.y)));
    return ivec4(-e.y, e.x, 2 * int(d.y), int(d.x >> 15));
}

// Half planes 0, 1, 2 of the triangle seen along an axis, `area` its double_area there. Where that is none, the three
// are the two sides of the line that it is seen as, and everything.
FN ivec4 edge_of(ivec2 p, ivec2 q, ivec2 r, uvec2 area, int which) {
    int edge = which;
    int sign_ = negative_64(area) ? -1 : 1;
    if (zero_64(area)) {
        const int a = greatest(q - p);
        const int b = greatest(r - q);
        const int c = greatest(p - r);
        edge = a >= b && a >= c ? 0 : (b >= c ? 1 : 2);
        sign_ = 1 - which;
    }
    return edge_line(edge == 0 ? p : (edge == 1 ? q : r), edge == 0 ? q : (edge == 1 ? r : p), sign_);
}

// Whether some point of the box (its centre and half extents seen along the same axis) lies in the half plane.
FN bool edge_meets(ivec4 line, ivec2 c, ivec2 h) {
    const int reach_a = int(magnitude(line.x));
    const int reach_b = int(magnitude(line.y));
    const int low = (line.x & 0xffff) * c.x + (line.y & 0xffff) * c.y + (reach_a & 0xffff) * h.x +
                    (reach_b & 0xffff) * h.y + line.w;
    const int high = (line.x >> 16) * c.x + (line.y >> 16) * c.y + (reach_a >> 16) * h.x + (reach_b >> 16) * h.y +
                     line.z;
    return high + (low >> 16) >= 0;
}

FN bool span_meets(int low, int high, int c, int h) { return (c - h) * 32768 <= high && (c + h) * 32768 >= low; }
FN bool bounds_meet(ivec3 low, ivec3 high, ivec3 c, ivec3 h) {
    return span_meets(low.x, high.x, c.x, h.x) && span_meets(low.y, high.y, c.y, h.y) &&
           span_meets(low.z, high.z, c.z, h.z);
}

// |n . (c - v0)| <= sum |n_i| h_i for the triangle's normal n.
FN bool plane_meets_exactly(ivec3 v0, ivec3 v1, ivec3 v2, ivec3 c, ivec3 h) {
    uvec3 distance = uvec3(0u, 0u, 0u);
    uvec3 reach = uvec3(0u, 0u, 0u);
    for (int axis = 0; axis < 3; ++axis) {
        const uvec2 n = double_area(projected(v0, axis), projected(v1, axis), projected(v2, axis));
        distance = add_96(distance, product_96(n, along(c, axis) * 32768 - along(v0, axis)));
        reach = add_96(reach, product_96(magnitude_64(n), along(h, axis) * 32768));
    }
    return !negative_96(add_96(reach, distance)) && !negative_96(add_96(reach, negate_96(distance)));
}

// All of it, for a box that meets the triangle's bounds.
FN bool meets_exactly(ivec3 v0, ivec3 v1, ivec3 v2, ivec3 c, ivec3 h) {
    bool meets = true;
    for (int i = 0; i < 9 && meets; ++i) {
        const ivec2 p = projected(v0, i / 3);
        const ivec2 q = projected(v1, i / 3);
        const ivec2 r = projected(v2, i / 3);
        meets = edge_meets(edge_of(p, q, r, double_area(p, q, r), i % 3), projected(c, i / 3), projected(h, i / 3));
    }
    return meets && plane_meets_exactly(v0, v1, v2, c, h);
}
