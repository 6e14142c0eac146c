// The tests of triangle_box.h in float, with error bounds: yes, no, or undecided. Points in voxels relative to a corner near
// the boxes, at most `span` from it. Vertices may lie far off; their edges come from the integers, so that every input is
// within 2^-24 of its size, and a sum of products within 2^-21 of the sum of their sizes (bounds: twice that).
// The three half planes of a view are the first three components of vec4s; the fourth is everything (0 >= 0).

FN vec3 voxels_of(ivec3 v) { return vec3(float(v.x), float(v.y), float(v.z)) / 65536.0f; }

// The two coordinates of three points (or edges) that are seen along an axis.
FN vec4 across(vec3 a, vec3 b, vec3 c, int axis) {
    return axis == 0 ? vec4(a.y, b.y, c.y, 0.0f) : (axis == 1 ? vec4(a.z, b.z, c.z, 0.0f) : vec4(a.x, b.x, c.x, 0.0f));
}
FN vec4 upward(vec3 a, vec3 b, vec3 c, int axis) {
    return axis == 0 ? vec4(a.z, b.z, c.z, 0.0f) : (axis == 1 ? vec4(a.x, b.x, c.x, 0.0f) : vec4(a.y, b.y, c.y, 0.0f));
}

// Twice the area of a triangle that is seen with edges (x, y), signed, and a bound of its error.
FN float seen_area(vec4 x, vec4 y) { return x.x * y.y - y.x * x.y; }
FN float seen_slack(vec4 x, vec4 y) { return 4.76837158203125e-7f * (abs(x.x * y.y) + abs(y.x * x.y)); }  // 2^-21

#define VIEW_UNKNOWN 3.0f

// How a triangle with corners (px, py) and edges (ex, ey) from each to the next is seen. x: 1 counter-clockwise, -1
// clockwise, 0 as a line, or nearly so; then y: the edge that stands for it, or VIEW_UNKNOWN; z: how far (an area) the
// third corner may depart from that edge's line. It does not lie beyond the edge's ends.
FN vec4 view_of(vec4 px, vec4 py, vec4 ex, vec4 ey) {
    const float area = seen_area(ex, ey);
    const float slack = seen_slack(ex, ey);
    if (abs(area) > slack) return vec4(area < 0.0f ? -1.0f : 1.0f, 0.0f, 0.0f, 0.0f);
    const vec4 size = abs(ex) + abs(ey);
    const float least_x = min(px.x, min(px.y, px.z));
    const float most_x = max(px.x, max(px.y, px.z));
    const float least_y = min(py.x, min(py.y, py.z));
    const float most_y = max(py.x, max(py.y, py.z));
    float edge = 2.0f;
    vec4 ends = vec4(px.z, py.z, px.x, py.x);
    if (size.x >= size.y && size.x >= size.z) {
        edge = 0.0f;
        ends = vec4(px.x, py.x, px.y, py.y);
    } else if (size.y >= size.z) {
        edge = 1.0f;
        ends = vec4(px.y, py.y, px.z, py.z);
    }
    const bool whole = min(ends.x, ends.z) == least_x && max(ends.x, ends.z) == most_x && min(ends.y, ends.w) == least_y &&
                       max(ends.y, ends.w) == most_y;
    return vec4(0.0f, whole ? edge : VIEW_UNKNOWN, 4.0f * slack, 0.0f);
}

FN float of_edge(vec4 v, float edge) { return edge == 0.0f ? v.x : (edge == 1.0f ? v.y : v.z); }
// An edge of a view, forward and backward. Along an axis it is nothing: there the bounds say all.
FN vec4 both_ways(vec4 v, vec4 other, vec4 view) {
    const float e = of_edge(v, view.y);
    const bool nothing = view.y == VIEW_UNKNOWN || e == 0.0f || of_edge(other, view.y) == 0.0f;
    return nothing ? vec4(0.0f) : vec4(e, -e, 0.0f, 0.0f);
}
FN vec4 twice_of(vec4 v, vec4 view) {
    const float p = of_edge(v, view.y);
    return vec4(p, p, 0.0f, 0.0f);
}

// Half planes a x + b y + d >= 0 of points p and edges e that go counter-clockwise: a = -ey, b = ex, and these.
FN vec4 line_offset(vec4 px, vec4 py, vec4 ex, vec4 ey) { return ey * px - ex * py; }
FN vec4 line_slack(vec4 px, vec4 py, vec4 ex, vec4 ey, float span, vec4 view) {
    if (view.x == 0.0f && view.y == VIEW_UNKNOWN) return vec4(1.0e30f);
    const vec4 s = vec4(span);
    const vec4 slack = 9.5367431640625e-7f * (abs(ey) * (abs(px) + s) + abs(ex) * (abs(py) + s));
    return slack + view.z * vec4(1.0f, 1.0f, 0.0f, 0.0f);
}

// n . x + d of a triangle with a corner p and edges e and f, and the bound of its error: below 0 where the triangle lies
// across an axis, so that its bounds say all.
FN vec4 rough_plane(vec3 p, vec3 e, vec3 f) {
    const vec3 n = vec3(e.y * f.z - e.z * f.y, e.z * f.x - e.x * f.z, e.x * f.y - e.y * f.x);
    return vec4(n.x, n.y, n.z, -(n.x * p.x + n.y * p.y + n.z * p.z));
}
FN float plane_slack(vec3 p, vec3 e, vec3 f, float span) {
    if ((e.x == 0.0f && f.x == 0.0f) || (e.y == 0.0f && f.y == 0.0f) || (e.z == 0.0f && f.z == 0.0f)) return -1.0f;
    const vec3 g = abs(e);
    const vec3 h = abs(f);
    const vec3 n = vec3(g.y * h.z + g.z * h.y, g.z * h.x + g.x * h.z, g.x * h.y + g.y * h.x);  // |plane| and its error
    return 1.9073486328125e-6f * (n.x * (abs(p.x) + span) + n.y * (abs(p.y) + span) + n.z * (abs(p.z) + span));
}

// Declares what meets_roughly() takes of the triangle with corners a, b, c (voxels from a corner near the boxes) and edges
// ab, bc, ca: la, lb, ld, lw, plane and slack.
#define ROUGH_TRIANGLE(span) \
    vec4 la[3]; \
    vec4 lb[3]; \
    vec4 ld[3]; \
    vec4 lw[3]; \
    UNROLL for (int axis = 0; axis < 3; ++axis) { \
        vec4 px = across(a, b, c, axis); \
        vec4 py = upward(a, b, c, axis); \
        vec4 ex = across(ab, bc, ca, axis); \
        vec4 ey = upward(ab, bc, ca, axis); \
        const vec4 view = view_of(px, py, ex, ey); \
        if (view.x == 0.0f) { \
            const vec4 sides = both_ways(ex, ey, view); \
            ey = both_ways(ey, ex, view); \
            ex = sides; \
            px = twice_of(px, view); \
            py = twice_of(py, view); \
        } else { \
            ex = view.x * ex; \
            ey = view.x * ey; \
        } \
        la[axis] = -ey; \
        lb[axis] = ex; \
        ld[axis] = line_offset(px, py, ex, ey); \
        lw[axis] = line_slack(px, py, ex, ey, span, view); \
    } \
    const vec4 plane = rough_plane(a, ab, bc); \
    const float slack = plane_slack(a, ab, bc, span);

#define ROUGH_NO -1
#define ROUGH_YES 1
#define ROUGH_UNDECIDED 0

FN float least_of(vec4 v) { return min(min(v.x, v.y), min(v.z, v.w)); }

// The box round c with half extents h (voxels) against the plane and the half planes of the three views; its bounds are
// taken to meet.
FN int meets_roughly(vec4 a[3], vec4 b[3], vec4 d[3], vec4 slack[3], vec4 plane, float plane_slack_, vec3 c, vec3 h) {
    bool sure = true;
    if (plane_slack_ >= 0.0f) {
        const float reach = abs(plane.x) * h.x + abs(plane.y) * h.y + abs(plane.z) * h.z;
        const float over = abs(plane.x * c.x + plane.y * c.y + plane.z * c.z + plane.w) - reach;
        if (over > plane_slack_) return ROUGH_NO;
        sure = over < -plane_slack_;
    }
    const vec4 x = a[0] * c.y + b[0] * c.z + d[0] + (abs(a[0]) * h.y + abs(b[0]) * h.z);
    const vec4 y = a[1] * c.z + b[1] * c.x + d[1] + (abs(a[1]) * h.z + abs(b[1]) * h.x);
    const vec4 z = a[2] * c.x + b[2] * c.y + d[2] + (abs(a[2]) * h.x + abs(b[2]) * h.y);
    if (least_of(min(min(x + slack[0], y + slack[1]), z + slack[2])) < 0.0f) return ROUGH_NO;
    return sure && least_of(min(min(x - slack[0], y - slack[1]), z - slack[2])) >= 0.0f ? ROUGH_YES : ROUGH_UNDECIDED;
}
