// Where injected light is: a flag for each run of PIXELS cells (CELLS: for each cell), and the largest c0.
KERNEL(lpv_reach) {
    const int x = CELLS != 0 ? invocation_x() : invocation_x() * PIXELS;
    const int y = invocation_y();
    const int z = invocation_z();
    if (x >= params.width || y >= params.height || z >= params.depth) return;
    uint some = 0u;
    uint most = 0u;
    if (CELLS != 0) {
        const int cells = params.width * params.height * params.depth;
        const int cell = (z * params.height + y) * params.width + x;
        for (int plane = 0; plane < params.planes; ++plane) {
            const float c = load_pixel(travelling, 0, 4 + 4 * (plane / 4 * cells + cell) + plane % 4, 0);
            const uint bits = floatBitsToUint(abs(c));
            some = some | bits;
            if (plane % params.coefficients == 0) most = max(most, bits);
        }
        store(reached, cell, some != 0u ? 1u : 0u);
        if (most != 0u) atomic_max(state, 1, most);
        return;
    }
    for (int plane = 0; plane < params.planes; ++plane) {
        const wide c = load_wide(travelling, 0, 3 * params.pitch + plane * params.plane + z * params.slice + y * params.pitch + x, 0);
        for (int k = 0; k < PIXELS && x + k < params.width; ++k) {
            const uint bits = floatBitsToUint(abs(get_pixel(c, k)));
            some = some | bits;
            if (plane % params.coefficients == 0) most = max(most, bits);
        }
    }
    store(reached, (z * params.height + y) * ((params.width + PIXELS - 1) / PIXELS) + invocation_x(), some != 0u ? 1u : 0u);
    if (most != 0u) atomic_max(state, 1, most);
}
