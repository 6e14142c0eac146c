// Means from sums; where nothing is 0, or what the volume under it has. An invocation makes the eight voxels of a brick's row.

FN float sum_of(CTX, int at) { return float_of_64(uvec2(load(sums, at), load(carries, at))); }

// Never below one step: of unorm8, or of 2^-14, in which opacity is summed.
FN float at_least_a_step(float coverage) { return max(coverage, UNORM != 0 ? 1.0f / 255.0f : 1.0f / 16384.0f); }

// Whether anything shares in a voxel.
FN bool touched(CTX, int voxel) {
    const uint first = load(sums, voxel * params.words);
    return OF == OF_PACKED ? first >> 24 != 0u : (first | load(carries, voxel * params.words)) != 0u;
}

// The mean of a voxel that is touched.
FN vec4 mean_of(CTX, int voxel) {
    const int base = voxel * params.words;
    if (OF == OF_PACKED) {
        const uint bits = load(sums, base);
        const float share = unorm8_value(bits >> 24);
        return vec4(unorm8_value(bits & 255u), unorm8_value((bits >> 8) & 255u), unorm8_value((bits >> 16) & 255u),
                    params.opacity != 0 ? share : 1.0f);
    }
    const float weight = 16384.0f * sum_of(ctx, base);
    const int at = base + (OF == OF_COLOUR ? 1 : params.at);
    const vec3 mean = vec3(sum_of(ctx, at) / weight, sum_of(ctx, at + 1) / weight, sum_of(ctx, at + 2) / weight);
    if (OF == OF_COLOUR)
        return vec4(mean.x, mean.y, mean.z,
                    params.at > 0 ? at_least_a_step(sum_of(ctx, base + params.at) / weight) : 1.0f);
    if (OF == OF_NORMAL) {
        if (UNORM != 0) return vec4(mean.x, mean.y, mean.z, 0.0f);  // n/2 + 1/2
        return vec4(2.0f * mean.x - 1.0f, 2.0f * mean.y - 1.0f, 2.0f * mean.z - 1.0f, 0.0f);
    }
    const float scale = 16384.0f * params.emission_unit;
    return vec4(scale * mean.x, scale * mean.y, scale * mean.z, 0.0f);
}

FN void put(CTX, ivec3 p, vec4 v) {
    const ivec3 stored = ivec3(params.stored_x, params.stored_y, params.stored_z);
    store_voxel(dst, stored, torus(p + ivec3(params.turn_x, params.turn_y, params.turn_z), stored), v);
}

#ifdef OVER
#define NOTHING_AT(p) load_voxel(under, ivec3(params.stored_x, params.stored_y, params.stored_z), p)
#else
#define NOTHING_AT(p) vec4(0.0f)
#endif

// Of row (y, z) of the grid, the voxels that lie in a brick of a slot (0: none) and in the region.
FN void resolve_row(CTX, int brick_x, int y, int z, uint slot) {
    const int first_x = max(brick_x * BRICK, params.first_x);
    const int last_x = min(brick_x * BRICK + (BRICK - 1), params.last_x);
    if (slot == 0u) {
        for (int x = first_x; x <= last_x; ++x) put(ctx, ivec3(x, y, z), vec4(0.0f));
        return;
    }
    const int row = (int(slot) - 1) * BRICK_VOXELS + linear_of(ivec3(0, y % BRICK, z % BRICK), ivec3(BRICK, BRICK, BRICK));
    uint occupied = 0u;
    for (int x = first_x; x <= last_x; ++x) {
        // Zeros apart: packing them takes no time.
        if (touched(ctx, row + x % BRICK)) {
            put(ctx, ivec3(x, y, z), mean_of(ctx, row + x % BRICK));
            ++occupied;
        } else {
            put(ctx, ivec3(x, y, z), NOTHING_AT(ivec3(x, y, z)));
        }
    }
    if ((OF == OF_COLOUR || OF == OF_PACKED) && occupied > 0u) atomic_add(counters, COUNT_OCCUPIED, occupied);
}

KERNEL(voxelize_resolve) {
    const ivec3 grid = blocks_of(ivec3(params.width, params.height, params.depth), BRICK);
    if (TOUCHED != 0) {
        const int rows = int(min(load(counters, COUNT_BRICKS), uint(params.capacity))) * (BRICK * BRICK);
        for (int i = invocation_x(); i < rows; i += params.stride) {
            const int number = i / (BRICK * BRICK);
            const ivec3 brick = position_of(int(load(brick_list, number)), grid);
            const int y = brick.y * BRICK + i % BRICK;
            const int z = brick.z * BRICK + i / BRICK % BRICK;
            if (y >= params.first_y && y <= params.last_y && z >= params.first_z && z <= params.last_z)
                resolve_row(ctx, brick.x, y, z, uint(number) + 1u);
        }
        return;
    }
    const ivec3 at = ivec3(params.first_x / BRICK + invocation_x(), params.first_y + invocation_y(),
                           params.first_z + invocation_z());
    if (at.x * BRICK > params.last_x || at.y > params.last_y || at.z > params.last_z) return;
    resolve_row(ctx, at.x, at.y, at.z, load(slots, linear_of(ivec3(at.x, at.y / BRICK, at.z / BRICK), grid)));
}
