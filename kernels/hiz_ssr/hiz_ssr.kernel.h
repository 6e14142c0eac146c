// Reflections found on the screen: rays walk over the pixels of a depth image, up a pyramid of nearest depths where nothing
// is near and down where something may be (Uludag, Hi-Z Screen-Space Cone-Traced Reflections, 2014), every pixel, or in
// uniform steps. All walks share one definition of a hit (math/screen_ray.h), and the first two visit the same pixels.

// Outcomes (include/luxel/hiz_ssr.h).
#define NONE 0
#define HIT 1
#define MISS 2
#define LEFT 3
#define BEHIND 4
#define CAPPED 5
#define DEGENERATE 6
#define RAYS_COUNTED 7
#define HIDDEN 8
#define STEPS 9
#define HIDDEN_FLAG 16  // added to the outcome of a ray that passed behind a surface

FN float surface_at(CTX, int i) {
    return reciprocal_depth(load_pixel(depth, 0, i, 0), DEPTH, params.depth_scale, params.depth_offset);
}

FN int cells_of(int n, int level) { return (n + (1 << level) - 1) >> level; }
// Texels of a level in the buffer: a multiple of 64.
FN int room_of(CTX, int level) { return (cells_of(params.width, level) * cells_of(params.height, level) + 63) / 64 * 64; }

// Where a ray that starts outside comes onto the image, and where it leaves the image (before that: it is never on it).
FN float entry_met(CTX, vec2 p, vec2 v) {
    return max(0.0f, max(plane_met((1 - ahead_of(v.x)) * params.width, p.x, inverse_of(v.x)),
                         plane_met((1 - ahead_of(v.y)) * params.height, p.y, inverse_of(v.y))));
}
FN float edge_met(CTX, vec2 p, vec2 v) {
    return min(plane_met(ahead_of(v.x) * params.width, p.x, inverse_of(v.x)),
               plane_met(ahead_of(v.y) * params.height, p.y, inverse_of(v.y)));
}

// Walks from cell to cell, from where the ray comes onto the image to its end. Gives the part of the ray in the pixel that is
// hit (or where it ended), outcome, looks.
FN vec4 walk(CTX, vec2 p, vec2 v, float w0, float g, float begin, float end, int outcome_at_end) {
    const float inverse_x = inverse_of(v.x);
    const float inverse_y = inverse_of(v.y);
    const int ahead_x = ahead_of(v.x);
    const int ahead_y = ahead_of(v.y);
    float s = begin;
    float s_out = begin;
    float w = w0 + s * g;
    int x = pixel_at(s, p.x, v.x, inverse_x, ahead_x);
    int y = pixel_at(s, p.y, v.y, inverse_y, ahead_y);
    int level = 0;
    int place = 0;  // where the level begins
    if (METHOD == 0)
        for (; level < params.first; ++level) place += room_of(ctx, level);
    int hidden = 0;
    int looks = 0;
    while (x >= 0 && y >= 0 && x < params.width && y < params.height) {
        if (looks >= params.step_cap) return vec4(s, s, float(CAPPED + hidden), float(looks));
        ++looks;
        const float met_x = plane_met(far_plane(x, level, ahead_x), p.x, inverse_x);
        const float met_y = plane_met(far_plane(y, level, ahead_y), p.y, inverse_y);
        s_out = min(min(met_x, met_y), end);
        const float w_out = w0 + s_out * g;
        const float front = surface_at(ctx, place + (y >> level) * cells_of(params.width, level) + (x >> level));
        const bool in_front = min(w, w_out) > front;
        if (METHOD == 0 && level > 0 && !in_front) {
            --level;
            place -= room_of(ctx, level);
            continue;
        }
        if (!in_front && is_surface(front)) {
            if (meets(w, w_out, front, behind_surface(front, params.thickness)))
                return vec4(s, s_out, float(HIT + hidden), float(looks));
            hidden = HIDDEN_FLAG;
        }
        if (s_out >= end) break;
        s = s_out;
        w = w_out;
        const int from_x = x;
        const int from_y = y;
        if (met_x <= met_y) x = next_pixel(x, level, ahead_x);
        else if (METHOD == 0 && level > 0) x = pixel_at(s, p.x, v.x, inverse_x, ahead_x);
        if (met_y <= met_x) y = next_pixel(y, level, ahead_y);
        else if (METHOD == 0 && level > 0) y = pixel_at(s, p.y, v.y, inverse_y, ahead_y);
        // Up where the ray has left the cell above as well; not behind surfaces, where no bound is of use.
        if (METHOD == 0 && in_front && level < params.top &&
            ((from_x >> (level + 1)) != (x >> (level + 1)) || (from_y >> (level + 1)) != (y >> (level + 1)))) {
            place += room_of(ctx, level);
            ++level;
        }
    }
    return vec4(s, end, float(outcome_at_end + hidden), float(looks));
}

// Samples at uniform lengths. Between one in front of a surface and one that is not, the step is halved for the first that
// is not.
FN vec4 stride(CTX, vec2 p, vec2 v, float w0, float g, float begin, float end, int outcome_at_end) {
    const float inverse_x = inverse_of(v.x);
    const float inverse_y = inverse_of(v.y);
    const int ahead_x = ahead_of(v.x);
    const int ahead_y = ahead_of(v.y);
    const float nearest = begin / max(w0 + begin * g, 1.0e-30f);
    const float longest = min(end / max(w0 + end * g, 1.0e-30f), params.reach);
    float t_in_front = nearest;
    bool was_in_front = false;
    int hidden = 0;
    int looks = 0;
    for (int k = 0; k <= params.steps; ++k) {
        float t = nearest + (longest - nearest) * (float(k) / float(params.steps));
        float t_met = t;
        int halvings = -1;  // the sample itself
        int more = 1;
        while (more > 0) {
            if (looks >= params.step_cap) return vec4(begin, begin, float(CAPPED + hidden), float(looks));
            ++looks;
            const float at = t * w0 / (1.0f - g * t);  // s = t / depth(t), depth(t) = (1 - g t) / w0
            const int x = clamp(pixel_at(at, p.x, v.x, inverse_x, ahead_x), 0, params.width - 1);
            const int y = clamp(pixel_at(at, p.y, v.y, inverse_y, ahead_y), 0, params.height - 1);
            const float s = max(begin, max(plane_met(near_plane(x, ahead_x), p.x, inverse_x), plane_met(near_plane(y, ahead_y), p.y, inverse_y)));
            const float s_out = min(end, min(plane_met(far_plane(x, 0, ahead_x), p.x, inverse_x), plane_met(far_plane(y, 0, ahead_y), p.y, inverse_y)));
            const float w = w0 + s * g;
            const float w_out = w0 + s_out * g;
            const float front = surface_at(ctx, y * params.width + x);
            const bool in_front = !is_surface(front) || min(w, w_out) > front;
            if (in_front) t_in_front = t;
            else t_met = t;
            ++halvings;
            if (halvings == 0) {
                more = in_front ? 0 : was_in_front ? params.refinements + 1 : 1;
                was_in_front = in_front;
            }
            --more;
            if (more == 0 && !in_front) {
                if (s <= s_out && meets(w, w_out, front, behind_surface(front, params.thickness)))
                    return vec4(s, s_out, float(HIT + hidden), float(looks));
                hidden = HIDDEN_FLAG;
            }
            // The last look is at what the halvings have found.
            t = more == 1 ? t_met : 0.5f * (t_in_front + t_met);
        }
    }
    return vec4(begin, end, float(outcome_at_end + hidden), float(looks));
}

// Confidence in a hit at pixel coordinates q, in percent of one.
FN float confidence(CTX, vec2 q, float t, float behind) {
    const vec2 uv = vec2(q.x / float(params.width), q.y / float(params.height));
    const float rim = min(min(uv.x, 1.0f - uv.x), min(uv.y, 1.0f - uv.y));
    float c = rim >= params.fade_edge ? 1.0f : max(rim, 0.0f) / params.fade_edge;
    const float rest = 1.0f - t / params.reach;
    c = c * (rest >= params.fade_distance ? 1.0f : max(rest, 0.0f) / params.fade_distance);
    return c * (1.0f - params.fade_thickness * clamp(behind, 0.0f, 1.0f));
}

FN float inside(float q, int at) { return clamp(q, float(at) + 0.015625f, float(at) + 0.984375f); }

// Follows a ray from o (view space; pixel p, reciprocal depth w0) in the unit direction d and writes what it found.
FN void trace(CTX, int i, vec2 p, float w0, vec3 d, float reach) {
    const float rate = -d.z;
    const vec2 v = vec2(params.focal_x * d.x - (p.x - params.centre_x) * rate, -params.focal_y * d.y - (p.y - params.centre_y) * rate);
    const float g = -w0 * rate;
    // The ray ends at its reach, where it comes as close to the camera's plane as `nearest`, or where it leaves the image.
    const float depth0 = 1.0f / w0;
    const float depth1 = depth0 + reach * rate;
    const bool turns_behind = depth1 < params.nearest;
    const float last = turns_behind ? (1.0f / params.nearest - w0) / g : reach / depth1;
    const float edge = edge_met(ctx, p, v);
    const float begin = entry_met(ctx, p, v);
    const float end = min(last, edge);
    const int outcome_at_end = edge < last ? LEFT : turns_behind ? BEHIND : MISS;
    vec4 found = vec4(0.0f, 0.0f, float(depth0 > params.nearest ? LEFT : BEHIND), 0.0f);
    if (depth0 > params.nearest && begin <= end)
        found = METHOD == 2 ? stride(ctx, p, v, w0, g, begin, end, outcome_at_end) : walk(ctx, p, v, w0, g, begin, end, outcome_at_end);

    const int code = int(found.z);
    const int outcome = code & 15;
    vec4 hit = vec4(0.0f);
    float s = found.y;
    if (outcome == HIT) {
        const int x = clamp(pixel_at(found.x, p.x, v.x, inverse_of(v.x), ahead_of(v.x)), 0, params.width - 1);
        const int y = clamp(pixel_at(found.x, p.y, v.y, inverse_of(v.y), ahead_of(v.y)), 0, params.height - 1);
        const float front = surface_at(ctx, y * params.width + x);
        s = first_inside(found.x, found.y, w0, g, front, behind_surface(front, params.thickness));
        // Within the pixel that was hit, off its edges, so that who looks there finds the same pixel.
        const vec2 q = vec2(inside(p.x + s * v.x, x), inside(p.y + s * v.y, y));
        const float w = w0 + s * g;
        const float into = params.thickness > 0.0f ? (1.0f / w - 1.0f / front) / params.thickness : 0.0f;
        hit = vec4(q.x / float(params.width), q.y / float(params.height), 1.0f / w, confidence(ctx, q, s / w, into));
#if RAYS == 0
        const vec4 facing = load(source, y * params.width + x);
        const float away = dot3(unit(vec3(facing.x, facing.y, facing.z)), d);
        if (away > 0.0f) hit.w = hit.w * (1.0f - params.fade_back);
#endif
    }
    const float w = w0 + s * g;
    store(hits, i, hit);
    store(paths, i, vec4(w > s * 1.0e-30f ? s / w : reach, float(outcome), float(code >> 4), found.w));
#if COUNT
    atomic_add(counters, RAYS_COUNTED, 1u);
    atomic_add(counters, outcome, 1u);
    if (code >= HIDDEN_FLAG) atomic_add(counters, HIDDEN, 1u);
    atomic_add(counters, STEPS, uint(int(found.w)));
#endif
}

FN void none(CTX, int i, int outcome) {
    store(hits, i, vec4(0.0f));
    store(paths, i, vec4(0.0f, float(outcome), 0.0f, 0.0f));
#if COUNT
    if (outcome != NONE) atomic_add(counters, outcome, 1u);
#endif
}

#if RAYS
// Two vec4 a ray: origin in view space and reach (0: that of the parameters); direction.
KERNEL(hiz_ssr) {
    const int i = invocation_x();
    if (i >= params.rays) return;
    const vec4 from = load(source, 2 * i);
    const vec4 along = load(source, 2 * i + 1);
    const vec3 d = unit(vec3(along.x, along.y, along.z));
    const float w0 = 1.0f / -from.z;
    const vec2 p = vec2(params.centre_x + params.focal_x * (from.x * w0), params.centre_y - params.focal_y * (from.y * w0));
    const float reach = from.w > 0.0f ? min(from.w, params.reach) : params.reach;
    if (!(from.z < 0.0f) || !finite(vec4(p.x, p.y, w0, from.w)) || dot3(d, d) == 0.0f)
        none(ctx, i, from.z >= 0.0f && finite(from) && dot3(d, d) > 0.0f ? BEHIND : DEGENERATE);
    else
        trace(ctx, i, p, w0, d, reach);
}
#else
// Rays of the pixels of the tiles in a list. The source holds a normal and a roughness a pixel. Rays start in front of the
// surface by the slope of its reciprocal depth over `bias` pixels along both axes: a plane's pixels, each flat at the depth of
// its centre, stand out of the plane by half a pixel's slope at most, so that from bias 1/2 on no plane hits itself. That holds
// while the ray climbs faster than its lead shrinks with growing depth; a pixel where it does not is nearer to its plane's
// horizon than the bias, and has no ray.
FN void reflect_pixel(CTX, int x, int y, int k) {
    const int traced_x = (params.width + params.scale - 1) / params.scale;
    const int traced_y = (params.height + params.scale - 1) / params.scale;
    if (x >= traced_x || y >= traced_y) return;
    const int i = (k * traced_y + y) * traced_x + x;
    // The first pixel of those that share a ray, or another by the seed.
    const ivec2 at = ivec2(min(x * params.scale + params.seed % params.scale, params.width - 1),
                           min(y * params.scale + params.seed / 2 % params.scale, params.height - 1));
    const int pixel_index = at.y * params.width + at.x;
    const vec4 facing = load(source, pixel_index);
    const float w = surface_at(ctx, pixel_index);
    if (!is_surface(w) || !(facing.w < params.cutoff)) {
        none(ctx, i, NONE);
        return;
    }
    const vec3 n = unit(vec3(facing.x, facing.y, facing.z));
    const vec2 p = vec2(float(at.x) + 0.5f, float(at.y) + 0.5f);
    // From the eye to the surface, at depth 1.
    const vec3 sight = vec3((p.x - params.centre_x) / params.focal_x, (params.centre_y - p.y) / params.focal_y, -1.0f);
    const float facing_away = dot3(n, sight);
    if (!(facing_away < 0.0f)) {
        none(ctx, i, DEGENERATE);
        return;
    }
    const float slope = w * (abs(n.x / params.focal_x) + abs(n.y / params.focal_y)) / -facing_away;
    const float lift = params.bias * slope + w * 3.8147e-6f;
#if STOCHASTIC
    // A direction of the lobe (math/ggx.h); the normals of a pixel's rays turn by even parts of the circle.
    const float alpha = alpha_of(facing.w);
    const uint seed = hashed(uint(pixel_index) ^ hashed(uint(params.seed)));
    const float turn = fraction_of(seed) + float(k) / float(params.each);
    const float wide_part = fraction_of(hashed(seed)) + 0.61803398875f * float(k);
    const vec3 v = unit(vec3(-sight.x, -sight.y, -sight.z));
    const vec3 a = tangent_to(n);
    const vec3 b = cross3(n, a);
    const vec3 local_v = vec3(dot3(v, a), dot3(v, b), dot3(v, n));
    const vec3 h = ggx_normal(local_v, alpha, vec2(turn - floor(turn), wide_part - floor(wide_part)));
    const vec3 normal = h.x * a + h.y * b + h.z * n;
    const vec3 d = unit(2.0f * dot3(local_v, h) * normal - v);
    const float density = ggx_density(h.z, h.x * h.x + h.y * h.y, alpha);
    store(directions, i, vec4(d.x, d.y, d.z, ggx_pdf(local_v.z, density, alpha)));
    // The lead is kept by a ray that climbs; one that leaves below the horizon of its surface meets it.
    const bool climbs = dot3(n, d) > 0.0f && lift * -d.z * -facing_away <= w * dot3(n, d);
#else
    const vec3 d = unit(sight - 2.0f * facing_away * n);
    const bool climbs = lift * -d.z * -facing_away <= w * dot3(n, d);
#endif
    if (climbs) trace(ctx, i, p, w + lift, d, params.reach);
    else none(ctx, i, DEGENERATE);
}

KERNEL(hiz_ssr) {
    const int side = TILE * params.scale;
    const int tiles_x = (params.width + side - 1) / side;
    const int count = int(load(tile_list, 0)) * params.each * (TILE * TILE);
    for (int j = invocation_x(); j < count; j += params.stride) {
        const int tile = int(load(tile_list, 1 + j / (TILE * TILE) / params.each));
        reflect_pixel(ctx, tile % tiles_x * TILE + j % TILE, tile / tiles_x * TILE + j / TILE % TILE, j / (TILE * TILE) % params.each);
    }
}
#endif
