// Eight independent chains of multiplications and additions, in registers: what a driver's kernels can compute.
// A product and a sum, not contracted, as all kernels here are compiled.
#define STEP(v) v = m * v + a;
#define STEPS STEP(v0) STEP(v1) STEP(v2) STEP(v3) STEP(v4) STEP(v5) STEP(v6) STEP(v7)

KERNEL(limit_arithmetic) {
    const int x = invocation_x();
    if (x >= params.width) return;
    const wide m = wide_splat(params.scale);
    const wide a = wide_splat(params.shift);
    wide v0 = wide_splat(float(x));
    wide v1 = v0 + a;
    wide v2 = v1 + a;
    wide v3 = v2 + a;
    wide v4 = v3 + a;
    wide v5 = v4 + a;
    wide v6 = v5 + a;
    wide v7 = v6 + a;
    for (int i = 0; i < params.rounds; ++i) {
        STEPS STEPS STEPS STEPS STEPS STEPS STEPS STEPS
    }
    store_wide(dst, params.width * PIXELS, x * PIXELS, 0, ((v0 + v1) + (v2 + v3)) + ((v4 + v5) + (v6 + v7)));
}
