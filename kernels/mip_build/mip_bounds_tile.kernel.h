// Three coarser levels of a pyramid of bounds in one dispatch of workgroups of 16 x 16: each keeps its part of a level
// for the next. Sizes are halved and rounded up. The same bits as mip_bounds, level by level.
#define TILE 16

FN RANGE fine(CTX, int x, int y) {
#if ONE
    float v = load_pixel(src, params.src_x, x, y);
    return vec2(v, v);
#else
    return load_pixel(src, params.src_x, x, y);
#endif
}

#if CHANNELS == 1 && ONE == 0
FN float wider(float a, float b) { return UPPER != 0 ? upper_of(a, b) : lower_of(a, b); }
#else
FN vec2 wider(vec2 a, vec2 b) { return vec2(lower_of(a.x, b.x), upper_of(a.y, b.y)); }
#endif

FN RANGE widest(RANGE a, RANGE b, RANGE c, RANGE d) { return wider(wider(wider(a, b), c), d); }

FN ivec2 halved(ivec2 e) { return ivec2((e.x + 1) >> 1, (e.y + 1) >> 1); }
FN bool within(ivec2 p, ivec2 e) { return p.x < e.x && p.y < e.y; }

// The first and the second of the pair of each axis that texel p covers, in a level of this extent.
FN ivec2 first_of(ivec2 p, ivec2 extent) { return min(2 * p, extent - 1); }
FN ivec2 second_of(ivec2 p, ivec2 extent) { return min(2 * p + 1, extent - 1); }

KERNEL(mip_bounds_tile) {
    const ivec2 extent = ivec2(params.src_x, params.src_y);
    const ivec2 extent_a = halved(extent);
    const ivec2 extent_b = halved(extent_a);
    const ivec2 extent_c = halved(extent_b);
    const ivec2 lane = ivec2(local_x(), local_y());
    const ivec2 group = ivec2(group_x(), group_y());
    FIRST {
        const ivec2 p = group * TILE + lane;
        const ivec2 a = first_of(p, extent);
        const ivec2 b = second_of(p, extent);
        RANGE v = widest(fine(ctx, a.x, a.y), fine(ctx, b.x, a.y), fine(ctx, a.x, b.y), fine(ctx, b.x, b.y));
#if OUTWARD
        v = in_double(params.src_x) ? v : outward_f16(v);
#endif
        if (within(p, extent_a)) store_pixel(dst_a, extent_a.x, p.x, p.y, v);
        store(tile, lane.y * TILE + lane.x, v);
    }
    THEN {
        if (within(lane, ivec2(TILE / 2, TILE / 2))) {
            const ivec2 p = group * (TILE / 2) + lane;
            const ivec2 a = first_of(p, extent_a) - group * TILE;
            const ivec2 b = second_of(p, extent_a) - group * TILE;
            const RANGE v = widest(load(tile, a.y * TILE + a.x), load(tile, a.y * TILE + b.x),
                                   load(tile, b.y * TILE + a.x), load(tile, b.y * TILE + b.x));
            if (within(p, extent_b)) store_pixel(dst_b, extent_b.x, p.x, p.y, v);
            store(small, lane.y * (TILE / 2) + lane.x, v);
        }
    }
    THEN {
        const ivec2 p = group * (TILE / 4) + lane;
        if (within(lane, ivec2(TILE / 4, TILE / 4)) && within(p, extent_c)) {
            const ivec2 a = first_of(p, extent_b) - group * (TILE / 2);
            const ivec2 b = second_of(p, extent_b) - group * (TILE / 2);
            const RANGE v = widest(load(small, a.y * (TILE / 2) + a.x), load(small, a.y * (TILE / 2) + b.x),
                                   load(small, b.y * (TILE / 2) + a.x), load(small, b.y * (TILE / 2) + b.x));
            store_pixel(dst_c, extent_c.x, p.x, p.y, v);
        }
    }
}
