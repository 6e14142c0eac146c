// Uses every word of the dialect once, so that a driver or compiler that gets one wrong is known by name.
// dst: src, scaled, moved by a tap from the border. results, bits: one number per word. counters: atomics.

// 16 results an invocation: arithmetic that must give the same bits everywhere.
FN float arithmetic(CTX, int i, int which) {
    float a = load(numbers, i);
    float b = load(numbers, (i + 7) % 64);
    vec4 v = vec4(a, b, a - b, a * b);
    ivec2 n = ivec2(int(a * 8.0f), int(b * 8.0f));
    uvec2 u = uvec2(uint(abs(a) * 16.0f), params.seed + uint(i));
    if (which == 0) return a + b * 3.0f - a / (b * b + 1.0f);
    if (which == 1) return sqrt(abs(a)) + floor(b * 4.0f);
    if (which == 2) return min(a, b) + 2.0f * max(a, b) + clamp(a, -0.5f, 0.5f);
    if (which == 3) return v.x + v.y * 2.0f + v.z + v.w;
    if (which == 4) return float(n.x / 3 + n.y * 2 - (n.x << 1)) + float((u.x >> 1) ^ (u.y & 15u));
    if (which == 5) return uintBitsToFloat((floatBitsToUint(a) & 0x7fffffffu) | 0x3f000000u);
    if (which == 6) return a + 0.25f * (b - a);
    if (which == 7) return float(border_index(BORDER_MIRROR, n.x - 9, 5)) + 16.0f * float(border_index(BORDER_WRAP, n.y - 9, 5));
    if (which == 8) return isnan(a) || isinf(b) ? -1.0f : 1.0f;
    if (which == 9) return ceil(a * 3.0f) + sign(b);
    if (which == 10) return table(weights, i % 16) + BIAS * float(STEP);
    if (which == 11) return float(params.width) + params.scale * float(params.height);
    if (which == 12) return float(u.y & MASK);
    if (which == 13) return vec2(a, b).y + vec3(a, b, 1.0f).z;
    if (which == 14) return float(ivec3(i, i + 1, i + 2).z + local_y() + local_z() + group_y() + group_z() + invocation_z());
    return a * 1.0e-30f * 1.0e-10f;  // a denormal
}

KERNEL(probe) {
    const int i = invocation_x();
    const int y = invocation_y();
    const int x = i * PIXELS;
    FIRST {
        store(tile, local_x(), float(group_x() * 64 + local_x()));
    }
    THEN {
        // Another invocation's value: wrong where the barrier is missing.
        float neighbour = load(tile, 63 - local_x());
        if (y == 0 && i < 64) {
            for (int which = 0; which < 16; ++which) store(results, i * 16 + which, arithmetic(ctx, i, which));
            store(bits, i * 4, f16_bits(load(numbers, i)));
            store(bits, i * 4 + 1, unorm8_bits(load(numbers, i)));
            store(bits, i * 4 + 2, uint(neighbour));
            store(bits, i * 4 + 3, floatBitsToUint(f16_value(f16_bits(load(numbers, i)))));
        }
        atomic_add(counters, 0, 1u);
        atomic_max(counters, 1, uint(i));
        atomic_min(counters, 2, uint(1000 - i));
        atomic_compare_swap(counters, 3, 7u, 9u);
        if (y < params.height && x + PIXELS <= params.width) {
            wide w = params.scale * load_wide(src, params.width, x, y);
            wide far = wide_splat(0.0f);
            UNROLL for (int k = 0; k < PIXELS; ++k)
                set_pixel(far, k, load_pixel(linear_texels, params.width, border_index(BORDER_CLAMP, x + k + STEP, params.width), y));
            w = choose(wide_splat(1.0f), w + far, far);
            store_wide(dst, params.width, x, y, w);
            if (x == 0) store_pixel(dst, params.width, x, y, get_pixel(w, 0));
        }
    }
}
