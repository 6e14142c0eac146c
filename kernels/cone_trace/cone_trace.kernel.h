// Voxel cone tracing: light and occlusion gathered along the axes of cones, from a pyramid of voxels whose level follows
// the cone's diameter. Source: Crassin et al., Interactive Indirect Illumination Using Voxel Cone Tracing, 2011. The
// recurrence is that of premultiplied colour q = a L (Max 1995):
//     s = (1 - (1-a)^(d'/d)) / a,  C += (1-A) s q,  A += (1-A) s a.

// Outcomes (include/luxel/cone_trace.h).
#if COUNT
#define COUNTED(outcome) atomic_add(counters, outcome, 1u);
#define LOOKED_UP(n) look_ups += n;
#else
#define COUNTED(outcome)
#define LOOKED_UP(n)
#endif
#define CONES 0
#define OPAQUE 1
#define LEFT 2
#define REACHED 3
#define CAPPED 4
#define MISSED 5
#define NOT_FINITE 6
#define DEGENERATE 7
#define LOOK_UPS 8
#define VOLUMES (ANISOTROPIC != 0 ? 3 : 1)  // that one look-up of a coarse level reads

FN vec4 blend(vec4 a, vec4 b, float f) { return a + f * (b - a); }  // equal values stay so to the bit
FN bool finite(vec4 v) {
    const vec4 zero = v - v;
    return zero.x + zero.y + zero.z + zero.w == 0.0f;
}
FN int halved(int n) { return max(n >> 1, 1); }
FN ivec3 coarser(ivec3 e) { return ivec3(halved(e.x), halved(e.y), halved(e.z)); }
FN ivec3 finest(CTX) { return ivec3(params.extent_x, params.extent_y, params.extent_z); }

// Trilinear look-up at p, in voxels of the level, between the nearest centres; beyond the outermost, theirs.
#if SAMPLED
// An image of all coarse levels: side by side along x, the directions one behind the other along z.
FN int place_behind(int at, ivec3 e) { return at + e.x; }
FN float in_box(float p, int n) { return clamp(p, 0.5f, float(n) - 0.5f); }
FN vec4 fine_at(CTX, vec3 p) {
    const ivec3 e = finest(ctx);
    return sample3d(fine, vec3(in_box(p.x, e.x) / float(e.x), in_box(p.y, e.y) / float(e.y), in_box(p.z, e.z) / float(e.z)),
                    0.0f);
}
FN vec4 directional(CTX, vec3 p, ivec3 e, int at, int direction) {
    const float x = float(at) + in_box(p.x, e.x);
    const float y = in_box(p.y, e.y);
    const float z = float(direction * halved(params.extent_z)) + in_box(p.z, e.z);
    return sample3d(coarse, vec3(x / float(params.atlas_x), y / float(params.atlas_y), z / float(params.atlas_z)), 0.0f);
}
#define CORNERS
#define COARSE(direction) directional(ctx, p, e, at, direction)
#else
// A buffer of all coarse levels; each (each of its directions) begins at a multiple of 64 texels.
FN int volume_of(ivec3 e) { return (e.x * e.y * e.z + 63) / 64 * 64; }
FN int place_behind(int at, ivec3 e) { return at + (ANISOTROPIC != 0 ? 6 : 1) * volume_of(e); }
FN float in_box(float p, int n) { return clamp(p - 0.5f, 0.0f, float(n - 1)); }
#define CORNERS \
    const vec3 q = vec3(in_box(p.x, e.x), in_box(p.y, e.y), in_box(p.z, e.z)); \
    const ivec3 c = ivec3(int(q.x), int(q.y), int(q.z)); \
    const vec3 f = vec3(q.x - float(c.x), q.y - float(c.y), q.z - float(c.z)); \
    const int x = c.x + 1 < e.x ? 1 : 0; \
    const int y = c.y + 1 < e.y ? e.x : 0; \
    const int z = c.z + 1 < e.z ? e.x * e.y : 0; \
    const int corner = (c.z * e.y + c.y) * e.x + c.x;
#define ROW(volume, i) blend(load_pixel(volume, 0, i, 0), load_pixel(volume, 0, (i) + x, 0), f.x)
#define SLICE(volume, i) blend(ROW(volume, i), ROW(volume, (i) + y), f.y)
#define CELL(volume, i) blend(SLICE(volume, i), SLICE(volume, (i) + z), f.z)
FN vec4 fine_at(CTX, vec3 p) {
    const ivec3 e = finest(ctx);
    CORNERS
    return CELL(fine, corner);
}
#define COARSE(direction) CELL(coarse, at + (direction) * volume_of(e) + corner)
#endif

// A coarse level as seen along d: directional volumes weighted by the squared components of d.
FN vec4 coarse_at(CTX, vec3 p, vec3 d, ivec3 e, int at) {
    CORNERS
    if (ANISOTROPIC == 0) return COARSE(0);
    const vec4 along_x = COARSE(d.x < 0.0f ? 1 : 0);
    const vec4 along_y = COARSE(d.y < 0.0f ? 3 : 2);
    const vec4 along_z = COARSE(d.z < 0.0f ? 5 : 4);
    return along_x + d.y * d.y * (along_y - along_x) + d.z * d.z * (along_z - along_x);
}

// Voxels of a level in a finest one, along each axis.
FN vec3 level_scale(CTX, ivec3 e) {
    const ivec3 n = finest(ctx);
    return vec3(float(e.x) / float(n.x), float(e.y) / float(n.y), float(e.z) / float(n.z));
}
// 1 / reference length of a coarse level's opacity: a finest voxel, or a voxel of the level along d.
FN float per_reference(vec3 d, vec3 scale) {
    return ANISOTROPIC == 0 ? 1.0f : 1.0f / (d.x * d.x / scale.x + d.y * d.y / scale.y + d.z * d.z / scale.z);
}

// log2(x) for 1 <= x <= 2, within 2e-5, exact at both ends.
FN float log2_part(float x) {
    const float t = x - 1.0f;
    const float q = 0.441917029f + t * (-0.267179320f + t * (0.148426458f - 0.0451489228f * t));
    return t * (1.0f + (1.0f - t) * q);
}

// The part of a range along d in which one coordinate lies between 0 and n; empty where x > y.
FN vec2 within(vec2 range, float p, float d, float n) {
    if (abs(d) < 1.0e-9f) return p >= 0.0f && p <= n ? range : vec2(1.0f, 0.0f);
    const float a = -p / d;
    const float b = (n - p) / d;
    return vec2(max(range.x, min(a, b)), min(range.y, max(a, b)));
}

// Positions at which floats still tell quarter voxels apart; from farther on, nothing of the volume is seen.
#define FARTHEST 4194304.0f

// What passing `step` of a look-up adds, premultiplied: its opacity stands for 1 / k of a finest voxel's width.
FN vec4 crossed(vec4 v, float k_step) { return extinction_part(v.w, k_step) * v; }
// Between two levels. Opacities per one length are blended first, as neighbours in a level are, and corrected once.
#ifdef CLIPMAP
#define ONE_LENGTH (OWN_LENGTH == 0)
#else
#define ONE_LENGTH (ANISOTROPIC == 0)
#endif
FN vec4 crossed_between(vec4 finer, float finer_step, vec4 wider, float wider_step, float f) {
    if (ONE_LENGTH) return crossed(blend(finer, wider, f), finer_step);
    return blend(crossed(finer, finer_step), crossed(wider, wider_step), f);
}
FN bool is_empty(vec4 v) { return SKIP_EMPTY != 0 && v.x + v.y + v.z + v.w == 0.0f; }

#ifdef CLIPMAP
// p in voxels of a level, from the corner of its window.
FN vec3 in_window(CTX, int level, vec3 p) {
    const int w = 8 * level;
    return table(windows, w + 6) * (p - vec3(table(windows, w), table(windows, w + 1), table(windows, w + 2)));
}
FN vec4 level_at(CTX, int level, vec3 p) {
    const ivec3 e = finest(ctx);
    const vec3 r = in_window(ctx, level, p);
    const vec3 q = vec3(in_box(r.x, e.x), in_box(r.y, e.y), in_box(r.z, e.z));
    const ivec3 c = ivec3(int(q.x), int(q.y), int(q.z));
    const vec3 f = vec3(q.x - float(c.x), q.y - float(c.y), q.z - float(c.z));
    const int w = 8 * level;
    const ivec3 turn = ivec3(int(table(windows, w + 3)), int(table(windows, w + 4)), int(table(windows, w + 5)));
    const ivec3 low = torus(c + turn, e);
    const ivec3 high = torus(min(c + 1, e - 1) + turn, e);
    const int x = high.x - low.x;
    const int y = (high.y - low.y) * e.x;
    const int z = (high.z - low.z) * e.x * e.y;
    const int corner = ((level * e.z + low.z) * e.y + low.y) * e.x + low.x;
    return CELL(fine, corner);
}
// Level of the finest window that holds p, and up to 1 more where it gives way to the next.
FN float held_at(CTX, vec3 p) {
    const ivec3 n = finest(ctx);
    for (int level = 0; level + 1 < params.levels; ++level) {
        const vec3 q = in_window(ctx, level, p);
        const vec3 left = min(q, vec3(float(n.x), float(n.y), float(n.z)) - q);
        const float inside = min(left.x, min(left.y, left.z)) - 0.5f;  // look-ups end at the outermost centres
        if (inside > 0.0f) return float(level) + max(0.0f, 1.0f - inside * table(windows, 8 * level + 7));
    }
    return float(params.levels - 1);
}
// Width of the voxels there, in finest ones.
FN float voxel_at(CTX, vec3 p) {
    const float held = held_at(ctx, p);
    const int level = int(held);
    return (1.0f + held - float(level)) / table(windows, 8 * level + 6);
}
FN float per_length(CTX, int level) { return OWN_LENGTH != 0 ? table(windows, 8 * level + 6) : 1.0f; }

// The coarser of the levels that the width asks for and that the windows hold at p, and the share of the next.
FN vec2 levels_at(CTX, vec3 p, float width) {
    int level = 0;
    while (level + 1 < params.levels && width * table(windows, 8 * level + 6) >= 2.0f) ++level;
    const float wider = width * table(windows, 8 * level + 6);
    float f = wider > 1.0f && level + 1 < params.levels ? log2_part(wider) : 0.0f;
    const float held = held_at(ctx, p);
    if (held > float(level) + f) {
        level = int(held);
        f = held - float(level);
    }
    return vec2(float(level), f);
}
// Where the outermost window begins and ends; widths count as there.
#define LOWEST vec3(table(windows, 8 * params.levels - 8), table(windows, 8 * params.levels - 7), table(windows, 8 * params.levels - 6))
#define OUTERMOST (1.0f / table(windows, 8 * params.levels - 2))
#define VOXEL_AT(p) voxel_at(ctx, p)
#else
#define LOWEST vec3(0.0f, 0.0f, 0.0f)
#define OUTERMOST 1.0f
#define VOXEL_AT(p) 1.0f
#endif

// One level of the sky: the mean radiance over a cap around each direction, at points of an octahedral map that reach
// its edges, so that a look-up never crosses one.
FN vec3 sky_at(CTX, vec2 at, int level) {
    const int n = params.sky_size;
    const int x = min(int(at.x), n - 2);
    const int y = min(int(at.y), n - 2);
    const int i = (level * n + y) * n + x;
    const vec4 v = blend(blend(load(sky, i), load(sky, i + 1), at.x - float(x)),
                         blend(load(sky, i + n), load(sky, i + n + 1), at.x - float(x)), at.y - float(y));
    return vec3(v.x, v.y, v.z);
}
FN vec3 environment(CTX, vec3 d, float level) {
    const vec3 whole = vec3(params.environment_r, params.environment_g, params.environment_b);
    if (SKY == 0) return whole;
    const float half_size = 0.5f * float(params.sky_size - 1);
    const vec2 place = octahedral(d);
    const vec2 at = vec2(half_size * (place.x + 1.0f), half_size * (place.y + 1.0f));
    const int below = int(level);
    vec3 v = sky_at(ctx, at, below);
    const float f = level - float(below);
    if (f > 0.0f) v = v + f * (sky_at(ctx, at, below + 1) - v);
    return whole * v;
}

// Radiance (with what the environment adds) and occlusion seen along d from p, in finest voxels. `width`: of the voxels
// that are looked up; those of a level are `size` = 2^level wide.
FN vec4 cone(CTX, vec3 p, vec3 d, float spread, float sky_level) {
    const ivec3 n = finest(ctx);
    const vec3 from = p - LOWEST;
    vec2 range = within(vec2(params.start * VOXEL_AT(p), params.reach), from.x, d.x, OUTERMOST * float(n.x));
    range = within(range, from.y, d.y, OUTERMOST * float(n.y));
    range = within(range, from.z, d.z, OUTERMOST * float(n.z));
    const bool near = max(abs(p.x), max(abs(p.y), abs(p.z))) <= FARTHEST;
    const float span = near ? range.y - range.x : -1.0f;
    const vec3 entry = vec3(p.x + range.x * d.x, p.y + range.x * d.y, p.z + range.x * d.z);

    vec4 sum = vec4(0.0f);  // C, A
    float occlusion = 0.0f;
    float t = 0.0f;         // behind the entry
    int steps = 0;
#if COUNT
    int look_ups = 0;
#endif
    float step;
    float width;
#define NEXT_STEP \
    step = min(params.step_scale * max(VOXEL_AT(entry + t * d), spread * (range.x + t)), span - t); \
    width = spread * (range.x + t + 0.5f * step);
#define GOES_ON (t < span && 1.0f - sum.w > params.stop && steps < params.step_cap)
#define SAMPLE_PLACE \
    const float middle = t + 0.5f * step; \
    const vec3 at = vec3(entry.x + middle * d.x, entry.y + middle * d.y, entry.z + middle * d.z);
#define ACCUMULATE(seen) { \
        const vec4 added = (1.0f - sum.w) * (seen); \
        sum = sum + added; \
        if (OCCLUSION > 1) occlusion += added.w / (1.0f + params.gamma * (range.x + middle)); \
        t += step; \
        steps += 1; \
        NEXT_STEP \
    }
    NEXT_STEP

#ifdef CLIPMAP
    while (GOES_ON) {
        SAMPLE_PLACE
        const vec2 which = levels_at(ctx, at, width);
        const int level = int(which.x);
        const float k = per_length(ctx, level);
        LOOKED_UP(1)
        vec4 v = level_at(ctx, which.y > 0.0f ? level + 1 : level, at);
        if (which.y == 0.0f) {
            v = crossed(v, step * k);
        } else if (!is_empty(v)) {
            LOOKED_UP(1)
            v = crossed_between(level_at(ctx, level, at), step * k, v, step * per_length(ctx, level + 1), which.y);
        }
        ACCUMULATE(v)
    }
#else
    // The finest level alone; between it and the next; between two coarse levels.
    while (GOES_ON && (width <= 1.0f || params.levels == 1)) {
        SAMPLE_PLACE
        LOOKED_UP(1)
        ACCUMULATE(crossed(fine_at(ctx, at), step))
    }
    ivec3 next_e = coarser(n);
    int next_at = 0;
    vec3 next_scale = level_scale(ctx, next_e);
    float next_k = per_reference(d, next_scale);
    while (GOES_ON && width < 2.0f) {
        SAMPLE_PLACE
        LOOKED_UP(VOLUMES)
        vec4 v = coarse_at(ctx, at * next_scale, d, next_e, next_at);
        if (!is_empty(v)) {
            LOOKED_UP(1)
            v = crossed_between(fine_at(ctx, at), step, v, step * next_k, log2_part(width));
        }
        ACCUMULATE(v)
    }
    float size = 2.0f;
    float per_size = 0.5f;
    for (int level = 1; level < params.levels && GOES_ON; ++level) {
        const bool top = level + 1 == params.levels;
        const ivec3 e = next_e;
        const int first = next_at;
        const vec3 scale = next_scale;
        const float k = next_k;
        if (!top) {
            next_at = place_behind(first, e);
            next_e = coarser(e);
            next_scale = level_scale(ctx, next_e);
            next_k = per_reference(d, next_scale);
        }
        while (GOES_ON && (width < 2.0f * size || top)) {
            SAMPLE_PLACE
            LOOKED_UP(VOLUMES)
            vec4 v = coarse_at(ctx, at * next_scale, d, next_e, next_at);
            if (!is_empty(v)) {
                LOOKED_UP(VOLUMES)
                const float f = top ? 0.0f : log2_part(width * per_size);
                v = crossed_between(coarse_at(ctx, at * scale, d, e, first), step * k, v, step * next_k, f);
            }
            ACCUMULATE(v)
        }
        size = 2.0f * size;
        per_size = 0.5f * per_size;
    }
#endif

#if COUNT
    atomic_add(counters, LOOK_UPS, uint(look_ups));
#endif
    COUNTED(CONES)
    COUNTED(span <= 0.0f ? MISSED : 1.0f - sum.w <= params.stop ? OPAQUE : t < span ? CAPPED
            : range.y < params.reach ? LEFT : REACHED)
    const vec3 beyond = (1.0f - sum.w) * environment(ctx, d, sky_level);
    const vec4 seen = vec4(sum.x + beyond.x, sum.y + beyond.y, sum.z + beyond.z, OCCLUSION > 1 ? occlusion : sum.w);
    if (finite(seen)) return seen;
    COUNTED(NOT_FINITE)
    return vec4(0.0f);
}

// v / |v|; zero where v is not finite or has no length.
FN vec3 unit(vec3 v) {
    const float most = max(abs(v.x), max(abs(v.y), abs(v.z)));
    if (!finite(vec4(v.x, v.y, v.z, 0.0f)) || most < 1.0e-30f) return vec3(0.0f, 0.0f, 0.0f);
    const vec3 u = v / most;
    return u / sqrt(u.x * u.x + u.y * u.y + u.z * u.z);
}

// A tangent of a unit normal: a fixed direction, less its part along n. Smooth but for two small circles of normals, which
// lie off every axis and diagonal, so that the frame does not jump on the walls of buildings.
FN vec3 tangent_of(vec3 n) {
    vec3 g = vec3(0.36f, 0.48f, 0.8f);
    float along = n.x * g.x + n.y * g.y + n.z * g.z;
    if (abs(along) > 0.96f) {
        g = vec3(0.8f, -0.6f, 0.0f);
        along = n.x * g.x + n.y * g.y;
    }
    return (g - along * n) / sqrt(1.0f - along * along);
}

// Receivers' places in voxels. Two vec4 a receiver: position and roughness; normal.
FN vec3 place_of(CTX, int i, vec3 n) {
    const vec4 place = load(receivers, 2 * i);
    const vec3 p = vec3((place.x - params.origin_x) * params.per_voxel, (place.y - params.origin_y) * params.per_voxel,
                        (place.z - params.origin_z) * params.per_voxel);
    return p + params.normal_offset * VOXEL_AT(p) * n;
}

#if SPECULAR
// Mirror direction of the view; the cone's spread, and the level of the sky, follow the roughness (tables of 65 values over
// 0..1).
FN float by_roughness(CTX, int first, float roughness) {
    const float r = 64.0f * clamp(roughness, 0.0f, 1.0f);
    const int i = first + min(int(r), 63);
    return table(spreads, i) + (r - float(i - first)) * (table(spreads, i + 1) - table(spreads, i));
}
FN vec4 received(CTX, int i, vec3 p, vec3 n) {
    const vec4 to_eye = load(views, i);
    const vec3 v = unit(vec3(to_eye.x, to_eye.y, to_eye.z));
    if (v.x == 0.0f && v.y == 0.0f && v.z == 0.0f) return vec4(0.0f);
    const float twice = 2.0f * (n.x * v.x + n.y * v.y + n.z * v.z);
    const float roughness = load(receivers, 2 * i).w;
    const float level = SKY != 0 ? by_roughness(ctx, 68, roughness) : 0.0f;
    const vec4 seen = cone(ctx, p, unit(twice * n - v), by_roughness(ctx, 0, roughness), level);
    return vec4(seen.x, seen.y, seen.z, 1.0f - seen.w);
}
#else
// Irradiance and visibility: the mean over the cones, or over those that the pattern deals to this receiver.
FN vec4 received(CTX, int i, vec3 p, vec3 n) {
    vec3 a = tangent_of(n);
    vec3 b = vec3(n.y * a.z - n.z * a.y, n.z * a.x - n.x * a.z, n.x * a.y - n.y * a.x);
    if (ROTATE != 0) {  // one of 64 turns about the normal; those of a pattern's tile turn together
        const int tile = i - i % params.width % params.pattern_x - params.width * (i / params.width % params.pattern_y);
        const int turn = 8 * int(hash(uint(tile) + hash(uint(params.seed))) >> 26);
        const vec3 turned = table(cones, turn + 6) * a + table(cones, turn + 7) * b;
        b = table(cones, turn + 6) * b - table(cones, turn + 7) * a;
        a = turned;
    }
    const int parts = params.pattern_x * params.pattern_y;
    const int dealt = i % params.width % params.pattern_x + params.pattern_x * (i / params.width % params.pattern_y);
    vec4 sum = vec4(0.0f);
    for (int c = dealt; c < params.cones; c += parts) {
        const vec3 tilted = vec3(table(cones, 8 * c), table(cones, 8 * c + 1), table(cones, 8 * c + 2));
        const vec3 d = tilted.x * a + tilted.y * b + tilted.z * n;
        sum = sum + table(cones, 8 * c + 3) * cone(ctx, p, d, table(cones, 8 * c + 4), table(cones, 8 * c + 5));
    }
    sum = float(parts) * sum;
    const float pi = RADIANCE != 0 ? 3.14159265358979f : 0.0f;
    return vec4(pi * sum.x, pi * sum.y, pi * sum.z, OCCLUSION != 0 ? 1.0f - sum.w : 1.0f);
}
#endif

KERNEL(cone_trace) {
    const int x = invocation_x();
    const int y = invocation_y();
    if (x >= params.width || y >= params.height) return;
    const int i = y * params.width + x;
    const vec4 facing = load(receivers, 2 * i + 1);
    const vec3 n = unit(vec3(facing.x, facing.y, facing.z));
    const vec3 p = place_of(ctx, i, n);
    vec4 result = vec4(0.0f);
    if (finite(vec4(p.x, p.y, p.z, 0.0f)) && n.x * n.x + n.y * n.y + n.z * n.z > 0.0f) {
        result = received(ctx, i, p, n);
        if (!finite(result)) {
            COUNTED(NOT_FINITE)
            result = vec4(0.0f);
        }
    } else {
        COUNTED(DEGENERATE)
    }
    store(GATHERED, i, result);
}
