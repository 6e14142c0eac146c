// Texels of the eight probes around receivers, at addresses that no value read decides but the receiver's: what a driver can read.

KERNEL(limit_probe) {
    const int x = invocation_x();
    const int y = invocation_y();
    if (x >= params.width || y >= params.height) return;
    const int i = y * params.width + x;
    const vec4 place = load(receivers, 2 * i);
    const vec4 facing = load(receivers, 2 * i + 1);
    // Neighbours have neighbouring cages and texels.
    const int cage_x = x * (params.count_x - 1) / params.width;
    const int cage_y = y * (params.count_y - 1) / params.height;
    const int cage_z = (x + y) * (params.count_z - 1) / (params.width + params.height);
    const int side = params.light_size + 2;
    const int wide_side = params.moments_size + 2;
    const int first = (1 + y * params.light_size / params.height) * side + 1 + x * params.light_size / params.width;
    vec4 sum = place + facing;
    UNROLL for (int k = 0; k < 8; ++k) {
        const int probe = min(cage_x + k % 2, params.count_x - 1) +
                          params.count_x * (min(cage_y + k / 2 % 2, params.count_y - 1) +
                                            params.count_y * min(cage_z + k / 4, params.count_z - 1));
        const int a = probe * side * side + first;
        const int b = probe * wide_side * wide_side + (1 + (y + 3 * k) % params.moments_size) * wide_side +
                      1 + (x + 5 * k) % params.moments_size;
        sum = sum + load_pixel(light, 0, a, 0);
        sum.x += load_pixel(moments, 0, b, 0).x;
        sum.y += load_pixel(moments, 0, b, 0).y;
        if (CORNERS == 4) {
            sum = sum + load_pixel(light, 0, a + 1, 0) + load_pixel(light, 0, a + side, 0) + load_pixel(light, 0, a + side + 1, 0);
            sum.x += load_pixel(moments, 0, b + 1, 0).x + load_pixel(moments, 0, b + wide_side, 0).x + load_pixel(moments, 0, b + wide_side + 1, 0).x;
            sum.y += load_pixel(moments, 0, b + 1, 0).y + load_pixel(moments, 0, b + wide_side, 0).y + load_pixel(moments, 0, b + wide_side + 1, 0).y;
        }
    }
    store(dst, i, sum);
}
