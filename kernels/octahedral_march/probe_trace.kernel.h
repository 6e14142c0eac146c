// Rays marched through octahedral maps of radial distance (McGuire et al. 2017, section 4). About a probe a ray splits where
// it crosses the planes x = 0, y = 0, z = 0; a piece lies in one octant, where with L = |x| + |y| + |z|, linear in t,
//     q = p / L (a point of the octahedron),   w = 1 / L,   t w
// are projective in t, and so linear in one parameter s along the piece, as the map's coordinates are: a straight line.
// r < D is |q(s)| < D w(s), without a division; t = (t w)(s) / w(s).

// Outcomes (include/luxel/probe_trace.h).
#define HIT 1
#define MISS 2
#define UNKNOWN 3
#define CAPPED 4
#define DEGENERATE 5
#define ASSUMED 6
#define RAYS_COUNTED 7
#define PROBES_ASKED 8
#define STEPS 9
#define ENDLESS 1.0e30f
#define NO_TEXEL 0xffffffffu

FN float distance_at(CTX, int i) {
#if F16
    return probe_distance_f16(load(distances, i >> 1), i, params.unit_length);
#else
    return load(distances, i);
#endif
}

FN float least_at(CTX, int i) {
#if F16
    return probe_distance_f16(load(minimum, i >> 1), i, params.unit_length);
#else
    return load(minimum, i);
#endif
}

FN float side_of(float v) { return v < 0.0f ? -1.0f : 1.0f; }
// Where along the ray a coordinate becomes 0; -1: nowhere ahead.
FN float crossing(float o, float d) { return abs(d) > 1.0e-30f ? -o / d : -1.0f; }
// On which side of an axis plane the ray is after t.
FN float side_after(float t, float crossed, float o, float d) {
    return abs(d) > 1.0e-30f ? (crossed > t ? -side_of(d) : side_of(d)) : side_of(o);
}
// A coordinate at t, towards its side; exactly 0 where its plane is crossed.
FN float at_side(float t, float crossed, float side, float o, float d) {
    return t == crossed ? 0.0f : max(side * (t < ENDLESS ? o + t * d : d), 0.0f);
}

// The octahedron's point (first octant) and w, at t. At the probe itself it is where the ray is heading or comes from.
FN vec4 on_octahedron(float t, vec3 crossed, vec3 side, vec3 o, vec3 d) {
    const vec3 p = vec3(at_side(t, crossed.x, side.x, o.x, d.x), at_side(t, crossed.y, side.y, o.y, d.y),
                        at_side(t, crossed.z, side.z, o.z, d.z));
    const float sum = p.x + p.y + p.z;
    if (sum > 1.0e-20f) return vec4(p.x / sum, p.y / sum, p.z / sum, t < ENDLESS ? 1.0f / sum : 0.0f);
    const float along = abs(d.x) + abs(d.y) + abs(d.z);
    return vec4(abs(d.x) / along, abs(d.y) / along, abs(d.z) / along, 1.0e20f);
}

// Of such a point, in the map, texels.
FN vec2 map_place(vec4 q, vec3 side, float half_size) {
    const float u = side.z < 0.0f ? 1.0f - q.y : q.x;
    const float v = side.z < 0.0f ? 1.0f - q.x : q.y;
    return vec2((side.x * u + 1.0f) * half_size, (side.y * v + 1.0f) * half_size);
}

// Footprint of a texel at distance 1: the side of a square of its solid angle, (2 / size) / |q|^1.5.
FN float footprint(vec3 q, int size) {
    const float squared = dot3(q, q);
    return 2.0f / (float(size) * sqrt(squared * sqrt(squared)));
}

// Where the ray leaves the ball of this radius about the probe; where it is nearest to the probe if it never is inside.
FN float at_radius(float r, vec3 o, vec3 d) {
    const vec3 moment = cross3(o, d);
    const float inside = max(r, 0.0f);
    return sqrt(max(inside * inside - dot3(moment, moment), 0.0f)) - dot3(o, d);
}

// What a texel that the ray is not in front of means: outcome (0: go on) and where. q: its centre; o, d: about the probe;
// r: distance from the probe.
#if NORMALS
FN vec2 meet(CTX, int texel, vec3 q, float far, vec3 o, vec3 d, float t_in, float t_out, float r_in, float start) {
    const vec3 towards = q / sqrt(dot3(q, q));
    const uint word = load(normals, BITS == 8 ? texel >> 1 : texel);
    const vec3 n = direction_value(BITS == 8 ? bits_of_texel(word, texel) : word, BITS);
    const float facing = min(max(-dot3(n, towards), 0.0f), 1.0f);
    const float rise = sqrt(max(1.0f - facing * facing, 0.0f));
    const float steepness = rise < params.slope * facing ? rise / facing : params.slope;
    const float foot = far * footprint(q, params.size);
    const float depth = params.thickness * foot;
    // Behind the surface: farther than it reaches in this texel, or below its plane by more than the plane's own step from
    // texel to texel, which is the most that a ray can be and have been in front of the texel before; or below it
    // where the ray begins, for then it never met it.
    const float approach = dot3(n, d);
    const float above = dot3(n, o) - far * dot3(n, towards);
    const float span = depth + foot * steepness;
    if (!(r_in <= far + span)) return vec2(float(UNKNOWN), t_in);
    if (approach >= 0.0f || t_out <= start) return vec2(0.0f, 0.0f);  // a back, or too near to where the ray begins
    if (above + start * approach < 0.0f || above + t_in * approach < -depth * (0.25f + rise)) return vec2(float(UNKNOWN), t_in);
    if (t_out < ENDLESS && above + t_out * approach > 0.0f) return vec2(0.0f, 0.0f);  // the plane is not reached in the texel
    // Where the plane is met; not far from the texel's part of the ray, nor from the distance that it saw.
    const float slack = min(t_out, ENDLESS) - t_in;
    const float t = clamp(above / -approach, max(t_in - slack, start), t_out + slack);
    return vec2(float(HIT), clamp(t, min(t_in, at_radius(far - span, o, d)), max(t_in, at_radius(far + span, o, d))));
}
#else
FN vec2 meet(CTX, vec3 q, float far, vec3 o, vec3 d, float t_in, float t_out, float r_in, float r_out, float start) {
    const float depth = params.thickness * (far * footprint(q, params.size));
    if (!(r_in <= far + depth)) return vec2(float(UNKNOWN), t_in);
    if ((r_in > far && r_out < far) || t_out <= start) return vec2(0.0f, 0.0f);
    return vec2(float(HIT), r_in > far ? t_in : clamp(at_radius(far, o, d), t_in, t_out));
}
#endif

// On into the texel behind the one that is left at s_out; into another cell the look is a coarse one.
#define ADVANCE \
    s = s_out; \
    w = w_out; \
    q = q_out; \
    const int from_x = x; \
    const int from_y = y; \
    if (met_x <= met_y) x = next_pixel(x, level, ahead_x); \
    else if (level > 0) x = clamp(pixel_at(s, p.x, v.x, inverse_x, ahead_x), 0, last); \
    if (met_y <= met_x) y = next_pixel(y, level, ahead_y); \
    else if (level > 0) y = clamp(pixel_at(s, p.y, v.y, inverse_y, ahead_y), 0, last); \
    if ((from_x >> params.coarse) != (x >> params.coarse) || (from_y >> params.coarse) != (y >> params.coarse)) level = params.coarse;

// Walks one piece, from a to b: outcome (0: passed), t, texel of the map, looks. tw_a, tw_b: t w at its ends.
FN vec4 walk(CTX, int probe, vec3 o, vec3 d, vec4 a, vec4 b, float tw_a, float tw_b, vec3 side, float start, int looked) {
    const float half_size = 0.5f * float(params.size);
    const vec2 p = map_place(a, side, half_size);
    const vec2 end = map_place(b, side, half_size);
    const vec2 v = end - p;
    const float inverse_x = inverse_of(v.x);
    const float inverse_y = inverse_of(v.y);
    const int ahead_x = ahead_of(v.x);
    const int ahead_y = ahead_of(v.y);
    const int last = params.size - 1;
    const int border_x = ahead_x * params.size;
    const int border_y = ahead_y * params.size;
    const int cells = params.size >> params.coarse;
    // |q(s)|^2 = q0 + s (q1 + s q2), w(s) = a.w + s dw, t w = tw_a + s dtw.
    const vec3 from = vec3(a.x, a.y, a.z);
    const vec3 step = vec3(b.x, b.y, b.z) - from;
    const float q0 = dot3(from, from);
    const float q1 = 2.0f * dot3(from, step);
    const float q2 = dot3(step, step);
    const float dw = b.w - a.w;
    const float dtw = tw_b - tw_a;
    // What rounding may take from w, and add to |q|^2: bounds of many texels must hold for each.
    const float less = 4.8e-7f * max(a.w, b.w);
    float s = 0.0f;
    float w = a.w;
    float q = q0;
    int x = clamp(pixel_at(0.0f, p.x, v.x, inverse_x, ahead_x), 0, last);
    int y = clamp(pixel_at(0.0f, p.y, v.y, inverse_y, ahead_y), 0, last);
    int level = params.coarse;
    int looks = looked;
    while (s < 1.0f) {
        if (looks >= params.step_cap) return vec4(float(CAPPED), (tw_a + s * dtw) / w, float(y * params.size + x), float(looks));
        // SPLIT: first all looks in front of everything, then what was met. Where a driver runs rays side by side, each look
        // has the price of a meeting otherwise.
        bool met = false;
        float far = 0.0f;
        float s_out = 0.0f;
        float w_out = 0.0f;
        float q_out = 0.0f;
        float met_x = 0.0f;
        float met_y = 0.0f;
        do {
            ++looks;
            // The map's borders are where pieces end, never crossed: along one a ray stays in its texels.
            const int far_x = far_plane(x, level, ahead_x);
            const int far_y = far_plane(y, level, ahead_y);
            met_x = far_x == border_x ? ENDLESS : plane_met(far_x, p.x, inverse_x);
            met_y = far_y == border_y ? ENDLESS : plane_met(far_y, p.y, inverse_y);
            s_out = min(min(met_x, met_y), 1.0f);
            w_out = s_out >= 1.0f ? b.w : a.w + s_out * dw;
            q_out = q0 + s_out * (q1 + s_out * q2);
            bool passed = false;
            if (level > 0) {
                const float least = least_at(ctx, (probe * cells + (y >> level)) * cells + (x >> level));
                const float reach_in = least * (w - less);
                const float reach_out = least * (w_out - less);
                passed = least >= NO_SURFACE_AT ||
                    (reach_in > 0.0f && reach_out > 0.0f && q * 1.000004f < reach_in * reach_in && q_out * 1.000004f < reach_out * reach_out);
                if (!passed) level = 0;
            } else {
                far = distance_at(ctx, probe_texel(probe, x, y, params.size));
                const float reach_in = far * w;
                const float reach_out = far * w_out;
                passed = far >= NO_SURFACE_AT || (q < reach_in * reach_in && q_out < reach_out * reach_out && w_out > 0.0f);
                met = !passed;
            }
            if (passed) {
                ADVANCE
            }
        } while (SPLIT != 0 && !met && s < 1.0f && looks < params.step_cap);
        if (met) {
            const float t_in = (tw_a + s * dtw) / w;
            const float t_out = w_out > 0.0f ? (s_out >= 1.0f ? tw_b : tw_a + s_out * dtw) / w_out : ENDLESS;
            const vec3 centre = octahedron_point(octahedral_centre(x, y, params.size));
#if NORMALS
            const vec2 found = meet(ctx, probe_texel(probe, x, y, params.size), centre, far, o, d, t_in, max(t_out, t_in),
                                     sqrt(q) / w, start);
#else
            const vec2 found = meet(ctx, centre, far, o, d, t_in, max(t_out, t_in), sqrt(q) / w,
                                     w_out > 0.0f ? sqrt(q_out) / w_out : ENDLESS, start);
#endif
            if (found.x > 0.0f) return vec4(found.x, found.y, float(y * params.size + x), float(looks));
            ADVANCE
        }
    }
    return vec4(0.0f, 0.0f, 0.0f, float(looks));
}

// Asks one probe about the ray from t to its reach: outcome, t, texel of the map, looks.
FN vec4 ask(CTX, int probe, vec3 o, vec3 d, float t_from, float reach, float begin, int looked) {
    const vec3 crossed = vec3(crossing(o.x, d.x), crossing(o.y, d.y), crossing(o.z, d.z));
    // Nothing is hit nearer to the ray's beginning than the bias, of the footprint there.
    const float start = params.bias > 0.0f
        ? begin + params.bias * sqrt(dot3(o, o)) * footprint(octahedron_point(octahedral(o)), params.size) : begin;
    float t = t_from;
    vec4 found = vec4(0.0f, 0.0f, 0.0f, float(looked));
    bool more = true;
    while (more) {
        float next = reach;
        if (crossed.x > t) next = min(next, crossed.x);
        if (crossed.y > t) next = min(next, crossed.y);
        if (crossed.z > t) next = min(next, crossed.z);
        const vec3 side = vec3(side_after(t, crossed.x, o.x, d.x), side_after(t, crossed.y, o.y, d.y), side_after(t, crossed.z, o.z, d.z));
        const vec4 a = on_octahedron(t, crossed, side, o, d);
        const vec4 b = on_octahedron(next, crossed, side, o, d);
        // Without end t w tends to 1 over the sum of the direction's coordinates.
        const float tw = next < ENDLESS ? next * b.w : 1.0f / (abs(d.x) + abs(d.y) + abs(d.z));
        found = walk(ctx, probe, o, d, a, b, t * a.w, tw, side, start, int(found.w));
        t = next;
        more = found.x == 0.0f && t < reach;
    }
    return found.x > 0.0f ? found : vec4(float(MISS), reach, 0.0f, found.w);
}

// The place of a probe, and 1 where it is of use.
FN vec4 place_of(CTX, ivec3 at, ivec3 count) {
#if PLACED
    return load(positions, probe_index(at, count));
#else
    const vec3 p = probe_place(at, vec3(params.origin_x, params.origin_y, params.origin_z),
                               vec3(params.spacing_x, params.spacing_y, params.spacing_z));
    return vec4(p.x, p.y, p.z, count.x > 0 ? 1.0f : 0.0f);
#endif
}

// Corner k of a cage in the order that begins with `first`: (i + 3) mod 8, or xor with 7, 6, 7, 5, 7, 6, 7.
FN int ordered(int first, int k) {
    if (ORDER == 0) return (first + 3 * k) & 7;
    // What the xors come to: 0 7 1 6 3 4 2 5, Gray's code of k / 2, inverted where k is odd.
    const int pair = (k >> 1) & 3;
    const int even = pair ^ (pair >> 1);
    return first ^ ((k & 1) != 0 ? 7 ^ even : even);
}

FN void trace_ray(CTX, int i) {
    const vec4 from = load(rays, 2 * i);
    const vec4 along = load(rays, 2 * i + 1);
    const vec3 d = unit(vec3(along.x, along.y, along.z));
    const vec3 origin = vec3(from.x, from.y, from.z);
    const float begin = from.w;
    const float reach = along.w < ENDLESS ? along.w : ENDLESS;
    const ivec3 count = ivec3(params.count_x, params.count_y, params.count_z);
    vec4 found = vec4(float(DEGENERATE), 0.0f, 0.0f, 0.0f);
    int asked = 0;
    int texel_probe = -1;
    if (finite(from) && dot3(d, d) > 0.0f && along.w >= begin && begin >= 0.0f) {
        found = vec4(float(UNKNOWN), begin, 0.0f, 0.0f);
        if (params.probe >= 0) {
            const ivec3 at = ivec3(params.probe % count.x, params.probe / count.x % count.y, params.probe / (count.x * count.y));
            const vec4 place = place_of(ctx, at, count);
            if (place.w > 0.0f) {
                found = ask(ctx, params.probe, origin - vec3(place.x, place.y, place.z), d, begin, reach, begin, 0);
                texel_probe = params.probe;
                asked = 1;
            }
        } else {
            const vec3 grid_origin = vec3(params.origin_x, params.origin_y, params.origin_z);
            const vec3 spacing = vec3(params.spacing_x, params.spacing_y, params.spacing_z);
            ivec3 low = ivec3(-1, -1, -1);
            int first = 0;
            int turn = 0;  // in the order of the cage
            int tried = 0;
            while (int(found.x) == UNKNOWN && tried < params.tries && turn < max(params.tries, 8)) {
                const ivec3 here = cage_of(origin + found.y * d, grid_origin, spacing, count);
                if (here.x != low.x || here.y != low.y || here.z != low.z) {
                    // Into another cage: first the probe nearest to the ray's line.
                    low = here;
                    turn = 0;
                    tried = 0;
                    first = 0;
                    float nearest = ENDLESS;
                    for (int k = 0; k < 8; ++k) {
                        const ivec3 at = cage_corner(low, k, count);
                        const vec4 place = place_of(ctx, at, count);
                        const vec3 off = cross3(vec3(place.x, place.y, place.z) - origin, d);
                        const float squared = dot3(off, off);
                        if (place.w > 0.0f && squared < nearest) {
                            nearest = squared;
                            first = k;
                        }
                    }
                }
                const int corner = ordered(first, turn);
                ++turn;
                const ivec3 at = cage_corner(low, corner, count);
                const int probe = probe_index(at, count);
                const vec4 place = place_of(ctx, at, count);
                if (place.w > 0.0f && !cage_corner_again(corner, count)) {
                    ++tried;
                    ++asked;
                    texel_probe = probe;
                    const float before = found.y;
                    found = ask(ctx, probe, origin - vec3(place.x, place.y, place.z), d, before, reach, begin, int(found.w));
                    // Rounding must not lead back into the cage before, where asking would begin anew, without end.
                    if (int(found.x) == UNKNOWN) found.y = max(found.y, before);
                }
            }
            // Nobody sees on: the last occluder counts as hit.
            if (int(found.x) == UNKNOWN && tried > 0) found.x = float(ASSUMED);
        }
    }
    const int outcome = int(found.x);
    const bool has_texel = texel_probe >= 0 && outcome != MISS;
    store(hits, i, vec4(found.y, found.x, float(asked), found.w));
    store(texels, i, has_texel ? uint(texel_probe * params.size * params.size + int(found.z)) : NO_TEXEL);
#if COUNT
    atomic_add(counters, RAYS_COUNTED, 1u);
    atomic_add(counters, outcome, 1u);
    atomic_add(counters, PROBES_ASKED, uint(asked));
    atomic_add(counters, STEPS, uint(int(found.w)));
#endif
}

KERNEL(probe_trace) {
    for (int i = invocation_x(); i < params.rays; i += params.stride) trace_ray(ctx, i);
}
