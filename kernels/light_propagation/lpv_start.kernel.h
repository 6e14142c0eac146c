// From pixels of four coefficients to a plane for each, so that neighbouring cells are neighbours in memory; with what the
// lobes' form asks for. Before the planes lie three rows: nothing, and for each cell of a row whether it has a neighbour to
// the left and to the right. CELLS: pixels of four again, a cell each, in the order that lpv_propagate_cells.kernel.h describes.
#if BANDS == 3
#define COEFFICIENTS 9
#define QUADS 3
#else
#define COEFFICIENTS 4
#define QUADS 1
#endif

// Where coefficient i of a channel lies.
FN int place_of(CTX, int channel, int i, int x, int y, int z) {
    if (CELLS == 0) return 3 * params.pitch + (channel * COEFFICIENTS + i) * params.plane + z * params.slice + y * params.pitch + x;
    const int slot = i < 4 ? i : i == 6 ? 4 : i == 8 ? 5 : i == 4 ? 8 : i == 5 ? 9 : 10;
    const int volume = (channel * QUADS + slot / 4) * params.depth + z;
    return 4 + 4 * ((volume * params.height + y) * params.width + x) + slot % 4;
}

KERNEL(lpv_start) {
    const int columns = CELLS != 0 ? params.width : params.pitch;
    ivec3 low = ivec3(0, 0, 0);
    ivec3 end = ivec3(columns, params.height, params.depth);
    if (ACTIVE != 0) {
        low = ivec3(int(load(boxes, 3)), int(load(boxes, 4)), int(load(boxes, 5)));
        end = ivec3(int(load(boxes, 6)), int(load(boxes, 7)), int(load(boxes, 8)));
        if (end.z == low.z) return;
    }
    const int x = low.x + invocation_x();
    const int y = low.y + invocation_y();
    const int z = low.z + invocation_z() % (end.z - low.z);
    const int channel = invocation_z() / (end.z - low.z);
    if (x >= end.x || y >= end.y || channel >= params.channels) return;
    if (invocation_y() == 0 && invocation_z() == 0)
        for (int i = invocation_x(); i < (CELLS != 0 ? 4 : params.pitch); i += end.x - low.x) {
            store(travelling, i, 0.0f);
            store(other, i, 0.0f);
            if (CELLS != 0) continue;
            const float left = i > 0 ? 1.0f : 0.0f;
            const float right = i + 1 < params.width ? 1.0f : 0.0f;
            store(travelling, params.pitch + i, left);
            store(travelling, 2 * params.pitch + i, right);
            store(other, params.pitch + i, left);
            store(other, 2 * params.pitch + i, right);
        }

    float c[12];
    UNROLL for (int q = 0; q < QUADS; ++q) {
        vec4 v = vec4(0.0f, 0.0f, 0.0f, 0.0f);
        const ivec3 extent = ivec3(params.width, params.height, params.depth);
        if (x < params.width) v = load_voxel(injected, extent, ivec3(x, y, (channel * QUADS + q) * params.depth + z));
        c[4 * q] = v.x;
        c[4 * q + 1] = v.y;
        c[4 * q + 2] = v.z;
        c[4 * q + 3] = v.w;
    }
    // Where no light comes nothing is added to a sum: as if 0 was, which makes 0 of -0.
    UNROLL for (int i = 0; i < COEFFICIENTS; ++i) {
        const float begin = params.keep == 0 || c[i] == 0.0f ? 0.0f : c[i];
        const int to = place_of(ctx, channel, i, x, y, z);
        store(sum, to, begin);
        if (ACTIVE != 0) {
            store(total, to, begin);
            store(other, to, 0.0f);
        }
    }
    if (LOBES == 2) {
        float two = 0.0f;
#if BANDS == 3
        two = (c[4] * c[4] + c[5] * c[5]) + (c[6] * c[6] + c[7] * c[7]) + c[8] * c[8];
#endif
        const float keep = lobe_shrink(c[0], c[3] * c[3] + c[1] * c[1] + c[2] * c[2], two);
        UNROLL for (int i = 1; i < COEFFICIENTS; ++i) c[i] = keep * c[i];
    }
    if (LOBES == 3) {
#if BANDS == 3
        const float scale = lobe_rescale(c[0], c[3], c[1], c[2], lobe_square(0, c[6], c[8]), lobe_square(1, c[6], c[8]),
                                         lobe_square(2, c[6], c[8]), c[4], c[5], c[7]);
#else
        const float scale = lobe_rescale(c[0], c[3], c[1], c[2], 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f);
#endif
        UNROLL for (int i = 0; i < COEFFICIENTS; ++i) c[i] = scale * c[i];
    }
    UNROLL for (int i = 0; i < COEFFICIENTS; ++i) store(travelling, place_of(ctx, channel, i, x, y, z), c[i]);
}
