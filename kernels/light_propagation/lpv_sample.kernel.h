// Light volumes looked up at surfaces. Source: Kaplanyan and Dachsbacher, Cascaded Light Propagation Volumes for Real-Time
// Indirect Illumination, 2010, sections 3.4 (look-up, damping) and 4 (cascades). Coefficients are of light that goes along w,
// so that a surface of normal n receives the convolution with <-n|w>+.

#define INSIDE 0  // words of outcomes (include/luxel/lpv_sample.h)
#define OUT 1
#define DEGENERATE 2
#define USED 3

// Eight neighbours of a look-up, and what lies between.
#define CORNERS \
    const vec3 q = vec3(in_box(p.x, params.width), in_box(p.y, params.height), in_box(p.z, params.depth)); \
    const ivec3 c = ivec3(int(q.x), int(q.y), int(q.z)); \
    const vec3 f = vec3(q.x - float(c.x), q.y - float(c.y), q.z - float(c.z)); \
    const int x = c.x + 1 < params.width ? 1 : 0; \
    const int y = c.y + 1 < params.height ? params.width : 0; \
    const int z = c.z + 1 < params.depth ? params.width * params.height : 0; \
    const int corner = at + (c.z * params.height + c.y) * params.width + c.x;
#define ROW(i) blend(load_pixel(light, 0, i, 0), load_pixel(light, 0, (i) + x, 0), f.x)
#define SLICE(i) blend(ROW(i), ROW((i) + y), f.y)

FN vec4 blend(vec4 a, vec4 b, float f) { return a + f * (b - a); }  // equal values stay so to the bit
// From cells to the centres that lie around; beyond the outermost, theirs.
FN float in_box(float p, int n) { return clamp(p - 0.5f, 0.0f, float(n - 1)); }
FN int cells_of(CTX) { return params.width * params.height * params.depth; }
FN float dot4(vec4 a, vec4 b) { return (a.x * b.x + a.y * b.y) + (a.z * b.z + a.w * b.w); }

// Four coefficients of the volume at pixel `at`, trilinear at p, in cells.
FN vec4 four_at(CTX, int at, vec3 p) {
    CORNERS
    return blend(SLICE(corner), SLICE(corner + z), f.z);
}

// Functions 4..7 in direction d, and 8, each times `band`.
FN vec4 second(vec3 d, float band) {
    return band * vec4(sh_basis(4, d), sh_basis(5, d), sh_basis(6, d), sh_basis(7, d));
}

// The sum of coefficients times those of a lobe along d; what is below 0 is no light.
FN float seen(CTX, int at, vec3 p, vec4 lobe, vec3 d, float band) {
    float sum = dot4(four_at(ctx, at, p), lobe);
    if (BANDS == 3) {
        const int cells = cells_of(ctx);
        sum += dot4(four_at(ctx, at + cells, p), second(d, band));
        sum += four_at(ctx, at + 2 * cells, p).x * (band * sh_basis(8, d));
    }
    return max(sum, 0.0f);
}

// How much is left of light where a blocker lies behind the surface: 1 - damping r (1 - s) / 2. g: what coefficients
// change by over a cell along the normal; r: |g| over |c|, 1 at most; s: cosine between both, -1 where all light is behind.
FN float damped(CTX, int at, vec3 p, vec3 n) {
    const vec4 c = four_at(ctx, at, p);
    const vec4 g = four_at(ctx, at, p + 0.5f * n) - four_at(ctx, at, p - 0.5f * n);
    const float cc = dot4(c, c);
    const float gg = dot4(g, g);
    if (!(cc > 0.0f && gg > 0.0f)) return 1.0f;
    const float between = clamp(dot4(c, g) / (sqrt(cc) * sqrt(gg)), -1.0f, 1.0f);
    return 1.0f - params.damping * min(1.0f, sqrt(gg) / sqrt(cc)) * (0.5f * (1.0f - between));
}

FN int place_of(CTX, int cascade, int channel) {
    return cascade * params.apart + channel * (BANDS == 3 ? 3 : 1) * cells_of(ctx);
}

// Irradiance from one cascade; p in its cells.
FN vec3 irradiance_at(CTX, int cascade, vec3 p, vec3 n) {
    const vec4 lobe = sh2_cosine(-n);
    ARRAY(float, e, 3)
    UNROLL for (int c = 0; c < 3; ++c) {
        e[c] = c == 0 ? 0.0f : e[0];
        if (c < params.channels) {
            const int at = place_of(ctx, cascade, c);
            e[c] = seen(ctx, at, p + params.offset * n, lobe, -n, sh_cosine_factor(2));
            if (DAMPED != 0) e[c] = e[c] * damped(ctx, at, p, n);
        }
    }
    return table(grids, 8 * cascade + 4) * vec3(e[0], e[1], e[2]);
}

// Cells from p to the nearest side of the grid; below 0 outside.
FN float depth_in(CTX, vec3 p) {
    return min(min(min(p.x, float(params.width) - p.x), min(p.y, float(params.height) - p.y)),
               min(p.z, float(params.depth) - p.z));
}

// Mean radiance that comes along the mirror direction r, from the cells that r passes.
FN vec3 glossy_at(CTX, int cascade, vec3 p, vec3 n, vec3 r) {
    const vec4 lobe = sh2_basis(-r);
    vec3 sum = vec3(0.0f);
    float met = 0.0f;
    for (int s = 0; s < params.steps; ++s) {
        const vec3 q = p + params.offset * n + (float(s) + 0.5f) * r;
        if (depth_in(ctx, q) < 0.0f) continue;
        met += 1.0f;
        const float red = seen(ctx, place_of(ctx, cascade, 0), q, lobe, -r, 1.0f);
        if (params.channels == 1) {
            sum = sum + vec3(red);
        } else {
            sum = sum + vec3(red, seen(ctx, place_of(ctx, cascade, 1), q, lobe, -r, 1.0f),
                             seen(ctx, place_of(ctx, cascade, 2), q, lobe, -r, 1.0f));
        }
    }
    return met > 0.0f ? table(grids, 8 * cascade + 4) / met * sum : vec3(0.0f);
}

FN void count_one(CTX, int word) {
    if (COUNT != 0) atomic_add(outcomes, word, 1u);
}

KERNEL(lpv_sample) {
    const int i = invocation_x();
    if (i >= params.receivers) return;
    const vec4 place = load(places, 2 * i);
    const vec4 facing = load(places, 2 * i + 1);
    const vec3 n = unit(vec3(facing.x, facing.y, facing.z));
    const bool there = finite(vec4(place.x, place.y, place.z, 0.0f)) && dot3(n, n) > 0.0f;
    vec3 r = vec3(0.0f);
    if (GLOSSY != 0) {
        const vec4 view = load(views, i);
        const vec3 v = unit(vec3(view.x, view.y, view.z));
        r = 2.0f * dot3(n, v) * n - v;
    }
    vec3 sum = vec3(0.0f);
    vec3 mirrored = vec3(0.0f);
    float left = 1.0f;
    for (int k = 0; k < params.cascades; ++k) {
        const vec3 corner = vec3(table(grids, 8 * k), table(grids, 8 * k + 1), table(grids, 8 * k + 2));
        const vec3 p = table(grids, 8 * k + 3) * (vec3(place.x, place.y, place.z) - corner);
        const float inside = there ? depth_in(ctx, p) : -1.0f;
        if (inside >= 0.0f && left > 0.0f) {
            const float share = k + 1 < params.cascades ? min(1.0f, inside * params.per_blend) : 1.0f;
            if (share > 0.0f) {
                sum = sum + left * share * irradiance_at(ctx, k, p, n);
                if (GLOSSY != 0) mirrored = mirrored + left * share * glossy_at(ctx, k, p, n, r);
                count_one(ctx, USED + k);
            }
            left = left - left * share;
        }
    }
    count_one(ctx, !there ? DEGENERATE : left < 1.0f ? INSIDE : OUT);
    store(irradiance, i, vec4(sum.x, sum.y, sum.z, there ? 1.0f - left : 0.0f));
    if (GLOSSY != 0) store(specular, i, vec4(mirrored.x, mirrored.y, mirrored.z, there ? 1.0f - left : 0.0f));
}
