// Small lights into the cells of a grid, and pieces of surfaces into its corners, as spherical harmonics: sums of whole
// steps, so that the order does not matter. Source: Kaplanyan and Dachsbacher, Cascaded Light Propagation Volumes for
// Real-Time Indirect Illumination, 2010, sections 3.1 (injection) and 3.3 (fuzzy blocking).

#define INJECTED 0  // words of outcomes (include/luxel/lpv_inject.h)
#define OUTSIDE 1
#define INVALID 2
#define SATURATED 3

FN void count_one(CTX, int word) {
    if (COUNT != 0) atomic_add(outcomes, word, 1u);
}

// The fourth component is unused.
FN vec4 three(vec4 v) { return vec4(v.x, v.y, v.z, 0.0f); }

// A sum of steps takes v, |v| <= 2. Each word is added to or subtracted from by itself; what wraps goes on to the next.
FN void add(CTX, int at, float v) {
    const bool minus = v < 0.0f;
    const uvec3 s = steps_of(abs(v));
    uint wrapped = 0u;
    if (s.x != 0u) {
        const uint before = atomic_add(sums, at, minus ? 0u - s.x : s.x);
        if (minus ? before < s.x : before + s.x < before) wrapped = 1u;
    }
    const uint middle = s.y + wrapped;
    wrapped = middle < s.y ? 1u : 0u;
    if (middle != 0u) {
        const uint before = atomic_add(sums, at + 1, minus ? 0u - middle : middle);
        if (minus ? before < middle : before + middle < before) wrapped = 1u;
    }
    const uint high = s.z + wrapped;
    if (high != 0u) atomic_add(sums, at + 2, minus ? 0u - high : high);
}

// Index of the cell (or corner) that holds q; -1 outside. A place on a face belongs to the cell behind it.
FN int cell_of(CTX, vec3 q) {
    const bool inside = q.x >= 0.0f && q.y >= 0.0f && q.z >= 0.0f && q.x < float(params.width) &&
                        q.y < float(params.height) && q.z < float(params.depth);
    if (!inside) return -1;
    return (int(q.z) * params.height + int(q.y)) * params.width + int(q.x);
}

// Coefficient i of the cosine lobe about n; without n the mean over all directions.
FN float lobe(int i, vec3 n) { return i == 0 ? sh_cosine(0, n) : dot3(n, n) == 0.0f ? 0.0f : sh_cosine(i, n); }

FN vec3 in_cells(CTX, vec4 place) {
    return params.per_cell * (vec3(place.x, place.y, place.z) - vec3(params.origin_x, params.origin_y, params.origin_z));
}

#if SURFELS
FN void inject(CTX, int k) {
    const vec4 place = load(lights, 2 * k);
    const vec4 facing = three(load(lights, 2 * k + 1));
    const vec3 n = unit(vec3(facing.x, facing.y, facing.z));
    float area = place.w * params.per_cell * params.per_cell;
    if (!finite(place) || !finite(facing) || !(area >= 0.0f && area <= 3.0e38f)) {
        count_one(ctx, INVALID);
        return;
    }
    const int cell = cell_of(ctx, in_cells(ctx, place) + params.offset * n + vec3(0.5f));
    if (cell < 0) {
        count_one(ctx, OUTSIDE);
        return;
    }
    if (area > params.most) count_one(ctx, SATURATED);
    area = min(area, params.most) * params.to_one;
    const int source = (k >= params.second ? 1 : 0) + (k >= params.third ? 1 : 0) + (k >= params.fourth ? 1 : 0);
    const int at = (source * params.width * params.height * params.depth + cell) * 12;
    UNROLL for (int i = 0; i < 4; ++i) {
        const float both = params.two_sided == 0 ? lobe(i, n) : i == 0 ? 2.0f * lobe(i, n) : 0.0f;
        add(ctx, at + 3 * i, area * both);
    }
    count_one(ctx, INJECTED);
}
#else
FN void inject(CTX, int k) {
    const vec4 place = three(load(lights, 3 * k));
    const vec4 facing = three(load(lights, 3 * k + 1));
    const vec4 all = three(load(lights, 3 * k + 2));
    const vec4 flux = COLOURS == 1 ? vec4(all.x, 0.0f, 0.0f, 0.0f) : all;
    if (!finite(place) || !finite(facing) || !finite(flux) || flux.x < 0.0f || flux.y < 0.0f || flux.z < 0.0f) {
        count_one(ctx, INVALID);
        return;
    }
    const vec3 n = unit(vec3(facing.x, facing.y, facing.z));
    const int cell = cell_of(ctx, in_cells(ctx, place) + params.offset * n);
    if (cell < 0) {
        count_one(ctx, OUTSIDE);
        return;
    }
    if (flux.x > params.most || flux.y > params.most || flux.z > params.most) count_one(ctx, SATURATED);
    const int functions = BANDS * BANDS;
    for (int c = 0; c < COLOURS; ++c) {
        // (flux / pi) <n|w>+: the axial intensity, of which the hemisphere's integral is the flux.
        const float own = c == 0 ? flux.x : c == 1 ? flux.y : flux.z;
        const float axial = 0.3183098861837907f * (min(own, params.most) * params.to_one);
        const int at = (cell * COLOURS + c) * functions * 3;
        UNROLL for (int i = 0; i < BANDS * BANDS; ++i) add(ctx, at + 3 * i, axial * lobe(i, n));
    }
    count_one(ctx, INJECTED);
}
#endif

KERNEL(lpv_inject) {
    for (int k = invocation_x(); k < params.count; k += params.stride) inject(ctx, k);
}
