// Means from sums; 0 where nothing is. An invocation makes the eight voxels of a brick's row.

FN float sum_of(CTX, int at) { return float_of_64(uvec2(load(sums, at), load(carries, at))); }

// Never below one step: of unorm8, or of 2^-14, in which opacity is summed.
FN float at_least_a_step(float coverage) { return max(coverage, UNORM != 0 ? 1.0f / 255.0f : 1.0f / 16384.0f); }

FN vec4 mean_of(CTX, int voxel) {
    const int base = voxel * params.words;
    if (OF == OF_PACKED) {
        const uint bits = load(sums, base);
        const float share = unorm8_value(bits >> 24);
        if (bits >> 24 == 0u) return vec4(0.0f);
        return vec4(unorm8_value(bits & 255u), unorm8_value((bits >> 8) & 255u), unorm8_value((bits >> 16) & 255u),
                    params.opacity != 0 ? share : 1.0f);
    }
    const float weight = 16384.0f * sum_of(ctx, base);
    if (weight == 0.0f) return vec4(0.0f);
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

KERNEL(voxelize_resolve) {
    const ivec3 extent = ivec3(params.width, params.height, params.depth);
    const int brick_x = params.first_x / BRICK + invocation_x();
    const ivec3 first = ivec3(max(brick_x * BRICK, params.first_x), params.first_y + invocation_y(),
                              params.first_z + invocation_z());
    const int last_x = min(brick_x * BRICK + (BRICK - 1), params.last_x);
    if (first.x > last_x || first.y > params.last_y || first.z > params.last_z) return;
    const uint slot = load(slots, linear_of(first / BRICK, blocks_of(extent, BRICK)));
    if (slot == 0u) {
        for (int x = first.x; x <= last_x; ++x) store_voxel(dst, extent, ivec3(x, first.y, first.z), vec4(0.0f));
        return;
    }
    const int row = linear_of(ivec3(0, first.y % BRICK, first.z % BRICK), ivec3(BRICK, BRICK, BRICK));
    uint occupied = 0u;
    for (int x = first.x; x <= last_x; ++x) {
        const vec4 mean = mean_of(ctx, (int(slot) - 1) * BRICK_VOXELS + row + x % BRICK);
        if (mean.w > 0.0f) ++occupied;
        store_voxel(dst, extent, ivec3(x, first.y, first.z), mean);
    }
    if ((OF == OF_COLOUR || OF == OF_PACKED) && occupied > 0u) atomic_add(counters, COUNT_OCCUPIED, occupied);
}
