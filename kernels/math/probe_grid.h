// A grid of probes and the cages of eight between them (include/luxel/octahedral_march.h). Corner i of a cage lies at
// x = i & 1, y = i >> 1 & 1, z = i >> 2. Points outside the grid belong to the nearest cage.
FN int probe_index(ivec3 at, ivec3 count) { return at.x + count.x * (at.y + count.y * at.z); }

// Along one axis: the lower probe of the cage around p, 0 .. count - 2 (0 where there is one probe).
FN int cage_low(float p, float origin, float spacing, int count) {
    const float last = float(max(count - 2, 0));
    const float q = (p - origin) / spacing;
    return q > 0.0f ? int(floor(min(q, last))) : 0;
}
FN ivec3 cage_of(vec3 p, vec3 origin, vec3 spacing, ivec3 count) {
    return ivec3(cage_low(p.x, origin.x, spacing.x, count.x), cage_low(p.y, origin.y, spacing.y, count.y),
                 cage_low(p.z, origin.z, spacing.z, count.z));
}
// Along an axis with one probe, both corners are that probe: then corners with this bit are given twice.
FN bool cage_corner_again(int i, ivec3 count) {
    return ((i & 1) != 0 && count.x == 1) || ((i & 2) != 0 && count.y == 1) || ((i & 4) != 0 && count.z == 1);
}
FN ivec3 cage_corner(ivec3 low, int i, ivec3 count) {
    return ivec3(min(low.x + (i & 1), count.x - 1), min(low.y + ((i >> 1) & 1), count.y - 1), min(low.z + (i >> 2), count.z - 1));
}
// Where a regular grid has probe `at`.
FN vec3 probe_place(ivec3 at, vec3 origin, vec3 spacing) {
    return vec3(origin.x + float(at.x) * spacing.x, origin.y + float(at.y) * spacing.y, origin.z + float(at.z) * spacing.z);
}
