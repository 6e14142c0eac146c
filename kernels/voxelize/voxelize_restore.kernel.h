// The bricks that a moving object touched hold again what is under it. An invocation copies the eight voxels of a row.

KERNEL(voxelize_restore) {
    const ivec3 extent = ivec3(params.width, params.height, params.depth);
    const int rows = int(min(load(left_counters, COUNT_BRICKS), uint(params.capacity))) * (BRICK * BRICK);
    for (int i = invocation_x(); i < rows; i += params.stride) {
        const ivec3 corner = BRICK * position_of(int(load(left_bricks, i / (BRICK * BRICK))), blocks_of(extent, BRICK));
        const int y = corner.y + i % BRICK;
        const int z = corner.z + i / BRICK % BRICK;
        if (y >= extent.y || z >= extent.z) continue;
        for (int x = corner.x; x < min(corner.x + BRICK, extent.x); ++x)
            store_voxel(dst, extent, ivec3(x, y, z), load_voxel(under, extent, ivec3(x, y, z)));
    }
}
