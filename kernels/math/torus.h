// Volumes that are addressed modulo their extent: a window that moves leaves what it still holds where it is.
FN int wrapped_once(int p, int n) { return p >= n ? p - n : p; }
// p: 0 .. 2 extents - 1.
FN ivec3 torus(ivec3 p, ivec3 extent) {
    return ivec3(wrapped_once(p.x, extent.x), wrapped_once(p.y, extent.y), wrapped_once(p.z, extent.z));
}
