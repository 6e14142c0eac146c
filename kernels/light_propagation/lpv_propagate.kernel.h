// One step: every cell gathers what its six neighbours send through their faces towards it (Kaplanyan and Dachsbacher 2010,
// section 4.3). A neighbour's light crosses the shared face and leaves through one of the cell's five others; the flux of
// each becomes a cosine lobe along that face's normal in the middle of the cell.
//
// `src` as lpv_start lays it out: three rows (nothing; 1 where there is a cell to the left; 1 where there is one to the
// right), then a plane [z][y][x] for each coefficient of each channel. An invocation makes PIXELS neighbouring cells.
#if BANDS == 3
#define COEFFICIENTS 9
#else
#define COEFFICIENTS 4
#endif

FN int wrapped(int i, int n) { return PERIODIC == 0 ? i : i < 0 ? i + n : i >= n ? i - n : i; }

// First value of the row of cells (y, z) of plane `at`.
FN int row_of(CTX, int at, int y, int z) {
    return 3 * params.pitch + at * params.plane + z * params.slice + y * params.pitch;
}

// The coefficient of plane `at` in the cells whose neighbours these are: a step along an axis.
FN wide tap(CTX, int at, int x, int y, int z, int axis, int step) {
    if (axis != 0) {
        const int j = wrapped(axis == 1 ? y + step : y, params.height);
        const int k = wrapped(axis == 2 ? z + step : z, params.depth);
        const bool inside = j >= 0 && j < params.height && k >= 0 && k < params.depth;
        return load_wide(src, 0, x + (inside ? row_of(ctx, at, j, k) : 0), 0);
    }
    const int row = row_of(ctx, at, y, z);
    if (PIXELS == 1) {
        const int i = wrapped(x + step, params.width);
        return load_wide(src, 0, i >= 0 && i < params.width ? row + i : 0, 0);
    }
    const wide near = load_wide(src, 0, row + x + step, 0);
    wide far = wide_splat(0.0f);
    if (PERIODIC != 0) far = load_wide(src, 0, row + x + step - step * params.width, 0);
    return choose(load_wide(src, 0, params.pitch * (step < 0 ? 1 : 2) + x, 0), near, far);
}

#if BLOCKED
// Coefficient i of the blocking at the corner (x, y, z) of the cells.
FN wide corner(CTX, int i, int x, int y, int z) {
    return load_wide(geometry, 0, i * params.geometry_plane + z * params.geometry_slice + y * params.geometry_pitch + x, 0);
}
#endif

#if ACTIVE
// Whether light has come to the run of cells i of row (y, z).
FN bool lit(CTX, int i, int y, int z) {
    const int runs = (params.width + PIXELS - 1) / PIXELS;
    const int a = wrapped(i, runs);
    const int b = wrapped(y, params.height);
    const int c = wrapped(z, params.depth);
    const bool inside = a >= 0 && a < runs && b >= 0 && b < params.height && c >= 0 && c < params.depth;
    return inside && load(reached, inside ? (c * params.height + b) * runs + a : 0) != 0u;
}
#endif

KERNEL(lpv_propagate) {
#if ACTIVE
    const int box = 9 * (params.step + 1);
    const int x = int(load(boxes, box + 3)) + invocation_x() * PIXELS;
    const int y = int(load(boxes, box + 4)) + invocation_y();
    const int z = int(load(boxes, box + 5)) + invocation_z();
    if (x >= int(load(boxes, box + 6)) || y >= int(load(boxes, box + 7)) || z >= int(load(boxes, box + 8))) return;
#else
    const int x = invocation_x() * PIXELS;
    const int y = invocation_y();
    const int z = APART != 0 ? invocation_z() % params.depth : invocation_z();
#endif
    const int first = APART != 0 ? invocation_z() / params.depth : 0;
    const int last = APART != 0 ? first + 1 : params.channels;
    if (x >= params.width || y >= params.height || z >= params.depth || last > params.channels) return;
#if ACTIVE
    // Where no light has come, both buffers hold nothing and both sums what lpv_start put there.
    if (params.error > 0.0f) {
        const float most = uintBitsToFloat(load(state, 1 + params.step));
        if (most <= params.error * uintBitsToFloat(load(state, 1))) return;
    }
    const int run = x / PIXELS;
    if (invocation_x() == 0 && invocation_y() == 0 && invocation_z() == 0) store(state, 0, uint(params.step + 1));
    const int flag = (z * params.height + y) * ((params.width + PIXELS - 1) / PIXELS) + run;
    const bool before = lit(ctx, run, y, z);
    const bool around = lit(ctx, run - 1, y, z) || lit(ctx, run + 1, y, z) || lit(ctx, run, y - 1, z) ||
                        lit(ctx, run, y + 1, z) || lit(ctx, run, y, z - 1) || lit(ctx, run, y, z + 1);
    if (!before && !around) {
        store(reaches, flag, 0u);
        return;
    }
    uint some = 0u;  // bits of any coefficient but its sign
    uint most = 0u;  // of the largest c0
#endif
#if BLOCKED
    // What passes of light that goes through face n / 2, n % 2 of the cell and on through face k: 1 - B(-w), with B the mean
    // of the face's four corners.
    wide passes[30];
    {
        wide b[24];
        UNROLL for (int i = 0; i < 4; ++i) {
            const wide c000 = corner(ctx, i, x, y, z);
            const wide c001 = corner(ctx, i, x + 1, y, z);
            const wide c010 = corner(ctx, i, x, y + 1, z);
            const wide c011 = corner(ctx, i, x + 1, y + 1, z);
            const wide c100 = corner(ctx, i, x, y, z + 1);
            const wide c101 = corner(ctx, i, x + 1, y, z + 1);
            const wide c110 = corner(ctx, i, x, y + 1, z + 1);
            const wide c111 = corner(ctx, i, x + 1, y + 1, z + 1);
            b[i] = (c000 + c010) + (c100 + c110);
            b[4 + i] = (c001 + c011) + (c101 + c111);
            b[8 + i] = (c000 + c001) + (c100 + c101);
            b[12 + i] = (c010 + c011) + (c110 + c111);
            b[16 + i] = (c000 + c001) + (c010 + c011);
            b[20 + i] = (c100 + c101) + (c110 + c111);
        }
        UNROLL for (int n = 0; n < 6; ++n) {
            const int axis = n >> 1;
            const float back = (n & 1) == 0 ? -1.0f : 1.0f;  // against the way the light goes
            const wide all = 0.07052369794346953f * b[4 * n];  // Y0 / 4
            const wide along = b[4 * n + lobe_axis(axis)];
            const wide t = 0.05462742152960396f * b[4 * n + lobe_axis((axis + 1) % 3)];  // Y1 / (4 sqrt(5))
            const wide u = 0.05462742152960396f * b[4 * n + lobe_axis((axis + 2) % 3)];
            const wide side = all + (back * 0.10925484305920792f) * along;  // 2 Y1 / (4 sqrt(5))
            passes[5 * n] = wide_splat(1.0f) - lobe_saturate(all + (back * 0.12215062797572998f) * along);  // Y1 / 4
            passes[5 * n + 1] = wide_splat(1.0f) - lobe_saturate(side - t);
            passes[5 * n + 2] = wide_splat(1.0f) - lobe_saturate(side + t);
            passes[5 * n + 3] = wide_splat(1.0f) - lobe_saturate(side - u);
            passes[5 * n + 4] = wide_splat(1.0f) - lobe_saturate(side + u);
        }
    }
#endif

    for (int channel = first; channel < last; ++channel) {
        // Fluxes into the faces of the cell from inside: +x, -x, +y, -y, +z, -z.
        wide face[6];
        UNROLL for (int n = 0; n < 6; ++n) face[n] = wide_splat(0.0f);
        UNROLL for (int n = 0; n < 6; ++n) {
            const int axis = n >> 1;
            const int t = (axis + 1) % 3;
            const int u = (axis + 2) % 3;
            const int step = (n & 1) == 0 ? -1 : 1;  // to the neighbour; its light goes the other way
            const float way = -float(step);
            const int at = channel * COEFFICIENTS;
            const wide c0 = tap(ctx, at, x, y, z, axis, step);
            const wide along = tap(ctx, at + lobe_axis(axis), x, y, z, axis, step);
            wide to_t = LOBE_SIDE_ACROSS * tap(ctx, at + lobe_axis(t), x, y, z, axis, step);
            wide to_u = LOBE_SIDE_ACROSS * tap(ctx, at + lobe_axis(u), x, y, z, axis, step);
            wide front = LOBE_FRONT * c0 + (way * LOBE_FRONT_ALONG) * along;
            wide base_t = LOBE_SIDE * c0 + (way * LOBE_SIDE_ALONG) * along;
            wide base_u = base_t;
#if BANDS == 3
            const wide c6 = tap(ctx, at + 6, x, y, z, axis, step);
            const wide c8 = tap(ctx, at + 8, x, y, z, axis, step);
            const wide square = lobe_square(axis, c6, c8);
            front = front + LOBE_FRONT * square;
            base_t = base_t + (LOBE_SIDE_SQUARE * square + LOBE_SIDE_OTHER * lobe_square(t, c6, c8));
            base_u = base_u + (LOBE_SIDE_SQUARE * square + LOBE_SIDE_OTHER * lobe_square(u, c6, c8));
            if (params.across != 0) {
                to_t = to_t + (way * LOBE_SIDE_CROSS) * tap(ctx, at + lobe_across(axis, t), x, y, z, axis, step);
                to_u = to_u + (way * LOBE_SIDE_CROSS) * tap(ctx, at + lobe_across(axis, u), x, y, z, axis, step);
            }
#endif
            wide flux[5];
            flux[0] = front;
            flux[1] = base_t + to_t;
            flux[2] = base_t - to_t;
            flux[3] = base_u + to_u;
            flux[4] = base_u - to_u;
            UNROLL for (int k = 0; k < 5; ++k) {
                if (LOBES == 1 || LOBES == 3) flux[k] = lobe_positive(flux[k]);
#if BLOCKED
                flux[k] = flux[k] * passes[5 * n + k];
#endif
            }
            const int ahead = 2 * axis + (step < 0 ? 0 : 1);
            face[ahead] = face[ahead] + flux[0];
            face[2 * t] = face[2 * t] + flux[1];
            face[2 * t + 1] = face[2 * t + 1] + flux[2];
            face[2 * u] = face[2 * u] + flux[3];
            face[2 * u + 1] = face[2 * u + 1] + flux[4];
        }

        // Cosine lobes flux / pi along the six normals. A sixth as f32 is too large by 3e-8, which over a thousand steps would
        // add up; a quotient is rounded either way.
        const wide px = face[0] + face[1];
        const wide py = face[2] + face[3];
        const wide pz = face[4] + face[5];
        wide made[9];
        made[0] = (px + py + pz) / 6.0f;
        made[1] = 0.19245008972987526f * (face[2] - face[3]);  // 1 / (3 sqrt(3))
        made[2] = 0.19245008972987526f * (face[4] - face[5]);
        made[3] = 0.19245008972987526f * (face[0] - face[1]);
        made[4] = wide_splat(0.0f);
        made[5] = wide_splat(0.0f);
        made[7] = wide_splat(0.0f);
#if BANDS == 3
        made[6] = 0.04658474953124562f * ((pz - px) + (pz - py));  // sqrt(pi) / 12 times the norms of c6, c8
        made[8] = 0.08068715304598785f * (px - py);
#else
        made[6] = made[4];
        made[8] = made[4];
#endif
        UNROLL for (int i = 0; i < COEFFICIENTS; ++i) {
            const int to = row_of(ctx, channel * COEFFICIENTS + i, y, z) + x;
            if (i != 4 && i != 5 && i != 7)
                store_wide(total, 0, to, 0, load_wide(sum, 0, to, 0) + made[i]);
        }
#if ACTIVE
        for (int k = 0; k < PIXELS && x + k < params.width; ++k) {
            const uint flux = floatBitsToUint(abs(get_pixel(made[0], k)));
            most = max(most, flux);
            if (!before)
                for (int i = 0; i < COEFFICIENTS; ++i) some = some | (floatBitsToUint(get_pixel(made[i], k)) & 0x7fffffffu);
        }
#endif
        if (params.last == 1) continue;
        if (LOBES == 2 && params.last == 0) {
            const wide one = made[3] * made[3] + made[1] * made[1] + made[2] * made[2];
            const wide keep = lobe_shrink(made[0], one, made[6] * made[6] + made[8] * made[8]);
            UNROLL for (int i = 1; i < COEFFICIENTS; ++i) made[i] = keep * made[i];
        }
        if (LOBES == 3 && params.last == 0) {
            const wide scale = lobe_rescale(made[0], made[3], made[1], made[2], lobe_square(0, made[6], made[8]),
                                            lobe_square(1, made[6], made[8]), lobe_square(2, made[6], made[8]),
                                            made[4], made[5], made[7]);
            UNROLL for (int i = 0; i < COEFFICIENTS; ++i) made[i] = scale * made[i];
        }
        UNROLL for (int i = 0; i < COEFFICIENTS; ++i)
            if (i != 4 && i != 5 && i != 7) store_wide(dst, 0, row_of(ctx, channel * COEFFICIENTS + i, y, z) + x, 0, made[i]);
    }
#if ACTIVE
    store(reaches, flag, before || some != 0u ? 1u : 0u);
    if (params.error > 0.0f && most != 0u) atomic_max(state, 2 + params.step, most);
#endif
}
