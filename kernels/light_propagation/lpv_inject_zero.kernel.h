// Clears sums and counts.

KERNEL(lpv_inject_zero) {
    for (int i = invocation_x(); i < params.count; i += params.stride) store(words, i, 0u);
}
