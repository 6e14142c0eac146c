// Sums of steps into coefficients, four a pixel.

FN float sum_at(CTX, int at) {
    return value_of_steps(uvec3(load(sums, at), load(sums, at + 1), load(sums, at + 2))) * params.from_one * params.scale;
}
FN vec4 four_at(CTX, int at) {
    return vec4(sum_at(ctx, at), sum_at(ctx, at + 3), sum_at(ctx, at + 6), sum_at(ctx, at + 9));
}

FN void resolve(CTX, int cell) {
    const int functions = BANDS * BANDS;
    for (int c = 0; c < COLOURS; ++c) {
        const int at = (cell * COLOURS + c) * functions * 3;
        vec4 first = four_at(ctx, at);
        // Several sources see the same surfaces: adding them would count these twice, and the largest of each coefficient
        // would turn with the axes. The whole function with the larger mean stands.
        for (int s = 1; s < SOURCES; ++s) {
            const vec4 other = four_at(ctx, at + s * params.cells * 12);
            if (other.x > first.x) first = other;
        }
        if (KEPT != 0) {
            const vec4 other = load_pixel(kept, 0, cell, 0);
            if (other.x > first.x) first = other;
        }
        const int quads = BANDS == 3 ? 3 : 1;
        store_pixel(volume, 0, c * quads * params.cells + cell, 0, first);
        if (BANDS == 3) {
            store_pixel(volume, 0, (c * quads + 1) * params.cells + cell, 0, four_at(ctx, at + 12));
            store_pixel(volume, 0, (c * quads + 2) * params.cells + cell, 0,
                        vec4(sum_at(ctx, at + 24), 0.0f, 0.0f, 0.0f));
        }
    }
}

KERNEL(lpv_inject_resolve) {
    for (int cell = invocation_x(); cell < params.cells; cell += params.stride) resolve(ctx, cell);
}
