// The box of cells that injected light is in: along x, y, z the extent less the first cell, then the end; zeros where there
// is none. An invocation looks along a row.
KERNEL(lpv_bounds) {
    const int y = invocation_x();
    const int z = invocation_y();
    if (y >= params.height || z >= params.depth) return;
    const int runs = (params.width + params.run - 1) / params.run;
    int first = runs;
    int end = 0;
    for (int i = 0; i < runs; ++i)
        if (load(reached, (z * params.height + y) * runs + i) != 0u) {
            first = min(first, i);
            end = i + 1;
        }
    if (end == 0) return;
    atomic_max(state, params.at, uint(params.width - first * params.run));
    atomic_max(state, params.at + 1, uint(params.height - y));
    atomic_max(state, params.at + 2, uint(params.depth - z));
    atomic_max(state, params.at + 3, uint(min(end * params.run, params.width)));
    atomic_max(state, params.at + 4, uint(y + 1));
    atomic_max(state, params.at + 5, uint(z + 1));
}
