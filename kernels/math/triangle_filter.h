// The tests of triangle_box.h in float, with error bounds: yes, no, or undecided. Points in voxels relative to a corner near
// the boxes, |x| < `span` for all of these. Vertices may lie far off; their edges come from the integers, so that every
// input is within 2^-24 of its size, and a sum of products within 2^-21 of the sum of their sizes (bounds: twice that).

FN vec3 voxels_of(ivec3 v) { return vec3(float(v.x), float(v.y), float(v.z)) / 65536.0f; }

FN vec2 seen_along(vec3 v, int axis) {
    return axis == 0 ? vec2(v.y, v.z) : (axis == 1 ? vec2(v.z, v.x) : vec2(v.x, v.y));
}

FN float rough_area(vec2 e, vec2 f) { return e.x * f.y - e.y * f.x; }
FN float area_slack(vec2 e, vec2 f) { return 4.76837158203125e-7f * (abs(e.x * f.y) + abs(e.y * f.x)); }  // 2^-21

// The half plane left of p + t e (sign_ 1) or right of it: a x + b y + d >= 0, and the bound of its error.
FN vec4 rough_line(vec2 p, vec2 e, float sign_, float span) {
    const float slack = 9.5367431640625e-7f * (abs(e.y) * (abs(p.x) + span) + abs(e.x) * (abs(p.y) + span));
    return vec4(-sign_ * e.y, sign_ * e.x, sign_ * (e.y * p.x - e.x * p.y), slack);
}

FN bool between(vec2 v, vec2 p, vec2 q) {
    return min(p.x, q.x) <= v.x && v.x <= max(p.x, q.x) && min(p.y, q.y) <= v.y && v.y <= max(p.y, q.y);
}

// Both sides of the edge p + t e of a triangle that is seen as a line, or nearly so: it departs from it by `thick` at most
// (an area), and its third corner r not beyond the edge's ends. The third half plane is everything.
FN vec4 rough_side(vec2 p, vec2 q, vec2 r, vec2 e, float thick, float span, int which) {
    if (!between(r, p, q)) return vec4(0.0f, 0.0f, 0.0f, 1.0e30f);
    // Along an axis: the bounds say all.
    if (which == 2 || e.x == 0.0f || e.y == 0.0f) return vec4(0.0f, 0.0f, 1.0f, 0.0f);
    const vec4 line = rough_line(p, e, which == 0 ? 1.0f : -1.0f, span);
    return vec4(line.x, line.y, line.z, line.w + thick);
}

// Half planes 0, 1, 2 of the triangle p, q, r with edges e, f, g, seen along an axis.
FN vec4 rough_edge(vec2 p, vec2 q, vec2 r, vec2 e, vec2 f, vec2 g, float span, int which) {
    const float area = rough_area(e, f);
    const float slack = area_slack(e, f);
    if (abs(area) > slack) {
        const float turn = area < 0.0f ? -1.0f : 1.0f;
        return which == 0 ? rough_line(p, e, turn, span)
                          : (which == 1 ? rough_line(q, f, turn, span) : rough_line(r, g, turn, span));
    }
    const float a = abs(e.x) + abs(e.y);
    const float b = abs(f.x) + abs(f.y);
    const float c = abs(g.x) + abs(g.y);
    if (a >= b && a >= c) return rough_side(p, q, r, e, 4.0f * slack, span, which);
    if (b >= c) return rough_side(q, r, p, f, 4.0f * slack, span, which);
    return rough_side(r, p, q, g, 4.0f * slack, span, which);
}

// n . x + d of a triangle with a corner p and edges e and f, and the bound of its error: below 0 where the triangle lies
// across an axis, so that its bounds say all.
FN vec4 rough_plane(vec3 p, vec3 e, vec3 f) {
    const vec3 n = vec3(rough_area(seen_along(e, 0), seen_along(f, 0)), rough_area(seen_along(e, 1), seen_along(f, 1)),
                        rough_area(seen_along(e, 2), seen_along(f, 2)));
    return vec4(n.x, n.y, n.z, -(n.x * p.x + n.y * p.y + n.z * p.z));
}
FN float plane_slack(vec3 p, vec3 e, vec3 f, vec4 plane, float span) {
    if ((e.x == 0.0f && f.x == 0.0f) || (e.y == 0.0f && f.y == 0.0f) || (e.z == 0.0f && f.z == 0.0f)) return -1.0f;
    const vec3 slack = vec3(area_slack(seen_along(e, 0), seen_along(f, 0)), area_slack(seen_along(e, 1), seen_along(f, 1)),
                            area_slack(seen_along(e, 2), seen_along(f, 2)));
    return (2.0f * slack.x + 9.5367431640625e-7f * abs(plane.x)) * (abs(p.x) + span) +
           (2.0f * slack.y + 9.5367431640625e-7f * abs(plane.y)) * (abs(p.y) + span) +
           (2.0f * slack.z + 9.5367431640625e-7f * abs(plane.z)) * (abs(p.z) + span);
}

#define ROUGH_NO -1
#define ROUGH_YES 1
#define ROUGH_UNDECIDED 0

// The box round c with half extents h (voxels) against the half planes and the plane; its bounds are taken to meet.
FN int meets_roughly(vec4 lines[9], vec4 plane, float slack, vec3 c, vec3 h) {
    bool sure = true;
    if (slack >= 0.0f) {
        const float reach = abs(plane.x) * h.x + abs(plane.y) * h.y + abs(plane.z) * h.z;
        const float over = abs(plane.x * c.x + plane.y * c.y + plane.z * c.z + plane.w) - reach;
        if (over > slack) return ROUGH_NO;
        sure = over < -slack;
    }
    UNROLL for (int i = 0; i < 9; ++i) {
        const vec2 p = seen_along(c, i / 3);
        const vec2 r = seen_along(h, i / 3);
        const float v = lines[i].x * p.x + lines[i].y * p.y + lines[i].z + abs(lines[i].x) * r.x + abs(lines[i].y) * r.y;
        if (v < -lines[i].w) return ROUGH_NO;
        sure = sure && v > lines[i].w;
    }
    return sure ? ROUGH_YES : ROUGH_UNDECIDED;
}
