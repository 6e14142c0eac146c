// A list of the marked items behind its length, and a walk along it. done: how often each item was met, then the number of
// workgroups that ran.

#if MAKE
KERNEL(probe_list) {
    if (invocation_x() != 0) return;
    uint length = 0u;
    for (int i = 0; i < params.items; ++i)
        if (load(marked, i) != 0u) {
            store(list, 1 + int(length), uint(i));
            ++length;
        }
    store(list, 0, length);
    store(counts, 0, 77u);  // the counts begin at the second element
    store(counts, 1, groups_for(length, params.workgroup, params.most));
    store(counts, 2, 1u);
    store(counts, 3, 1u);
}
#else
KERNEL(probe_list) {
    if (local_x() == 0) atomic_add(done, params.items, 1u);
    const int length = int(load(list, 0));
    for (int i = invocation_x(); i < length; i += params.stride) atomic_add(done, int(load(list, 1 + i)), 1u);
}
#endif
