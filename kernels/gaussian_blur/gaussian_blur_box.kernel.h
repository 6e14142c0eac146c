// One pass of a box of fractional width along one axis: the mean of 2 radius + 1 pixels and of a part of the next one on
// each side. Repeated, it tends to a Gaussian (Akenine-Moeller et al., Real-Time Rendering 4e, 12.1); the fractional width
// gives it the variance that is asked for (Gwosdek et al., Theoretical Foundations of Gaussian Convolution by Extended Box
// Filtering, 2011).
// Nothing is ever subtracted from a sum, so that a large value leaves no residue behind it. An invocation gives as many
// results as a window has pixels. Every one of their windows is a tail of the first window and a head of the pixels behind
// it (van Herk 1992): tails are summed backwards and kept, heads are summed on the way. To keep few of them, the first
// window is cut into chunks; a chunk's tails begin with the sum of the chunks behind it.

// The pixels at position i of PIXELS lines. `inside` says that nothing that the invocation reads lies outside.
FN wide at(CTX, int line, int i, bool inside) {
    const bool outside = !inside && (i < 0 || i >= params.src_count);
    if (BORDER == BORDER_ZERO && outside) return wide_splat(0.0f);
    if (ONES != 0) return wide_splat(1.0f);
    const int position = outside ? border_index(BORDER, i, params.src_count) : i;
    if (AXIS == 1 && (inside || line + PIXELS <= params.lines)) return load_wide(src, params.src_stride, line, position);
    wide w;
    UNROLL for (int k = 0; k < PIXELS; ++k) {
        const int other = inside ? line + k : min(line + k, params.lines - 1);
        set_pixel(w, k, load_pixel(src, params.src_stride, AXIS == 0 ? position : other, AXIS == 0 ? other : position));
    }
    return w;
}

FN void put(CTX, int line, int i, wide w, bool inside) {
    if (COVERED != 0) w = w / load(coverage, i);
    if (AXIS == 1 && inside) {
        store_wide(dst, params.dst_stride, line, i, w);
    } else {
        UNROLL for (int k = 0; k < PIXELS; ++k)
            if (inside || line + k < params.lines)
                store_pixel(dst, params.dst_stride, AXIS == 0 ? i : line + k, AXIS == 0 ? line + k : i, get_pixel(w, k));
    }
}

FN void blur(CTX, int line, int first, bool inside) {
    const int window = 2 * params.radius + 1;
    const int start = first + params.shift - params.radius;  // of the first result's window
    ARRAY(wide, behind, CHUNKS)
    wide sum = wide_splat(0.0f);
    for (int c = params.chunks - 1; c >= 0; --c) {
        behind[c] = sum;
        if (c > 0)
            for (int i = min((c + 1) * CHUNK, window) - 1; i >= c * CHUNK; --i) sum = sum + at(ctx, line, start + i, inside);
    }
    ARRAY(wide, tail, CHUNK)
    wide head = wide_splat(0.0f);
    wide before = at(ctx, line, start - 1, inside);
    for (int c = 0; c < params.chunks && first + c * CHUNK < params.dst_count; ++c) {
        sum = behind[c];
        for (int i = min((c + 1) * CHUNK, window) - 1; i >= c * CHUNK; --i) {
            sum = sum + at(ctx, line, start + i, inside);
            tail[i - c * CHUNK] = sum;
        }
        for (int i = c * CHUNK; i < min(min((c + 1) * CHUNK, window), params.dst_count - first); ++i) {
            const wide after = at(ctx, line, start + i + window, inside);
            wide mean = table(weights, 0) * (tail[i - c * CHUNK] + head) + table(weights, 1) * (before + after);
            if (KEEP_ALPHA != 0) mean = with_alpha_of(mean, at(ctx, line, start + i + params.radius, inside));
            put(ctx, line, first + i, mean, inside);
            head = head + after;
            before = at(ctx, line, start + i, inside);
        }
    }
}

KERNEL(gaussian_blur_box) {
    const int line = invocation_x() * PIXELS;
    const int window = 2 * params.radius + 1;
    const int first = invocation_y() * window;
    if (line >= params.lines || first >= params.dst_count) return;
    const int start = first + params.shift - params.radius;
    // Each form stands alone, so that no test for the border is left in the loops.
    if (start > 0 && start + 2 * window <= params.src_count && line + PIXELS <= params.lines)
        blur(ctx, line, first, true);
    else
        blur(ctx, line, first, false);
}
