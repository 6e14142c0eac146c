// The geometry volume as lpv_propagate reads it: a plane for each coefficient; CELLS: as it is, in f32.
KERNEL(lpv_blocking) {
    const int x = invocation_x();
    const int y = invocation_y();
    const int z = invocation_z();
    if (x >= (CELLS != 0 ? params.width : params.pitch) || y >= params.height || z >= params.depth) return;
    vec4 v = vec4(0.0f, 0.0f, 0.0f, 0.0f);
    if (x < params.width) v = load_voxel(geometry, ivec3(params.width, params.height, params.depth), ivec3(x, y, z));
    const int plane = CELLS != 0 ? 1 : params.plane;
    const int to = CELLS != 0 ? 4 * ((z * params.height + y) * params.width + x) : z * params.slice + y * params.pitch + x;
    store(planes, to, v.x);
    store(planes, to + plane, v.y);
    store(planes, to + 2 * plane, v.z);
    store(planes, to + 3 * plane, v.w);
}
