// Clears words.

KERNEL(lpv_zero) {
    for (int i = invocation_x(); i < params.count; i += params.stride) store(words, i, 0u);
}
