// Whether a closed triangle meets a closed box: the separating axes of Akenine-Moeller (Fast 3D Triangle-Box Overlap
// Testing, 2001) in the one-sided form of Schwarz and Seidel (2010), in integers. Vertices in 2^-16 voxel, |v| < 2^29;
// boxes by centre c and half extents h in half voxels, 0 <= c, h < 2^13. A box may be flat, a segment or a point.
//
// A line a x + b y + d >= 0 with d in 2^-32 and boxes at whole half voxels: a x + b y is a multiple of 2^-17 voxel times
// 2^-16, so that d may be rounded down to one without changing any answer. What is left fits two ints.

FN ivec2 projected(ivec3 v, int axis) {
    return axis == 0 ? ivec2(v.y, v.z) : (axis == 1 ? ivec2(v.z, v.x) : ivec2(v.x, v.y));
}
FN int greatest(ivec2 e) { return int(max(magnitude(e.x), magnitude(e.y))); }

// The component of (q - p) x (r - p) along the axis of a projection.
FN uvec2 double_area(ivec2 p, ivec2 q, ivec2 r) {
    return add_64(product_64(q.x - p.x, r.y - p.y), negate_64(product_64(q.y - p.y, r.x - p.x)));
}

// The half plane left of p -> q (sign 1) or right of it (-1), or everywhere (0): a, b, and d in multiples of 2^16 and a
// rest.
FN ivec4 edge_line(ivec2 p, ivec2 q, int sign_) {
    const ivec2 e = sign_ * (q - p);
    const uvec2 d = add_64(product_64(e.y, p.x), negate_64(product_64(e.x, p.y)));
    return ivec4(-e.y, e.x, int((d.y << 1) | (d.x >> 31)), int((d.x >> 15) & 0xffffu));
}

// Half planes 0, 1, 2 of the triangle seen along an axis, `area` its double_area there. Where that is none, the three
// are the two sides of the line that it is seen as, and everything.
FN ivec4 edge_of(ivec2 p, ivec2 q, ivec2 r, uvec2 area, int which) {
    if (!zero_64(area)) {
        const int turn = negative_64(area) ? -1 : 1;
        return which == 0 ? edge_line(p, q, turn) : (which == 1 ? edge_line(q, r, turn) : edge_line(r, p, turn));
    }
    const int side = which == 0 ? 1 : (which == 1 ? -1 : 0);
    const int a = greatest(q - p);
    const int b = greatest(r - q);
    const int c = greatest(p - r);
    return a >= b && a >= c ? edge_line(p, q, side) : (b >= c ? edge_line(q, r, side) : edge_line(r, p, side));
}

// Whether some point of the box (its centre and half extents seen along the same axis) lies in the half plane.
FN bool edge_meets(ivec4 line, ivec2 c, ivec2 h) {
    const int reach_a = line.x < 0 ? -line.x : line.x;
    const int reach_b = line.y < 0 ? -line.y : line.y;
    const int low = (line.x & 0xffff) * c.x + (line.y & 0xffff) * c.y + (reach_a & 0xffff) * h.x +
                    (reach_b & 0xffff) * h.y + line.w;
    const int high = (line.x >> 16) * c.x + (line.y >> 16) * c.y + (reach_a >> 16) * h.x + (reach_b >> 16) * h.y +
                     line.z;
    return high + (low >> 16) >= 0;
}

FN bool edges_meet(ivec4 lines[9], ivec3 c, ivec3 h) {
    bool meets = true;
    UNROLL for (int i = 0; i < 9; ++i) meets = meets && edge_meets(lines[i], projected(c, i / 3), projected(h, i / 3));
    return meets;
}

FN bool span_meets(int low, int high, int c, int h) { return (c - h) * 32768 <= high && (c + h) * 32768 >= low; }
FN bool bounds_meet(ivec3 low, ivec3 high, ivec3 c, ivec3 h) {
    return span_meets(low.x, high.x, c.x, h.x) && span_meets(low.y, high.y, c.y, h.y) &&
           span_meets(low.z, high.z, c.z, h.z);
}

// |n . (c - v)| <= sum |n_i| h_i. n: the triangle's normal, a word pair an axis; d = 2^15 c - v for a vertex v.
FN bool plane_meets_exactly(uvec2 nx, uvec2 ny, uvec2 nz, ivec3 d, ivec3 h) {
    const uvec3 distance = add_96(add_96(product_96(nx, d.x), product_96(ny, d.y)), product_96(nz, d.z));
    const uvec3 reach = add_96(add_96(product_96(magnitude_64(nx), h.x * 32768), product_96(magnitude_64(ny), h.y * 32768)),
                               product_96(magnitude_64(nz), h.z * 32768));
    return !negative_96(add_96(reach, distance)) && !negative_96(add_96(reach, negate_96(distance)));
}

// All of it, for a box that meets the triangle's bounds.
FN bool meets_exactly(ivec3 v0, ivec3 v1, ivec3 v2, ivec3 c, ivec3 h) {
    ivec4 lines[9];
    uvec2 n[3];
    UNROLL for (int axis = 0; axis < 3; ++axis) {
        const ivec2 p = projected(v0, axis);
        const ivec2 q = projected(v1, axis);
        const ivec2 r = projected(v2, axis);
        n[axis] = double_area(p, q, r);
        UNROLL for (int i = 0; i < 3; ++i) lines[3 * axis + i] = edge_of(p, q, r, n[axis], i);
    }
    return edges_meet(lines, c, h) && plane_meets_exactly(n[0], n[1], n[2], c * 32768 - v0, h);
}
