// An image as planes of floats that reach beyond both ends of a row, filled as the border asks. A pixel that is not
// finite, and what is outside where outside is nothing, must weigh nothing: it is given a value so far from all others
// that no weight is left; where colours do not weigh, bilateral_mark tells by that value.

FN void put(CTX, int p, int x, int y, float v) { store_pixel(planes, params.pitch, x, p * params.height + y, v); }

KERNEL(bilateral_split) {
    const int x = invocation_x();
    const int y = invocation_y();
    if (x >= params.pitch || y >= params.height) return;
    const int at = x - params.pad;
    const bool outside = BORDER == BORDER_ZERO && (at < 0 || at >= params.width);
#if SRC_CHANNELS == 1
    const float v = load_pixel(src, params.src_stride, border_index(BORDER, at, params.width), y);
    const float zero = v - v;
#elif SRC_CHANNELS == 2
    const vec2 v = load_pixel(src, params.src_stride, border_index(BORDER, at, params.width), y);
    const float zero = (v.x - v.x) + (v.y - v.y);
#else
    const vec4 v = load_pixel(src, params.src_stride, border_index(BORDER, at, params.width), y);
    const float zero = (v.x - v.x) + (v.y - v.y) + (v.z - v.z) + (v.w - v.w);
#endif
    const bool marked = MARK != 0 && (outside || !(zero == 0.0f));
    const float mark = 1.32922800e36f;
#if SRC_CHANNELS == 1
    put(ctx, params.first, x, y, marked ? mark : params.scale * v + params.offset);
#else
    put(ctx, params.first, x, y, marked ? mark : params.scale * v.x + params.offset);
    if (COUNT > 1) put(ctx, params.first + 1, x, y, marked ? mark : params.scale * v.y + params.offset);
#endif
#if SRC_CHANNELS == 4
    if (COUNT > 2) put(ctx, params.first + 2, x, y, marked ? mark : params.scale * v.z + params.offset);
    if (COUNT > 3) put(ctx, params.first + 3, x, y, marked ? mark : params.scale * v.w + params.offset);
#endif
}
