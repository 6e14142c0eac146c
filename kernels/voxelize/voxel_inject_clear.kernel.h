// Nothing is anywhere yet.

KERNEL(voxel_inject_clear) {
    for (int i = invocation_x(); i < params.count; i += params.stride) store_pixel(radiance, 0, i, 0, vec4(0.0f));
}
