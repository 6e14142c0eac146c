// The step of lpv_propagate, to the bit, on pixels of four coefficients: an invocation makes one cell. Where a driver reads
// texel buffers a pixel at a time but arrays value by value, this form is the faster; and it can account for energy.
//
// `src`, as lpv_start lays it out: a pixel of nothing, then for each channel the volumes (c0 .. c3) and, with 3 bands,
// (c6, c8, 0, 0) and (c4, c5, c7, 0), of which light that came through faces has nothing.
#define QUADS (BANDS == 3 ? 3 : 1)

FN int wrapped(int i, int n) { return PERIODIC == 0 ? i : i < 0 ? i + n : i >= n ? i - n : i; }
FN float part(vec4 v, int i) { return i == 0 ? v.x : i == 1 ? v.y : i == 2 ? v.z : v.w; }

// Which cell lies there; -1 outside the grid.
FN int cell_at(CTX, int x, int y, int z) {
    const int i = wrapped(x, params.width);
    const int j = wrapped(y, params.height);
    const int k = wrapped(z, params.depth);
    const bool inside = i >= 0 && i < params.width && j >= 0 && j < params.height && k >= 0 && k < params.depth;
    return inside ? (k * params.height + j) * params.width + i : -1;
}

// Flux of a cell through face k of the neighbour that lies along `way` of an axis: 0 the one beyond, then to both sides along
// the next axis, and the next but one. The cell's coefficients: bands 0 and 1; c6, c8; c4, c5, c7.
FN float flux_of(CTX, vec4 c, vec4 two, vec4 across, int axis, float way, int k) {
    const float along = part(c, lobe_axis(axis));
    const int side = (axis + (k < 3 ? 1 : 2)) % 3;
    float to = 0.0f;
    float flux = 0.0f;
    if (k == 0) {
        flux = LOBE_FRONT * c.x + (way * LOBE_FRONT_ALONG) * along;
        if (BANDS == 3) flux = flux + LOBE_FRONT * lobe_square(axis, two.x, two.y);
    } else {
        flux = LOBE_SIDE * c.x + (way * LOBE_SIDE_ALONG) * along;
        to = LOBE_SIDE_ACROSS * part(c, lobe_axis(side));
        if (BANDS == 3) {
            flux = flux + (LOBE_SIDE_SQUARE * lobe_square(axis, two.x, two.y) + LOBE_SIDE_OTHER * lobe_square(side, two.x, two.y));
            if (params.across != 0)
                to = to + (way * LOBE_SIDE_CROSS) * (axis + side == 1 ? across.x : axis + side == 3 ? across.y : across.z);
        }
        flux = k % 2 == 1 ? flux + to : flux - to;
    }
    return LOBES == 1 || LOBES == 3 ? lobe_positive(flux) : flux;
}

// Blocking at the corner (x, y, z) of the cells.
FN vec4 corner(CTX, int x, int y, int z) {
    return load_pixel(geometry, 0, (z * (params.height + 1) + y) * (params.width + 1) + x, 0);
}

// Whether light has come to a cell.
FN bool lit(CTX, int x, int y, int z) {
    const int cell = cell_at(ctx, x, y, z);
    return cell >= 0 && load(reached, max(cell, 0)) != 0u;
}

KERNEL(lpv_propagate_cells) {
    int x = invocation_x();
    int y = invocation_y();
    int z = APART != 0 ? invocation_z() % params.depth : invocation_z();
    const int first = APART != 0 ? invocation_z() / params.depth : 0;
    const int last = APART != 0 ? first + 1 : params.channels;
    if (ACTIVE != 0) {
        const int box = 9 * (params.step + 1);
        x += int(load(boxes, box + 3));
        y += int(load(boxes, box + 4));
        z += int(load(boxes, box + 5));
        if (x >= int(load(boxes, box + 6)) || y >= int(load(boxes, box + 7)) || z >= int(load(boxes, box + 8))) return;
    }
    if (x >= params.width || y >= params.height || z >= params.depth || last > params.channels) return;
    const int cell = (z * params.height + y) * params.width + x;
    const int cells = params.width * params.height * params.depth;
    bool before = false;
    if (ACTIVE != 0) {
        // Where no light has come, both buffers hold nothing and both sums what lpv_start put there.
        if (params.error > 0.0f) {
            const float most = uintBitsToFloat(load(state, 1 + params.step));
            if (most <= params.error * uintBitsToFloat(load(state, 1))) return;
        }
        if (invocation_x() == 0 && invocation_y() == 0 && invocation_z() == 0) store(state, 0, uint(params.step + 1));
        before = lit(ctx, x, y, z);
        const bool around = lit(ctx, x - 1, y, z) || lit(ctx, x + 1, y, z) || lit(ctx, x, y - 1, z) ||
                            lit(ctx, x, y + 1, z) || lit(ctx, x, y, z - 1) || lit(ctx, x, y, z + 1);
        if (!before && !around) {
            store(reaches, cell, 0u);
            return;
        }
    }
    uint some = 0u;  // bits of any coefficient but its sign
    uint most = 0u;  // of the largest c0

    // What passes of light that goes through face n / 2, n % 2 of the cell and on through face k: 1 - B(-w), with B the mean
    // of the face's four corners.
    float passes[30];
    UNROLL for (int i = 0; i < 30; ++i) passes[i] = 1.0f;
    if (BLOCKED != 0) {
        const vec4 c000 = corner(ctx, x, y, z);
        const vec4 c001 = corner(ctx, x + 1, y, z);
        const vec4 c010 = corner(ctx, x, y + 1, z);
        const vec4 c011 = corner(ctx, x + 1, y + 1, z);
        const vec4 c100 = corner(ctx, x, y, z + 1);
        const vec4 c101 = corner(ctx, x + 1, y, z + 1);
        const vec4 c110 = corner(ctx, x, y + 1, z + 1);
        const vec4 c111 = corner(ctx, x + 1, y + 1, z + 1);
        UNROLL for (int n = 0; n < 6; ++n) {
            const vec4 b = n == 0 ? (c000 + c010) + (c100 + c110) : n == 1 ? (c001 + c011) + (c101 + c111)
                         : n == 2 ? (c000 + c001) + (c100 + c101) : n == 3 ? (c010 + c011) + (c110 + c111)
                         : n == 4 ? (c000 + c001) + (c010 + c011) : (c100 + c101) + (c110 + c111);
            const int axis = n >> 1;
            const float back = (n & 1) == 0 ? -1.0f : 1.0f;  // against the way the light goes
            const float all = 0.07052369794346953f * b.x;  // Y0 / 4
            const float along = part(b, lobe_axis(axis));
            const float t = 0.05462742152960396f * part(b, lobe_axis((axis + 1) % 3));  // Y1 / (4 sqrt(5))
            const float u = 0.05462742152960396f * part(b, lobe_axis((axis + 2) % 3));
            const float side = all + (back * 0.10925484305920792f) * along;  // 2 Y1 / (4 sqrt(5))
            passes[5 * n] = 1.0f - lobe_saturate(all + (back * 0.12215062797572998f) * along);  // Y1 / 4
            passes[5 * n + 1] = 1.0f - lobe_saturate(side - t);
            passes[5 * n + 2] = 1.0f - lobe_saturate(side + t);
            passes[5 * n + 3] = 1.0f - lobe_saturate(side - u);
            passes[5 * n + 4] = 1.0f - lobe_saturate(side + u);
        }
    }

    for (int channel = first; channel < last; ++channel) {
        const int at = 1 + channel * QUADS * cells;
        // Fluxes into the faces of the cell from inside: +x, -x, +y, -y, +z, -z.
        float face[6];
        UNROLL for (int n = 0; n < 6; ++n) face[n] = 0.0f;
        float absorbed = 0.0f;
        UNROLL for (int n = 0; n < 6; ++n) {
            const int axis = n >> 1;
            const int step = (n & 1) == 0 ? -1 : 1;  // to the neighbour; its light goes the other way
            const int from = cell_at(ctx, x + (axis == 0 ? step : 0), y + (axis == 1 ? step : 0), z + (axis == 2 ? step : 0));
            const vec4 c = load_pixel(src, 0, from < 0 ? 0 : at + from, 0);
            vec4 two = vec4(0.0f);
            vec4 across = vec4(0.0f);
            if (BANDS == 3) {
                two = load_pixel(src, 0, from < 0 ? 0 : at + cells + from, 0);
                if (params.across != 0) across = load_pixel(src, 0, from < 0 ? 0 : at + 2 * cells + from, 0);
            }
            float flux[5];
            UNROLL for (int k = 0; k < 5; ++k) {
                flux[k] = flux_of(ctx, c, two, across, axis, -float(step), k);
                if (BLOCKED != 0) {
                    const float all = flux[k];
                    flux[k] = all * passes[5 * n + k];
                    if (ENERGY != 0) absorbed = absorbed + (all - flux[k]);
                }
            }
            const int t = (axis + 1) % 3;
            const int u = (axis + 2) % 3;
            const int ahead = 2 * axis + (step < 0 ? 0 : 1);
            face[ahead] = face[ahead] + flux[0];
            face[2 * t] = face[2 * t] + flux[1];
            face[2 * t + 1] = face[2 * t + 1] + flux[2];
            face[2 * u] = face[2 * u] + flux[3];
            face[2 * u + 1] = face[2 * u + 1] + flux[4];
        }

        // Cosine lobes flux / pi along the six normals (lpv_propagate.kernel.h says why not a sixth).
        const float px = face[0] + face[1];
        const float py = face[2] + face[3];
        const float pz = face[4] + face[5];
        vec4 made = vec4((px + py + pz) / 6.0f, 0.19245008972987526f * (face[2] - face[3]),  // 1 / (3 sqrt(3))
                         0.19245008972987526f * (face[4] - face[5]), 0.19245008972987526f * (face[0] - face[1]));
        float c6 = 0.0f;
        float c8 = 0.0f;
        const int to = at + cell;
        store_pixel(total, 0, to, 0, load_pixel(sum, 0, to, 0) + made);
        if (BANDS == 3) {
            c6 = 0.04658474953124562f * ((pz - px) + (pz - py));  // sqrt(pi) / 12 times the norms of c6, c8
            c8 = 0.08068715304598785f * (px - py);
            store_pixel(total, 0, to + cells, 0, load_pixel(sum, 0, to + cells, 0) + vec4(c6, c8, 0.0f, 0.0f));
        }
        if (ACTIVE != 0) {
            most = max(most, floatBitsToUint(abs(made.x)));
            some = some | ((floatBitsToUint(made.x) | floatBitsToUint(made.y) | floatBitsToUint(made.z) | floatBitsToUint(made.w) |
                            floatBitsToUint(c6) | floatBitsToUint(c8)) & 0x7fffffffu);
        }
        if (ENERGY != 0) {
            // What this cell sent out of the grid, and what leaving out negative fluxes added to it.
            const vec4 own = load_pixel(src, 0, to, 0);
            vec4 two = vec4(0.0f);
            vec4 across = vec4(0.0f);
            if (BANDS == 3) two = load_pixel(src, 0, to + cells, 0);
            if (BANDS == 3 && params.across != 0) across = load_pixel(src, 0, to + 2 * cells, 0);
            float left = 0.0f;
            float sent = 0.0f;
            UNROLL for (int n = 0; n < 6; ++n) {
                const int axis = n >> 1;
                const int step = (n & 1) == 0 ? -1 : 1;
                float outward = 0.0f;
                UNROLL for (int k = 0; k < 5; ++k) outward = outward + flux_of(ctx, own, two, across, axis, float(step), k);
                if (cell_at(ctx, x + (axis == 0 ? step : 0), y + (axis == 1 ? step : 0), z + (axis == 2 ? step : 0)) < 0) left = left + outward;
                sent = sent + outward;
            }
            vec4 so_far = vec4(0.0f);
            if (params.step > 0) so_far = load(energy, channel * cells + cell);
            const float added = LOBES == 1 ? sent / 6.0f - own.x : 0.0f;
            store(energy, channel * cells + cell, vec4(so_far.x + left / 6.0f, so_far.y + absorbed / 6.0f, so_far.z + added, made.x));
        }
        if (params.last == 1) continue;
        if (LOBES == 2 && params.last == 0) {
            const float one = made.w * made.w + made.y * made.y + made.z * made.z;
            const float keep = lobe_shrink(made.x, one, c6 * c6 + c8 * c8);
            made = vec4(made.x, keep * made.y, keep * made.z, keep * made.w);
            c6 = keep * c6;
            c8 = keep * c8;
        }
        if (LOBES == 3 && params.last == 0) {
            const float scale = lobe_rescale(made.x, made.w, made.y, made.z, lobe_square(0, c6, c8), lobe_square(1, c6, c8),
                                             lobe_square(2, c6, c8), 0.0f, 0.0f, 0.0f);
            made = scale * made;
            c6 = scale * c6;
            c8 = scale * c8;
        }
        store_pixel(dst, 0, to, 0, made);
        if (BANDS == 3) store_pixel(dst, 0, to + cells, 0, vec4(c6, c8, 0.0f, 0.0f));
    }
    if (ACTIVE != 0) {
        store(reaches, cell, before || some != 0u ? 1u : 0u);
        if (params.error > 0.0f && most != 0u) atomic_max(state, 2 + params.step, most);
    }
}
