// What the parts of voxelize agree on: triangle records, blocks and bricks of a grid, counters.
#define TRIANGLE_WORDS 12   // three vertices in 2^-16 voxel, in lexicographic order; material; triangle of the mesh; turned
#define BRICK 8             // voxels along a brick's side
#define BRICK_VOXELS 512

#define COUNT_BLOCKS 0      // pieces of 64^3 and of 8^3 voxels that triangles touch
#define COUNT_PIECES 1
#define COUNT_BRICKS 2      // bricks touched
#define COUNT_FRAGMENTS 3   // pairs of voxel and triangle
#define COUNT_OCCUPIED 4    // voxels
#define COUNT_SATURATED 5   // times that a voxel's mean lost its count (moving_average)
#define COUNT_NOT_FINITE 6  // triangles of device vertices: with a NaN or an infinity
#define COUNT_BAD_INDEX 7   // with an index beyond the vertices
#define COUNT_FAR 8         // beyond what the integers hold, though their bounds meet the grid

FN ivec3 blocks_of(ivec3 extent, int side) { return (extent + (side - 1)) / side; }
FN int linear_of(ivec3 p, ivec3 extent) { return (p.z * extent.y + p.y) * extent.x + p.x; }
FN ivec3 position_of(int i, ivec3 extent) {
    return ivec3(i % extent.x, i / extent.x % extent.y, i / extent.x / extent.y);
}

// First and last voxel of a region (first..last) that a closed span of 2^-16 voxels meets; none where the last lies before
// the first.
FN ivec3 first_voxel(ivec3 low, ivec3 first) { return max((low - 1) >> 16, first); }
FN ivec3 last_voxel(ivec3 high, ivec3 last) { return min(high >> 16, last); }

// The next one of first..last, x first; after the last one lies beyond it along z.
FN ivec3 following(ivec3 p, ivec3 first, ivec3 last) {
    if (p.x < last.x) return ivec3(p.x + 1, p.y, p.z);
    if (p.y < last.y) return ivec3(first.x, p.y + 1, p.z);
    return ivec3(first.x, first.y, p.z + 1);
}
