// Irradiance at receivers from the eight probes around each: trilinear weights, times whether the surface faces the probe, times
// how likely the probe sees it (McGuire et al., Real-Time Global Illumination using Precomputed Light Field Probes, 2017, 5.2;
// the smooth test of facing: Majercik et al., Dynamic Diffuse Global Illumination with Ray-Traced Irradiance Fields, 2019).

#if COUNT
#define COUNTED(i) atomic_add(counters, i, 1u);
#else
#define COUNTED(i)
#endif
#define RECEIVERS 0
#define DEGENERATE 1
#define OUTSIDE 2
#define HIDDEN 3
#define LOST 4
#define DROPPED 5
#define FARTHEST 1.0e12f  // unit lengths: squares stay finite
#define HERE 1.0e-15f     // in the probe's place: no direction leads to it

#if VISIBILITY
FN vec2 moment_at(CTX, int i) { return vec2(load_pixel(moments, 0, i, 0).x, load_pixel(moments, 0, i, 0).y); }

// How much of what a probe sees at a place of its map may lie beyond r: Chebyshev's upper bound (Donnelly and Lauritzen, Variance Shadow
// Maps, 2006), sharpened. Between texels distances are mixed: mu = sum w mu_i, sigma^2 = sum w (sigma_i^2 + (mu_i - mu)^2).
FN float visibility(CTX, int probe, vec2 place, float r) {
    const int stride = params.moments_size + 2;
    const vec3 at = octahedral_look_up(place, params.moments_size);
    const int i = probe * stride * stride + int(at.x);
    const vec2 a = moment_at(ctx, i);
    const vec2 b = moment_at(ctx, i + 1);
    const vec2 c = moment_at(ctx, i + stride);
    const vec2 d = moment_at(ctx, i + stride + 1);
    const float wd = at.y * at.z;
    const float wb = at.y - wd;
    const float wc = at.z - wd;
    const float wa = 1.0f - at.y - wc;
    const float mean = wa * a.x + wb * b.x + wc * c.x + wd * d.x;
    const float behind = r - mean;
    const float own = params.footprint * mean;
    const float variance = own * own + wa * (a.y * a.y + (a.x - mean) * (a.x - mean)) + wb * (b.y * b.y + (b.x - mean) * (b.x - mean)) +
                           wc * (c.y * c.y + (c.x - mean) * (c.x - mean)) + wd * (d.y * d.y + (d.x - mean) * (d.x - mean));
    const float whole = variance + behind * behind;
    if (behind <= 0.0f || whole == 0.0f) return 1.0f;
    const float bound = variance / whole;
    float sharp = bound;
    UNROLL for (int k = 1; k < SHARPEN; ++k) sharp = sharp * bound;
    return sharp;
}
#endif

FN float facing_weight(CTX, float cosine) {
    if (FACING == 1) return max(cosine, params.least_facing);
    const float wrapped = 0.5f + 0.5f * cosine;
    return wrapped * wrapped + params.least_facing;
}

// Along one axis: the lower probe, and how far the receiver lies towards the upper one.
FN vec2 cell_of(float q, int n) {
    const float inside = clamp(q, 0.0f, float(n - 1));
    const int lower = max(min(int(inside), n - 2), 0);
    return vec2(float(lower), inside - float(lower));
}
FN bool beyond(float q, int n) { return n > 1 && (q < 0.0f || q > float(n - 1)); }

FN vec4 received(CTX, vec3 p, vec3 n) {
    const vec3 q = vec3(p.x / params.spacing_x, p.y / params.spacing_y, p.z / params.spacing_z);
    const vec2 cell_x = cell_of(q.x, params.count_x);
    const vec2 cell_y = cell_of(q.y, params.count_y);
    const vec2 cell_z = cell_of(q.z, params.count_z);
#if COUNT
    if (beyond(q.x, params.count_x) || beyond(q.y, params.count_y) || beyond(q.z, params.count_z)) COUNTED(OUTSIDE)
#endif
    const vec3 at = octahedral_look_up(octahedral(n), params.light_size);
    const int stride = params.light_size + 2;
    const float wd = at.y * at.z;
    const float wb = at.y - wd;
    const float wc = at.z - wd;
    const float wa = 1.0f - at.y - wc;
    const vec3 from = p + params.normal_bias * n;
    vec4 sum = vec4(0.0f);
    float all = 0.0f;   // weights without visibility
    float seen = 0.0f;  // with it
    float weights = 0.0f;
    UNROLL for (int k = 0; k < 8; ++k) {
        const int upper_x = k % 2;
        const int upper_y = k / 2 % 2;
        const int upper_z = k / 4;
        const int x = min(int(cell_x.x) + upper_x, params.count_x - 1);
        const int y = min(int(cell_y.x) + upper_y, params.count_y - 1);
        const int z = min(int(cell_z.x) + upper_z, params.count_z - 1);
        const int probe = x + params.count_x * (y + params.count_y * z);
        float w = (upper_x == 1 ? cell_x.y : 1.0f - cell_x.y) * (upper_y == 1 ? cell_y.y : 1.0f - cell_y.y) *
                  (upper_z == 1 ? cell_z.y : 1.0f - cell_z.y);
#if PLACED
        const vec4 place = load(positions, probe);
        if (!(place.w > 0.0f)) w = 0.0f;
        const vec3 v = params.per_unit * vec3(from.x - (place.x - params.origin_x), from.y - (place.y - params.origin_y),
                                              from.z - (place.z - params.origin_z));
#else
        const vec3 v = params.per_unit * vec3(from.x - float(x) * params.spacing_x, from.y - float(y) * params.spacing_y,
                                              from.z - float(z) * params.spacing_z);
#endif
        if (w > 0.0f) {
            const float r = sqrt(dot3(v, v));
            const bool away = r > HERE;
            const float along = abs(v.x) + abs(v.y) + abs(v.z);
            const float per_both = away ? 1.0f / (r * along) : 0.0f;  // divisions are dear: one for both quotients
            if (FACING != 0) w = w * facing_weight(ctx, away ? -dot3(n, v) * (along * per_both) : 1.0f);
            float visible = away || r <= HERE ? 1.0f : r;  // NaN stays
#if VISIBILITY
            if (away) visible = visibility(ctx, probe, octahedral_by(v, r * per_both), r);
#endif
            const int i = probe * stride * stride + int(at.x);
            const vec4 e = wa * load_pixel(light, 0, i, 0) + wb * load_pixel(light, 0, i + 1, 0) +
                           wc * load_pixel(light, 0, i + stride, 0) + wd * load_pixel(light, 0, i + stride + 1, 0);
            if (finite(vec4(e.x, e.y, e.z, visible))) {
                const float part = w * (DARK != 0 ? visible : max(visible, params.least));
                all += w;
                seen += w * visible;
                weights += part;
                sum = sum + part * e;
            } else {
                COUNTED(DROPPED)
            }
        }
    }
    if (!(all > 0.0f)) {
        COUNTED(LOST)
        return vec4(0.0f);
    }
#if VISIBILITY && COUNT
    if (seen <= params.least * all) COUNTED(HIDDEN)
#endif
    const float whole = DARK != 0 ? max(weights, params.least * all) : weights;
    if (!(whole > 0.0f)) return vec4(0.0f);
    return vec4(sum.x / whole, sum.y / whole, sum.z / whole, seen / all);
}

// Two vec4 a receiver: position; normal.
KERNEL(probe_shade) {
    const int x = invocation_x();
    const int y = invocation_y();
    if (x >= params.width || y >= params.height) return;
    const int i = y * params.width + x;
    const vec4 place = load(receivers, 2 * i);
    const vec4 facing = load(receivers, 2 * i + 1);
    const vec3 n = unit(vec3(facing.x, facing.y, facing.z));
    const vec3 p = vec3(place.x - params.origin_x, place.y - params.origin_y, place.z - params.origin_z);
    const float far_away = params.per_unit * max(abs(p.x), max(abs(p.y), abs(p.z)));
    vec4 result = vec4(0.0f);
    COUNTED(RECEIVERS)
    if (finite(vec4(p.x, p.y, p.z, 0.0f)) && far_away < FARTHEST && dot3(n, n) > 0.0f) {
        result = received(ctx, p, n);
    } else {
        COUNTED(DEGENERATE)
    }
    store(irradiance, i, result);
}
