// Three coarser levels of the isotropic pyramid in one dispatch: each workgroup keeps its part of a level for the next.
// The same bits as mip_average, level by level.

FN ivec3 halved(ivec3 e) { return ivec3((e.x + 1) >> 1, (e.y + 1) >> 1, (e.z + 1) >> 1); }
FN bool within(ivec3 p, ivec3 e) { return p.x < e.x && p.y < e.y && p.z < e.z; }

FN pixel fine(CTX, int x, int y, int z) {
#if BY_ROWS
    pixel v = as_loaded(load_pixel(src, params.src_x, x, z * params.src_y + y), params.src_x);
#else
    const ivec3 extent = ivec3(params.src_x, params.src_y, params.src_z);
    pixel v = as_loaded(load_voxel(src, extent, ivec3(x, y, z)), params.src_x);
#endif
    if (params.clean != 0) v = drop_hidden_colour(v);
    return to_steps(v);
}

FN pixel from_tile(CTX, int x, int y, int z) { return load(tile, (z * TILE_Y + y) * TILE_X + x); }
FN pixel from_small(CTX, int x, int y, int z) { return load(small, (z * (TILE_Y / 2) + y) * (TILE_X / 2) + x); }

// The first and the second of the pair of each axis that texel p covers, in a level of this extent; along an axis of
// extent 1 they are one.
FN ivec3 first_of(ivec3 p, ivec3 extent) { return min(2 * p, extent - 1); }
FN ivec3 second_of(ivec3 p, ivec3 extent) { return min(2 * p + 1, extent - 1); }

// The mean of eight (four where the tile is flat) along z, y, x, as mip_average takes it.
#define COLUMN(from, x, y) (TILE_Z > 1 ? mip_pair(from(ctx, x, y, a.z), from(ctx, x, y, b.z)) : from(ctx, x, y, a.z))
#define MEAN(from) \
    mip_pair(mip_pair(COLUMN(from, a.x, a.y), COLUMN(from, a.x, b.y)), \
             mip_pair(COLUMN(from, b.x, a.y), COLUMN(from, b.x, b.y)))

KERNEL(mip_average_tile) {
    const ivec3 extent = ivec3(params.src_x, params.src_y, params.src_z);
    const ivec3 extent_a = halved(extent);
    const ivec3 extent_b = halved(extent_a);
    const ivec3 extent_c = halved(extent_b);
    const ivec3 lane = ivec3(local_x(), local_y(), local_z());
    const ivec3 group = ivec3(group_x(), group_y(), group_z());
    const ivec3 size = ivec3(TILE_X, TILE_Y, TILE_Z);
    FIRST {
        const ivec3 p = group * size + lane;
        const ivec3 a = first_of(p, extent);
        const ivec3 b = second_of(p, extent);
        const pixel v = MEAN(fine);
        if (within(p, extent_a)) store_voxel(dst_a, extent_a, p, from_steps(v, params.src_x));
        store(tile, (lane.z * TILE_Y + lane.y) * TILE_X + lane.x, rounded(v, params.src_x));
    }
    THEN {
        const ivec3 half_size = halved(size);
        if (within(lane, half_size)) {
            const ivec3 p = group * half_size + lane;
            const ivec3 a = first_of(p, extent_a) - group * size;
            const ivec3 b = second_of(p, extent_a) - group * size;
            const pixel v = MEAN(from_tile);
            if (within(p, extent_b)) store_voxel(dst_b, extent_b, p, from_steps(v, params.src_x));
            store(small, (lane.z * half_size.y + lane.y) * half_size.x + lane.x, rounded(v, params.src_x));
        }
    }
    THEN {
        const ivec3 half_size = halved(size);
        const ivec3 quarter = halved(half_size);
        const ivec3 p = group * quarter + lane;
        if (within(lane, quarter) && within(p, extent_c)) {
            const ivec3 a = first_of(p, extent_b) - group * half_size;
            const ivec3 b = second_of(p, extent_b) - group * half_size;
            const pixel v = MEAN(from_small);
            store_voxel(dst_c, extent_c, p, from_steps(v, params.src_x));
        }
    }
}
