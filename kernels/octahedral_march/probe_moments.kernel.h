// Mean and standard deviation of the distance around each direction, weighted by a power of the cosine (McGuire et al. 2017,
// 5.2, which stores means of r and r^2). As those of a mixture
//   mu = sum w mu_i,   sigma^2 = sum w (sigma_i^2 + (mu_i - mu)^2)
// nothing cancels, and half floats hold what their range holds.

FN float powered(float c, int n) {
    float result = 1.0f;
    float square = c;
    for (int k = n; k > 0; k = k / 2) {
        if (k % 2 == 1) result = result * square;
        square = square * square;
    }
    return result;
}

FN float weight_of(CTX, float c, float area) { return c > params.least ? area * powered(c, params.power) : 0.0f; }

// Adds what texel `at` weighs, and its mean or its second moment about mu times that.
FN vec2 added(CTX, vec2 sum, float c, float area, int at, bool about, float mu) {
    const float w = weight_of(ctx, c, area);
    if (w == 0.0f) return sum;
    const vec2 m = load_pixel(distances, 0, at, 0);
    return vec2(sum.x + w, sum.y + w * (about ? m.y * m.y + (m.x - mu) * (m.x - mu) : m.x));
}

// The weighted mean over the map of all means, or of all second moments about mu.
FN float gathered(CTX, int made, vec3 n, bool about, float mu) {
    const int half_size = params.reduced / 2;
    const int first = made * params.reduced * params.reduced;
    vec2 sum = vec2(0.0f, 0.0f);
    for (int v = 0; v < half_size; ++v)
        for (int u = 0; u < half_size; ++u) {
            const int k = 4 * (v * half_size + u);
            const float area = table(texels, k + 3);
            const float a = n.x * table(texels, k);
            const float b = n.y * table(texels, k + 1);
            const float c = n.z * table(texels, k + 2);
            const int right = first + half_size + u;
            const int left = first + half_size - 1 - u;
            const int down = (half_size + v) * params.reduced;
            const int up = (half_size - 1 - v) * params.reduced;
            sum = added(ctx, sum, c + a + b, area, down + right, about, mu);
            sum = added(ctx, sum, c - a + b, area, down + left, about, mu);
            sum = added(ctx, sum, c + a - b, area, up + right, about, mu);
            sum = added(ctx, sum, c - a - b, area, up + left, about, mu);
        }
    return sum.y / sum.x;
}

KERNEL(probe_moments) {
    const int i = invocation_x();
    const int made = invocation_y();
    if (i >= params.size * params.size || made >= params.probes) return;
#if LIST
    const int probe = int(load(list, made));
#else
    const int probe = made;
#endif
    const int x = i % params.size;
    const int y = i / params.size;
    const vec3 n = octahedral_direction(octahedral_centre(x, y, params.size));
    float mean = gathered(ctx, made, n, false, 0.0f);
    float variance = gathered(ctx, made, n, true, mean);
    const int own = bordered(probe, x, y, params.size);
#if PREVIOUS
    const vec2 before = load_pixel(previous, 0, own, 0);
    const vec2 zero = before - before;
    if (zero.x + zero.y == 0.0f) {
        const float mixed = mean + params.keep * (before.x - mean);
        const float old = before.y * before.y + (before.x - mixed) * (before.x - mixed);
        const float now = variance + (mean - mixed) * (mean - mixed);
        variance = now + params.keep * (old - now);
        mean = mixed;
    }
#endif
    const vec2 m = vec2(mean, sqrt(variance));
    const ivec3 mirrored = mirrored_places(probe, x, y, params.size);
    store_pixel(moments, 0, own, 0, m);
    store_pixel(moments, 0, mirrored.x, 0, m);
    store_pixel(moments, 0, mirrored.y, 0, m);
    store_pixel(moments, 0, mirrored.z, 0, m);
}
