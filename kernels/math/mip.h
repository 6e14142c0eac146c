// One axis of a pyramid: which of the n fine texels make coarse texel i of m, and how they are averaged. Every mean is
// written so that equal values give that value, bit for bit, and so that no weight rounds. Each pair is
// halved at once, so that nothing overflows below half of the largest float.
#ifdef SCALAR_MEANS
#define MEAN_TYPE float
#else
#define MEAN_TYPE pixel
#endif
#define MIP_COPY 0      // n = 1
#define MIP_PAIR 1      // n = 2m: the mean of two
#define MIP_TRIPLE 2    // n = 2m+1: the area of the coarse texel, ((m-i) s(2i) + m s(2i+1) + (i+1) s(2i+2)) / n
#define MIP_VERTEX 3    // n = 2m-1, samples on vertices: 1-2-1 round 2i, mirrored at the ends
#define MIP_SMOOTH 4    // n = 2m, samples in cells: 1-3-3-1, the ends repeated
#define MIP_SMOOTH_ODD 5  // n = 2m+1, samples in cells: 1-2-1, then the area as above

FN int mip_taps(int mode) { return mode < MIP_TRIPLE ? mode + 1 : max(mode, 3); }

// The fine texel of tap k.
FN int mip_tap(int mode, int i, int k, int n) {
    if (mode == MIP_COPY) return i;
    if (mode <= MIP_TRIPLE) return 2 * i + k;
    int at = 2 * i + k - 1;
    if (mode == MIP_VERTEX) return at < 0 ? 1 : (at >= n ? n - 2 : at);
    return clamp(at, 0, n - 1);
}

FN MEAN_TYPE mip_pair(MEAN_TYPE a, MEAN_TYPE b) { return 0.5f * (a + b); }
FN MEAN_TYPE mip_121(MEAN_TYPE a, MEAN_TYPE b, MEAN_TYPE c) { return 0.5f * b + 0.25f * (a + c); }

FN MEAN_TYPE mip_triple(MEAN_TYPE a, MEAN_TYPE b, MEAN_TYPE c, int i, int m, int n) {
    return b + (float(m - i) / float(n) * (a - b) + float(i + 1) / float(n) * (c - b));
}

// The mean of the taps of coarse texel i.
FN MEAN_TYPE mip_mean(int mode, MEAN_TYPE t[5], int i, int m, int n) {
    if (mode == MIP_COPY) return t[0];
    if (mode == MIP_PAIR) return mip_pair(t[0], t[1]);
    if (mode == MIP_TRIPLE) return mip_triple(t[0], t[1], t[2], i, m, n);
    if (mode == MIP_VERTEX) return mip_121(t[0], t[1], t[2]);
    if (mode == MIP_SMOOTH) {
        MEAN_TYPE inner = mip_pair(t[1], t[2]);
        return inner + 0.25f * (mip_pair(t[0], t[3]) - inner);
    }
    return mip_triple(mip_121(t[0], t[1], t[2]), mip_121(t[1], t[2], t[3]), mip_121(t[2], t[3], t[4]), i, m, n);
}
