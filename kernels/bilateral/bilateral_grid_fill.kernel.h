// Bilateral grid (Chen, Paris, Durand 2007): pixels are added to the nearest cell in x, y and luminance. An invocation owns a
// column of cells and the pixels nearest to it: the sums' order is fixed.

#if CHANNELS == 1
#define COLOUR_OF(v) vec4(v, 0.0f, 0.0f, 1.0f)
#elif CHANNELS == 2
#define COLOUR_OF(v) vec4((v).x, (v).y, 0.0f, 1.0f)
#else
#define COLOUR_OF(v) vec4((v).x, (v).y, (v).z, 1.0f)
#endif

KERNEL(bilateral_grid_fill) {
    const int column = invocation_x();
    const int row = invocation_y();
    if (column >= params.columns || row >= params.rows) return;
    const int at = row * params.columns + column;
    const int layer = params.columns * params.rows;
    for (int b = 0; b < params.bins; ++b) store(grid, b * layer + at, vec4(0.0f));
    // Cells are centred on multiples of their side, the first on pixel 0.
    const int left = max(column * params.cell - params.cell / 2, 0);
    const int top = max(row * params.cell - params.cell / 2, 0);
    const int right = min(column * params.cell - params.cell / 2 + params.cell, params.width);
    const int bottom = min(row * params.cell - params.cell / 2 + params.cell, params.height);
    for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x) {
            const pixel v = load_pixel(src, params.src_stride, x, y);
            const vec4 colour = COLOUR_OF(v);
            const vec4 zero = colour - colour;
            if (!((zero.x + zero.y) + zero.z == 0.0f)) continue;
            const float b = (luminance_of(v) - params.low) * params.per_step + 0.5f;
            const int bin = b >= 1.0f ? (b < float(params.bins) ? int(b) : params.bins - 1) : 0;
            store(grid, bin * layer + at, load(grid, bin * layer + at) + colour);
        }
}
