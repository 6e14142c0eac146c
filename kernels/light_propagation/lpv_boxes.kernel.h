// Where steps can find light: the box of injected light and a ring of cells more a step. For lpv_start (what steps read, hence
// a ring around the last one's) and then for each step nine words: workgroups, first cell and end along x, y, z.
FN int groups_of(int cells, int each) { return (cells + each - 1) / each; }

KERNEL(lpv_boxes) {
    const int step = invocation_x();
    if (step > params.steps) return;
    const int rings = step == 0 ? params.steps + 1 : step;
    const bool none = load(state, params.at + 3) == 0u;
    int first[3];
    int end[3];
    UNROLL for (int axis = 0; axis < 3; ++axis) {
        const int extent = axis == 0 ? params.width : axis == 1 ? params.height : params.depth;
        first[axis] = extent - int(load(state, params.at + axis)) - rings;
        end[axis] = int(load(state, params.at + 3 + axis)) + rings;
        if (axis == 0) {  // whole runs; wides reach into the runs beside theirs
            const int more = step == 0 && params.run > 1 ? params.run : 0;
            first[0] = first[0] - more;
            end[0] = end[0] + more;
        }
        if (PERIODIC != 0 && (first[axis] < 0 || end[axis] > extent)) {
            first[axis] = 0;
            end[axis] = extent;
        }
        first[axis] = max(first[axis], 0);
        end[axis] = min(end[axis], extent);
        if (axis == 0) {
            first[0] = first[0] / params.run * params.run;
            end[0] = end[0] >= extent ? params.columns : groups_of(end[0], params.run) * params.run;
        }
        if (none) end[axis] = first[axis];
    }
    const int to = 9 * step;
    const int runs = step == 0 ? end[0] - first[0] : groups_of(end[0] - first[0], params.run);
    const int slices = (end[2] - first[2]) * (step == 0 ? params.channels : 1);
    store(boxes, to, uint(groups_of(runs, step == 0 ? params.start_x : params.step_x)));
    store(boxes, to + 1, uint(groups_of(end[1] - first[1], step == 0 ? params.start_y : params.step_y)));
    store(boxes, to + 2, uint(groups_of(slices, step == 0 ? params.start_z : params.step_z)));
    UNROLL for (int axis = 0; axis < 3; ++axis) {
        store(boxes, to + 3 + axis, uint(first[axis]));
        store(boxes, to + 6 + axis, uint(end[axis]));
    }
}
