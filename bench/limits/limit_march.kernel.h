// Every read's address is the last value read, for a random number of steps an invocation: what a driver can march.

FN uint scrambled(uint v) {
    const uint state = v * 747796405u + 2891336453u;
    const uint word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}

KERNEL(limit_march) {
    const int i = invocation_x();
    if (i >= params.invocations) return;
    const uint h = scrambled(uint(i));
    const int steps = 1 + int(h % uint(params.steps));
    float at = float(int(scrambled(h) % uint(params.entries)));
    for (int k = 0; k < steps; ++k) at = load_pixel(links, 0, int(at), 0);
    store(dst, i, at);
}
