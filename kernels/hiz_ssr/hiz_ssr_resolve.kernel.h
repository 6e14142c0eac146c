// Radiance in the specular lobe from the hits of rays: of the pixel's own mirror ray, or of the sampled rays of pixels around it
// as well, each weighted by the ratio of this pixel's lobe to the density that it was drawn with (Stachowiak, Stochastic
// Screen-Space Reflections, 2015). Colour comes from a pyramid, at the width of the part of the lobe that a ray stands for.

#define HIT 1
#define MISS 2
#define CAPPED 5

FN vec4 blend(vec4 a, vec4 b, float f) { return a + f * (b - a); }

// Texels of a level of colour, which halve and round down, in the buffer: a multiple of 64.
FN int texels_of(int n, int level) { return max(n >> level, 1); }
FN int room_of(CTX, int level) {
    return (texels_of(params.width, level) * texels_of(params.height, level) + 63) / 64 * 64;
}

// Bilinear in a level, between the nearest centres.
FN vec4 colour_between(CTX, vec2 uv, int level, int place) {
    const int nx = texels_of(params.width, level);
    const int ny = texels_of(params.height, level);
    const float qx = clamp(uv.x * float(nx) - 0.5f, 0.0f, float(nx - 1));
    const float qy = clamp(uv.y * float(ny) - 0.5f, 0.0f, float(ny - 1));
    const int x = int(qx);
    const int y = int(qy);
    const int right = x + 1 < nx ? 1 : 0;
    const int down = y + 1 < ny ? nx : 0;
    const int at = place + y * nx + x;
    const float fx = qx - float(x);
    return blend(blend(load(colour, at), load(colour, at + right), fx),
                 blend(load(colour, at + down), load(colour, at + down + right), fx), qy - float(y));
}

// Colour over `wide_part` pixels: below one the very pixel that was hit, which never mixes what lies beside an edge of depth.
FN vec4 colour_over(CTX, vec2 uv, float wide_part) {
    const int x = min(int(uv.x * float(params.width)), params.width - 1);
    const int y = min(int(uv.y * float(params.height)), params.height - 1);
    const vec4 own = load(colour, y * params.width + x);
    if (!(wide_part > 1.0f) || params.top == 0) return own;
    int level = 0;
    int place = 0;
    float size = 1.0f;
    while (level + 1 < params.top && 2.0f * size <= wide_part) {
        place += room_of(ctx, level);
        size = 2.0f * size;
        ++level;
    }
    const vec4 fine = level == 0 ? own : colour_between(ctx, uv, level, place);
    const vec4 coarse = colour_between(ctx, uv, level + 1, place + room_of(ctx, level));
    return blend(fine, coarse, min(wide_part / size - 1.0f, 1.0f));
}

FN vec3 sight_of(CTX, vec2 p) {
    return vec3((p.x - params.centre_x) / params.focal_x, (params.centre_y - p.y) / params.focal_y, -1.0f);
}

#if FACTOR
FN vec2 split_sum_at(CTX, float cosine, float roughness) {
    const int n = params.table_size;
    const float qx = clamp(cosine * float(n) - 0.5f, 0.0f, float(n - 1));
    const float qy = clamp(roughness * float(n) - 0.5f, 0.0f, float(n - 1));
    const int x = min(int(qx), n - 2);
    const int y = min(int(qy), n - 2);
    const float fx = qx - float(x);
    const float fy = qy - float(y);
    const int i = 2 * (y * n + x);
    const int j = i + 2 * n;
    const float a = (1.0f - fy) * ((1.0f - fx) * load(split_sum, i) + fx * load(split_sum, i + 2)) +
                    fy * ((1.0f - fx) * load(split_sum, j) + fx * load(split_sum, j + 2));
    const float b = (1.0f - fy) * ((1.0f - fx) * load(split_sum, i + 1) + fx * load(split_sum, i + 3)) +
                    fy * ((1.0f - fx) * load(split_sum, j + 1) + fx * load(split_sum, j + 3));
    return vec2(a, b);
}
#endif

// Of one pixel.
FN void resolve_pixel(CTX, ivec2 at) {
    const int i = at.y * params.width + at.x;
    const vec4 facing = load(normals, i);
    const float w = reciprocal_depth(load_pixel(depth, 0, i, 0), DEPTH, params.depth_scale, params.depth_offset);
    if (!is_surface(w) || !(facing.w < params.cutoff)) {
        store(radiance, i, vec4(0.0f));
        return;
    }
#if STOCHASTIC || FACTOR
    const vec3 n = unit(vec3(facing.x, facing.y, facing.z));
    const vec3 sight = sight_of(ctx, vec2(float(at.x) + 0.5f, float(at.y) + 0.5f));
    const vec3 v = unit(vec3(-sight.x, -sight.y, -sight.z));
    const float n_v = dot3(n, v);
#endif
    const int traced_x = (params.width + params.scale - 1) / params.scale;
    const ivec2 middle = ivec2(at.x / params.scale, at.y / params.scale);
    vec4 sum = vec4(0.0f);  // the fourth: weights of what was seen
    float weights = 0.0f;
#if STOCHASTIC
    const int traced_y = (params.height + params.scale - 1) / params.scale;
    const float alpha = alpha_of(facing.w);
    const vec3 place = sight / w;
    const float taken = float((2 * params.reuse + 1) * (2 * params.reuse + 1) * params.each);
    for (int y = max(middle.y - params.reuse, 0); y <= min(middle.y + params.reuse, traced_y - 1); ++y)
        for (int x = max(middle.x - params.reuse, 0); x <= min(middle.x + params.reuse, traced_x - 1); ++x)
            for (int k = 0; k < params.each; ++k) {
                const int ray = (k * traced_y + y) * traced_x + x;
                const int outcome = int(load(paths, ray).y);
                if (outcome < HIT || outcome > CAPPED || !(n_v > 0.0f)) continue;
                const vec4 hit = load(hits, ray);
                const vec4 drawn = load(directions, ray);
                vec3 l = vec3(drawn.x, drawn.y, drawn.z);
                float far_away = 0.0f;
                if (outcome == HIT) {
                    const vec3 to = hit.z * sight_of(ctx, vec2(hit.x * float(params.width), hit.y * float(params.height))) - place;
                    far_away = sqrt(dot3(to, to));
                    l = unit(to);
                }
                const float n_l = dot3(n, l);
                if (!(n_l > 0.0f)) continue;
                const vec3 h = unit(v + l);
                const vec3 side = cross3(n, h);
                const float density = ggx_density(dot3(n, h), dot3(side, side), alpha);
                const float weight = density * ggx_seen_both(n_v, n_l, alpha) / (4.0f * n_v * drawn.w);
                if (!(weight > 0.0f && weight < 1.0e20f)) continue;
                weights += weight;
                if (outcome == HIT && hit.w > 0.0f) {
                    // The disc of the solid angle 1 / (density * rays) at the hit, as the image shows it.
                    const float across = 2.0f * sqrt(1.0f / (3.14159265358979f * drawn.w * taken)) * far_away;
                    const vec4 seen = colour_over(ctx, vec2(hit.x, hit.y), params.prefilter * across * params.focal_y / hit.z);
                    const float known = weight * hit.w;
                    if (finite(seen)) sum = sum + vec4(known * seen.x, known * seen.y, known * seen.z, known);
                }
            }
#else
    const int ray = middle.y * traced_x + middle.x;
    const vec4 path = load(paths, ray);
    if (int(path.y) >= HIT && int(path.y) <= CAPPED) {
        weights = 1.0f;
        const vec4 hit = load(hits, ray);
        if (hit.w > 0.0f) {
            const float r = 64.0f * clamp(facing.w, 0.0f, 1.0f);
            const int step = min(int(r), 63);
            const float spread = table(spreads, step) + (r - float(step)) * (table(spreads, step + 1) - table(spreads, step));
            const vec4 seen = colour_over(ctx, vec2(hit.x, hit.y), params.prefilter * spread * path.x * params.focal_y / hit.z);
            if (finite(seen)) sum = vec4(hit.w * seen.x, hit.w * seen.y, hit.w * seen.z, hit.w);
        }
    }
#endif
    const float known = weights > 0.0f ? sum.w / weights : 0.0f;
#if FALLBACK
    const vec4 beside = load(fallback, i);
#else
    const vec4 beside = vec4(params.environment_r, params.environment_g, params.environment_b, 0.0f);
#endif
    const float part = weights > 0.0f ? 1.0f / weights : 0.0f;
    const float rest = 1.0f - known;
    vec4 result = vec4(part * sum.x + rest * beside.x, part * sum.y + rest * beside.y, part * sum.z + rest * beside.z, known);
#if FACTOR
    const vec2 ab = split_sum_at(ctx, max(n_v, 0.0f), clamp(facing.w, 0.0f, 1.0f));
    const vec4 f0 = load(specular, i);
    result = vec4(result.x * (f0.x * ab.x + ab.y), result.y * (f0.y * ab.x + ab.y), result.z * (f0.z * ab.x + ab.y), result.w);
#endif
    store(radiance, i, result);
}

KERNEL(hiz_ssr_resolve) {
    const int side = TILE * params.scale;
    const int tiles_x = (params.width + side - 1) / side;
    const int count = int(load(tile_list, 0)) * side * side;
    for (int j = invocation_x(); j < count; j += params.stride) {
        const int tile = int(load(tile_list, 1 + j / (side * side)));
        const int x = tile % tiles_x * side + j % side;
        const int y = tile / tiles_x * side + j / side % side;
        if (x < params.width && y < params.height) resolve_pixel(ctx, ivec2(x, y));
    }
}
