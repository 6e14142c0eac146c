// The part of a triangle in the unit cube, by clipping at its faces (Sutherland and Hodgman, Reentrant Polygon Clipping,
// 1974).
#define CLIP_VERTICES 12  // nine, and a few that rounding may make of a polygon that is no longer quite convex

FN float coordinate(vec3 v, int axis) { return axis == 0 ? v.x : (axis == 1 ? v.y : v.z); }

FN vec3 cross_of(vec3 a, vec3 b) {
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

// Its centroid and area. An empty part has area 0 and the centroid of the triangle, moved into the cube.
FN vec4 part_in_cube(vec3 a, vec3 b, vec3 c) {
    vec3 points[CLIP_VERTICES];
    vec3 clipped[CLIP_VERTICES];
    const vec3 low = min(a, min(b, c));
    const vec3 high = max(a, max(b, c));
    if (low.x >= 0.0f && low.y >= 0.0f && low.z >= 0.0f && high.x <= 1.0f && high.y <= 1.0f && high.z <= 1.0f) {
        const vec3 u = cross_of(b - a, c - a);
        const vec3 middle = (a + b + c) / 3.0f;
        return vec4(middle.x, middle.y, middle.z, 0.5f * sqrt(u.x * u.x + u.y * u.y + u.z * u.z));
    }
    points[0] = a;
    points[1] = b;
    points[2] = c;
    int count = 3;
    for (int face = 0; face < 6; ++face) {
        // Inside is at >= 0; at = x - 0 for a lower face, 1 - x for an upper one.
        const int axis = face >> 1;
        const float side = (face & 1) == 0 ? 1.0f : -1.0f;
        const float bound = (face & 1) == 0 ? 0.0f : 1.0f;
        if (count == 0 || bound + side * coordinate((face & 1) == 0 ? low : high, axis) >= 0.0f) continue;
        int kept = 0;
        vec3 p = points[count - 1];
        float dp = bound + side * coordinate(p, axis);
        for (int i = 0; i < count; ++i) {
            const vec3 q = points[i];
            const float dq = bound + side * coordinate(q, axis);
            if ((dp >= 0.0f) != (dq >= 0.0f) && kept < CLIP_VERTICES) clipped[kept++] = p + dp / (dp - dq) * (q - p);
            if (dq >= 0.0f && kept < CLIP_VERTICES) clipped[kept++] = q;
            p = q;
            dp = dq;
        }
        count = kept;
        for (int i = 0; i < count; ++i) points[i] = clipped[i];
    }
    vec3 twice = vec3(0.0f, 0.0f, 0.0f);
    vec3 moment = vec3(0.0f, 0.0f, 0.0f);
    float weight = 0.0f;
    for (int i = 2; i < count; ++i) {
        const vec3 u = cross_of(points[i - 1] - points[0], points[i] - points[0]);
        twice = twice + u;
#if CLIP_CENTROID
        const float area = sqrt(u.x * u.x + u.y * u.y + u.z * u.z);
        moment = moment + area * (points[i - 1] + points[i] - 2.0f * points[0]);
        weight = weight + area;
#endif
    }
    vec3 m = clamp((a + b + c) / 3.0f, vec3(0.0f, 0.0f, 0.0f), vec3(1.0f, 1.0f, 1.0f));
    if (weight > 0.0f) m = points[0] + moment / (3.0f * weight);
    return vec4(m.x, m.y, m.z, 0.5f * sqrt(twice.x * twice.x + twice.y * twice.y + twice.z * twice.z));
}
