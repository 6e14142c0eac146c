// Cosine-weighted irradiance of probes for every direction of a receiver's normal n (McGuire et al., Real-Time Global
// Illumination using Precomputed Light Field Probes, 2017, 5.2):
//   E(n) = pi sum w L / sum w,   w = max(0, n A),   A = int d dw over a texel,
// so that the weights of texels above the horizon are exact for radiance that is even within them, and even radiance is kept.

KERNEL(probe_irradiance) {
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
    const int half_size = params.reduced / 2;
    const int first = made * params.reduced * params.reduced;
    vec4 sum = vec4(0.0f);
    // Four texels that mirror each other in the planes x = 0 and y = 0.
    for (int v = 0; v < half_size; ++v) {
        vec4 row = vec4(0.0f);  // sums of few terms keep more digits
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
            row = row + (area * max(0.0f, c + a + b)) * load(means, down + right);
            row = row + (area * max(0.0f, c - a + b)) * load(means, down + left);
            row = row + (area * max(0.0f, c + a - b)) * load(means, up + right);
            row = row + (area * max(0.0f, c - a - b)) * load(means, up + left);
        }
        sum = sum + row;
    }
    vec4 e = sum.w > 0.0f ? (3.14159265358979f / sum.w) * vec4(sum.x, sum.y, sum.z, 0.0f) : vec4(0.0f);
    const int own = bordered(probe, x, y, params.size);
#if PREVIOUS
    const vec4 before = load_pixel(previous, 0, own, 0);
    const vec4 zero = before - before;
    if (zero.x + zero.y + zero.z == 0.0f) e = e + params.keep * (vec4(before.x, before.y, before.z, 0.0f) - e);
#endif
    e = vec4(e.x, e.y, e.z, 1.0f);
    const ivec3 mirrored = mirrored_places(probe, x, y, params.size);
    store_pixel(irradiance, 0, own, 0, e);
    store_pixel(irradiance, 0, mirrored.x, 0, e);
    store_pixel(irradiance, 0, mirrored.y, 0, e);
    store_pixel(irradiance, 0, mirrored.z, 0, e);
}
