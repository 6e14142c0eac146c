// The part of a triangle in the unit cube, by clipping at its six faces (Sutherland and Hodgman 1974).
#define CLIP_VERTICES 12  // nine, and a few that rounding may make of a polygon that is no longer quite convex

FN float coordinate(vec3 v, int axis) { return axis == 0 ? v.x : (axis == 1 ? v.y : v.z); }

FN vec3 cross_of(vec3 a, vec3 b) {
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

// Its centroid and area. An empty part has area 0 and the centroid of the triangle, moved into the cube.
FN vec4 part_in_cube(vec3 a, vec3 b, vec3 c) {
    vec3 from[CLIP_VERTICES];
    vec3 to[CLIP_VERTICES];
    from[0] = a;
    from[1] = b;
    from[2] = c;
    int count = 3;
    for (int face = 0; face < 6; ++face) {
        const int axis = face >> 1;
        const float side = (face & 1) == 0 ? 1.0f : -1.0f;  // the lower face keeps what is above
        const float bound = (face & 1) == 0 ? 0.0f : -1.0f;
        bool crosses = false;
        for (int i = 0; i < count; ++i) crosses = crosses || side * coordinate(from[i], axis) < bound;
        if (!crosses) continue;
        int kept = 0;
        for (int i = 0; i < count; ++i) {
            const vec3 p = from[i];
            const vec3 q = from[i + 1 < count ? i + 1 : 0];
            const float dp = side * coordinate(p, axis) - bound;
            const float dq = side * coordinate(q, axis) - bound;
            if (dp >= 0.0f && kept < CLIP_VERTICES) to[kept++] = p;
            if ((dp >= 0.0f) != (dq >= 0.0f) && kept < CLIP_VERTICES) to[kept++] = p + dp / (dp - dq) * (q - p);
        }
        count = kept;
        for (int i = 0; i < count; ++i) from[i] = to[i];
    }
    vec3 twice = vec3(0.0f, 0.0f, 0.0f);
    vec3 moment = vec3(0.0f, 0.0f, 0.0f);
    float weight = 0.0f;
    for (int i = 2; i < count; ++i) {
        const vec3 u = cross_of(from[i - 1] - from[0], from[i] - from[0]);
        const float area = sqrt(u.x * u.x + u.y * u.y + u.z * u.z);
        moment = moment + area * (from[i - 1] + from[i] - 2.0f * from[0]);
        weight = weight + area;
        twice = twice + u;
    }
    vec3 m = clamp((a + b + c) / 3.0f, vec3(0.0f, 0.0f, 0.0f), vec3(1.0f, 1.0f, 1.0f));
    if (weight > 0.0f) m = from[0] + moment / (3.0f * weight);
    return vec4(m.x, m.y, m.z, 0.5f * sqrt(twice.x * twice.x + twice.y * twice.y + twice.z * twice.z));
}
