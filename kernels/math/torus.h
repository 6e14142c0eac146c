// Volumes that are addressed modulo their extent: a window that moves leaves what it still holds where it is.
FN int turned(int p, int n) { return p >= n ? p - n : p; }
// p: 0 .. 2 extents - 1.
FN ivec3 torus(ivec3 p, ivec3 extent) {
    return ivec3(turned(p.x, extent.x), turned(p.y, extent.y), turned(p.z, extent.z));
}
