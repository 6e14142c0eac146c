// One direction along one axis of a recursive Gaussian: a cascade of one-pole filters in difference form,
//   y(i) = y(i-1) + (1 - p) (x(i) - y(i-1)),
// whose poles are those of van Vliet, Young and Verbeek, Recursive Gaussian Derivative Filters (1998), moved to the sigma
// that is asked for. A constant stays constant to the bit, and rounding does not grow as sigma^3 as it does in direct form.
// For a pair of complex poles p, p* the state is complex, z += (1 - p)(x - z), and the real result of both poles is
//   y = Re z + g Im z,  g = (Re p - |p|^2) / Im p.
// For small sigma the Gaussian is a product of zeros instead (Jacobi's triple product), y(i) = x(i) + c (x(i-1) - x(i)).
// An invocation filters PIXELS neighbouring lines: forward from the image to the kept lines, then backward to the image.

// The pixels at position i of the invocation's lines.
FN wide image_at(CTX, int line, int i) {
    if (ONES != 0) return wide_splat(1.0f);
    const int at = border_index(BORDER, i, params.count);
    if (AXIS == 1 && line + PIXELS <= params.lines) return load_wide(src, params.image_stride, line, at);
    wide w;
    UNROLL for (int k = 0; k < PIXELS; ++k) {
        const int other = min(line + k, params.lines - 1);
        set_pixel(w, k, load_pixel(src, params.image_stride, AXIS == 0 ? at : other, AXIS == 0 ? other : at));
    }
    return w;
}

FN wide kept_at(CTX, int i) {
    return load_wide(src, params.kept_stride, invocation_x() * params.kept_group, i < params.stored ? i : i - params.period);
}

FN void keep(CTX, int i, wide w) { store_wide(dst, params.kept_stride, invocation_x() * params.kept_group, i, w); }

FN void put(CTX, int line, int i, wide w) {
    if (BORDER == BORDER_ZERO && ONES == 0) w = w / load(coverage, i);
    if (AXIS == 1 && line + PIXELS <= params.lines) {
        store_wide(dst, params.image_stride, line, i, w);
    } else {
        UNROLL for (int k = 0; k < PIXELS; ++k)
            if (line + k < params.lines)
                store_pixel(dst, params.image_stride, AXIS == 0 ? i : line + k, AXIS == 0 ? line + k : i, get_pixel(w, k));
    }
}

FN wide times_row(CTX, int row, wide s0, wide s1, wide s2, wide s3, wide s4) {
    const int at = 8 + 5 * row;
    return table(coefficients, at) * s0 + table(coefficients, at + 1) * s1 + table(coefficients, at + 2) * s2 +
           table(coefficients, at + 3) * s3 + table(coefficients, at + 4) * s4;
}

KERNEL(gaussian_blur_recursive) {
    const int line = invocation_x() * PIXELS;
    if (line >= params.lines) return;
    const bool periodic = BORDER == BORDER_WRAP || BORDER == BORDER_MIRROR;
    const int last = params.count - 1;

    // The state that a constant would have left: the first value that is read, or 0 where outside is nothing.
    wide still = wide_splat(0.0f);
    if (BORDER != BORDER_ZERO)
        still = BACKWARD != 0 ? kept_at(ctx, last + params.warm) : image_at(ctx, line, -params.warm);
    wide s0 = still;
    wide s1 = still;
    wide s2 = ZEROS != 0 ? still : wide_splat(0.0f);
    wide s3 = s1;
    wide s4 = s2;
    // Backward, a line that ends begins with what the forward filter would have gone on to give (Triggs and Sdika,
    // Boundary Conditions for Young-van Vliet Recursive Filtering, 2006): linear in the state that it left.
    if (BACKWARD != 0 && !periodic) {
        s0 = kept_at(ctx, params.stored);
        s1 = kept_at(ctx, params.stored + 1);
        s2 = kept_at(ctx, params.stored + 2);
        s3 = kept_at(ctx, params.stored + 3);
        s4 = kept_at(ctx, params.stored + 4);
        if (BORDER == BORDER_CLAMP) still = kept_at(ctx, params.stored + 5);
    }

    wide x = still;
    for (int i = -params.warm; i < (BACKWARD != 0 ? params.count : params.stored); ++i) {
        if (CLOSED != 0 && i == 0) {
            const wide still_imaginary = ZEROS != 0 ? still : wide_splat(0.0f);
            const wide d0 = s0 - still;
            const wide d1 = s1 - still;
            const wide d2 = s2 - still_imaginary;
            const wide d3 = s3 - still;
            const wide d4 = s4 - still_imaginary;
            s0 = still + times_row(ctx, 0, d0, d1, d2, d3, d4);
            s1 = still + times_row(ctx, 1, d0, d1, d2, d3, d4);
            s2 = still_imaginary + times_row(ctx, 2, d0, d1, d2, d3, d4);
            s3 = still + times_row(ctx, 3, d0, d1, d2, d3, d4);
            s4 = still_imaginary + times_row(ctx, 4, d0, d1, d2, d3, d4);
        }
        x = BACKWARD != 0 ? kept_at(ctx, last - i) : image_at(ctx, line, i);
        wide y = x;
        if (ZEROS != 0) {
            wide next = y + table(coefficients, 0) * (s0 - y);
            s0 = y;
            y = next + table(coefficients, 1) * (s1 - next);
            s1 = next;
            next = y + table(coefficients, 2) * (s2 - y);
            s2 = y;
            y = next + table(coefficients, 3) * (s3 - next);
            s3 = next;
            next = y + table(coefficients, 4) * (s4 - y);
            s4 = y;
            y = next;
        } else {
            if (ORDER != 4) {
                s0 = s0 + table(coefficients, 0) * (y - s0);
                y = s0;
            }
            const wide e = y - s1;
            s1 = s1 + (table(coefficients, 1) * e - table(coefficients, 2) * s2);
            s2 = s2 - (table(coefficients, 1) * s2 + table(coefficients, 2) * e);
            y = s1 + table(coefficients, 3) * s2;
            if (ORDER != 3) {
                const wide f = y - s3;
                s3 = s3 + (table(coefficients, 4) * f - table(coefficients, 5) * s4);
                s4 = s4 - (table(coefficients, 4) * s4 + table(coefficients, 5) * f);
                y = s3 + table(coefficients, 6) * s4;
            }
        }
        if (KEEP_ALPHA != 0) y = with_alpha_of(y, x);
        if (i >= 0) {
            if (BACKWARD != 0) put(ctx, line, last - i, y);
            else keep(ctx, i, y);
        }
    }
    if (BACKWARD == 0 && !periodic) {
        keep(ctx, params.stored, s0);
        keep(ctx, params.stored + 1, s1);
        keep(ctx, params.stored + 2, s2);
        keep(ctx, params.stored + 3, s3);
        keep(ctx, params.stored + 4, s4);
        keep(ctx, params.stored + 5, x);
    }
}
