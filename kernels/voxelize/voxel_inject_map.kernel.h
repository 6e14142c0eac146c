// Texels of a reflective shadow map into the sums of their voxels: irradiance in whole steps, so that their order does not
// matter, and how many there are.

#define MOST_STEPS 16384.0f  // of a texel, as the host's unit has it

FN void count_one(CTX, int word) {
    if (COUNT != 0) atomic_add(outcomes, word, 1u);
}

FN void add(CTX, int at, float irradiance) {
    const float steps = params.per_unit * irradiance;
    if (steps > MOST_STEPS) count_one(ctx, INJECT_SATURATED);
    const uint whole = uint(int(min(steps, MOST_STEPS) + 0.5f));
    const uint before = atomic_add(sums, at, whole);
    if (before + whole < before) count_one(ctx, INJECT_SATURATED);
}

KERNEL(voxel_inject_map) {
    const int x = invocation_x();
    const int y = invocation_y();
    if (x >= params.map_width || y >= params.map_height) return;
    const int i = y * params.map_width + x;
    const vec4 place = load(map, 2 * i);
    if (!(place.w > 0.0f)) return;
    const vec4 irradiance = load(map, 2 * i + 1);
    const ivec3 extent = ivec3(params.width, params.height, params.depth);
    const bool inside = place.x >= 0.0f && place.y >= 0.0f && place.z >= 0.0f && place.x < float(extent.x) &&
                        place.y < float(extent.y) && place.z < float(extent.z);
    const float sum = irradiance.x + irradiance.y + irradiance.z;
    if (!inside || !(irradiance.x >= 0.0f && irradiance.y >= 0.0f && irradiance.z >= 0.0f && sum - sum == 0.0f)) {
        count_one(ctx, INJECT_DROPPED);
        return;
    }
    const ivec3 p = ivec3(int(place.x), int(place.y), int(place.z));
    const ivec3 bricks = lit_bricks(extent, TORUS);
    const ivec3 in_bricks = p + TORUS * ivec3(params.inner_x, params.inner_y, params.inner_z);
    const ivec3 b = in_bricks / LIT_BRICK;
    const ivec3 stored = TORUS == 0 ? p : torus(p + ivec3(params.turn_x, params.turn_y, params.turn_z), extent);
    const uint slot = load(slots, (b.z * bricks.y + b.y) * bricks.x + b.x);
    if (slot == 0u || !(load_voxel(colour, extent, stored).w > 0.0f)) {
        count_one(ctx, INJECT_DROPPED);
        return;
    }
    const ivec3 in_brick = in_bricks - LIT_BRICK * b;
    const int at = ((int(slot) - 1) * LIT_BRICK_VOXELS + (in_brick.z * LIT_BRICK + in_brick.y) * LIT_BRICK + in_brick.x) * 4;
    add(ctx, at, irradiance.x);
    add(ctx, at + 1, irradiance.y);
    add(ctx, at + 2, irradiance.z);
    atomic_add(sums, at + 3, 1u);
}
