// What the parts of voxel_inject agree on.
#define LIT_BRICK 8             // voxels along the side of a brick, as voxelize has it
#define LIT_BRICK_VOXELS 512
#define LIT_COUNT_BRICKS 2      // word of voxelize's counters: touched bricks

#define INJECT_LIT 0            // words of the outcomes
#define INJECT_UNLIT 1
#define INJECT_DROPPED 2
#define INJECT_SATURATED 3

#define LIGHT_SUN 0             // kinds of lights
#define LIGHT_POINT 1
#define LIGHT_PATCH 2

// A window's bricks lie at multiples of 8 voxels of the world, in a grid that is a brick larger.
FN ivec3 lit_bricks(ivec3 extent, int torus_) { return (extent + (LIT_BRICK - 1)) / LIT_BRICK + torus_; }

// Voxel v of brick b of a grid of bricks.
FN ivec3 lit_voxel(int b, int v, ivec3 bricks) {
    return LIT_BRICK * ivec3(b % bricks.x, b / bricks.x % bricks.y, b / bricks.x / bricks.y) + ivec3(v & 7, (v >> 3) & 7, v >> 6);
}
FN bool in_grid(ivec3 p, ivec3 extent) {
    return p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < extent.x && p.y < extent.y && p.z < extent.z;
}
FN float inner(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
