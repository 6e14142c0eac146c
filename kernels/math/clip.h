// The part of a triangle in the unit cube, by clipping at its faces (Sutherland and Hodgman, Reentrant Polygon Clipping,
// 1974). The polygon is kept as edges, in any order: a face shortens each of them where it stands and adds one, so that
// every index is a constant once the loops are unrolled, and nothing has to lie in memory.
#define CLIP_EDGES 9

FN float coordinate(vec3 v, int axis) { return axis == 0 ? v.x : (axis == 1 ? v.y : v.z); }

FN vec3 cross_of(vec3 a, vec3 b) {
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

// Its centroid and area. An empty part has area 0 and the centroid of the triangle, moved into the cube.
FN vec4 part_in_cube(vec3 a, vec3 b, vec3 c) {
    const vec3 low = min(a, min(b, c));
    const vec3 high = max(a, max(b, c));
    if (low.x >= 0.0f && low.y >= 0.0f && low.z >= 0.0f && high.x <= 1.0f && high.y <= 1.0f && high.z <= 1.0f) {
        const vec3 u = cross_of(b - a, c - a);
        const vec3 middle = (a + b + c) / 3.0f;
        return vec4(middle.x, middle.y, middle.z, 0.5f * sqrt(u.x * u.x + u.y * u.y + u.z * u.z));
    }
    // An edge that is cut off ends where it begins.
    vec3 begin[CLIP_EDGES];
    vec3 end[CLIP_EDGES];
    begin[0] = a;
    end[0] = b;
    begin[1] = b;
    end[1] = c;
    begin[2] = c;
    end[2] = a;
    int count = 3;
    for (int face = 0; face < 6; ++face) {
        // Inside is at >= 0; at = x - 0 for a lower face, 1 - x for an upper one.
        const int axis = face >> 1;
        const float side = (face & 1) == 0 ? 1.0f : -1.0f;
        const float bound = (face & 1) == 0 ? 0.0f : 1.0f;
        if (bound + side * coordinate((face & 1) == 0 ? low : high, axis) >= 0.0f) continue;
        vec3 left = a;  // where the polygon leaves the cube through this face, and where it enters again
        vec3 entered = a;
        UNROLL for (int e = 0; e < CLIP_EDGES; ++e) {
            if (e < count) {
                const vec3 p = begin[e];
                const vec3 q = end[e];
                const float dp = bound + side * coordinate(p, axis);
                const float dq = bound + side * coordinate(q, axis);
                if (dp < 0.0f && dq < 0.0f) {
                    end[e] = p;
                } else if (dq < 0.0f) {
                    left = p + dp / (dp - dq) * (q - p);
                    end[e] = left;
                } else if (dp < 0.0f) {
                    entered = p + dp / (dp - dq) * (q - p);
                    begin[e] = entered;
                }
            } else if (e == count) {
                begin[e] = left;
                end[e] = entered;
            }
        }
        ++count;
    }
    vec3 origin = a;  // a corner of what is left
    UNROLL for (int e = 0; e < CLIP_EDGES; ++e)
        if (e < count && (begin[e].x != end[e].x || begin[e].y != end[e].y || begin[e].z != end[e].z)) origin = begin[e];
    vec3 twice = vec3(0.0f, 0.0f, 0.0f);
    vec3 moment = vec3(0.0f, 0.0f, 0.0f);
    float weight = 0.0f;
    UNROLL for (int e = 0; e < CLIP_EDGES; ++e) {
        if (e < count) {
            const vec3 u = cross_of(begin[e] - origin, end[e] - origin);
            twice = twice + u;
#if CLIP_CENTROID
            const float area = sqrt(u.x * u.x + u.y * u.y + u.z * u.z);
            moment = moment + area * (begin[e] + end[e] - 2.0f * origin);
            weight = weight + area;
#endif
        }
    }
    vec3 m = clamp((a + b + c) / 3.0f, vec3(0.0f, 0.0f, 0.0f), vec3(1.0f, 1.0f, 1.0f));
    if (weight > 0.0f) m = origin + moment / (3.0f * weight);
    return vec4(m.x, m.y, m.z, 0.5f * sqrt(twice.x * twice.x + twice.y * twice.y + twice.z * twice.z));
}
