// An image of four channels with rows that reach beyond both ends, for bilateral_packed; as bilateral_split marks them, pixels
// that are not finite are 2^120.

KERNEL(bilateral_pack) {
    const int px = invocation_x();
    const int y = invocation_y();
    if (px >= params.pitch || y >= params.height) return;
    vec4 v = load_pixel(src, params.src_stride, border_index(BORDER, px - params.pad, params.width), y);
    const float mark = 1.32922800e36f;
    if (GUIDE != 0) {
        if (load_pixel(colours, params.pitch, px, y).x >= 1.0e36f) v.x = uintBitsToFloat(0x7fc00000u);
    } else {
        // Alpha that is not finite spoils the pixel also where it is only copied.
        const bool finite = (v.x - v.x) + (v.y - v.y) + (v.z - v.z) + (v.w - v.w) == 0.0f;
        if (!finite) v = vec4(mark, mark, mark, mark);
    }
    store_pixel(packed, params.pitch, px, y, v);
}
