// Which voxels of a brick a triangle touches, and its share in the means of these voxels.
// conservative: the closed box of the voxel meets the triangle (26-separating). thin: one of the three segments that
// join the centres of opposite faces meets it (6-separating; Laine, A Topological Approach to Voxelization, 2013).
// dilated: the box meets the plane, and seen along the dominant axis the triangle, moved outwards by half a pixel's
// diagonal (Crassin and Green, Octree-Based Sparse Voxelization Using the GPU Hardware Rasterizer, 2012).

#define WITH_TEXTURES (TEXTURES != 0)
#define WEIGHT_STEPS 4194304.0f  // 2^22 to a voxel^2
#define WEIGHT_LEAST 64u         // 2^-16 voxel^2

FN ivec3 vertex(CTX, int t, int i) {
    const int at = t * TRIANGLE_WORDS + 3 * i;
    return ivec3(load(triangles, at), load(triangles, at + 1), load(triangles, at + 2)) -
           65536 * ivec3(params.base_x, params.base_y, params.base_z);
}

FN int dominant_axis(vec3 n) {
    const vec3 m = abs(n);
    return m.x >= m.y && m.x >= m.z ? 0 : (m.y >= m.z ? 1 : 2);
}

// (v1 - v0) x (v2 - v0) in units of 2^-32 voxel^2, each component to three units in its last place.
FN vec3 normal_of(ivec3 v0, ivec3 v1, ivec3 v2) {
    return vec3(float_of_signed_64(double_area(projected(v0, 0), projected(v1, 0), projected(v2, 0))),
                float_of_signed_64(double_area(projected(v0, 1), projected(v1, 1), projected(v2, 1))),
                float_of_signed_64(double_area(projected(v0, 2), projected(v1, 2), projected(v2, 2))));
}

// In voxels; where a float does not hold it, rounded the same way on every device.
FN vec3 position(ivec3 v) { return vec3(float_of_int(v.x), float_of_int(v.y), float_of_int(v.z)) / 65536.0f; }

// 0..1 in steps of 2^-14.
FN uint steps_of(float v) { return v > 0.0f ? uint(min(v, 1.0f) * 16384.0f + 0.5f) : 0u; }

// weight * value into a sum of 64 bits; at most 2^37 each, so that the shares of 2^27 triangles fit.
FN void add(CTX, int at, uint weight, uint value) {
    const uvec2 v = product_unsigned(weight, value);
    if (v.x == 0u && v.y == 0u) return;
    const uint before = atomic_add(sums, at, v.x);
    const uint over = v.y + carry_of(before, v.x, before + v.x);
    if (over > 0u) atomic_add(carries, at, over);
}

FN void add_mean(CTX, int voxel, uint weight, vec4 colour, vec3 emission, vec3 normal) {
    int at = voxel * (4 + OPACITY + 3 * NORMAL + 3 * EMISSION);
    add(ctx, at, weight, 1u);
    add(ctx, at + 1, weight, steps_of(colour.x));
    add(ctx, at + 2, weight, steps_of(colour.y));
    add(ctx, at + 3, weight, steps_of(colour.z));
    at += 4;
    if (OPACITY != 0) add(ctx, at, weight, steps_of(colour.w));
    at += OPACITY;
    if (NORMAL != 0) {
        const vec3 biased = 0.5f * normal + vec3(0.5f, 0.5f, 0.5f);
        add(ctx, at, weight, steps_of(biased.x));
        add(ctx, at + 1, weight, steps_of(biased.y));
        add(ctx, at + 2, weight, steps_of(biased.z));
    }
    at += 3 * NORMAL;
    if (EMISSION != 0) {
        const vec3 share = emission / (16384.0f * params.emission_unit);
        add(ctx, at, weight, steps_of(share.x));
        add(ctx, at + 1, weight, steps_of(share.y));
        add(ctx, at + 2, weight, steps_of(share.z));
    }
}

// The mean so far in 8 bits a channel, the fourth counts: C <- (i C + c) / (i + 1). The count wraps at 255.
FN void move_average(CTX, int voxel, vec4 colour) {
    uint before = 0u;  // most likely
    for (;;) {
        const uint count = before >> 24;
        uint after = (count + 1u) << 24;
        if (count == 255u) atomic_add(counters, COUNT_SATURATED, 1u);
        const float i = float(count);
        const vec3 mean = (i * vec3(unorm8_value(before & 255u), unorm8_value((before >> 8) & 255u),
                                    unorm8_value((before >> 16) & 255u)) +
                           vec3(colour.x, colour.y, colour.z)) / (i + 1.0f);
        after |= unorm8_bits(mean.x) | (unorm8_bits(mean.y) << 8) | (unorm8_bits(mean.z) << 16);
        const uint found = atomic_compare_swap(sums, voxel, before, after);
        if (found == before) return;
        before = found;
    }
}

// Whoever comes last; a share of 0 is kept apart from a voxel that nothing touches.
FN void write_last(CTX, int voxel, vec4 colour) {
    const uint after = unorm8_bits(colour.x) | (unorm8_bits(colour.y) << 8) | (unorm8_bits(colour.z) << 16) |
                       (max(unorm8_bits(colour.w), 1u) << 24);
    uint before = 0u;  // most likely
    for (;;) {
        const uint found = atomic_compare_swap(sums, voxel, before, after);
        if (found == before) return;
        before = found;
    }
}

#if TEXTURES
FN vec4 texel(CTX, int at) {
    const uint bits = load(texels, at);
    const float alpha = unorm8_value(bits >> 24);
    return vec4(alpha * table(srgb, int(bits & 255u)), alpha * table(srgb, int((bits >> 8) & 255u)),
                alpha * table(srgb, int((bits >> 16) & 255u)), alpha);
}

// The texture of a material at (u, v), linear, not premultiplied: bilinear, of the level whose texels cover about
// 1 / `density` of the area that a voxel covers; density: texels of level 0 in an area of a voxel.
FN vec4 texture_at(CTX, int entry, vec2 uv, float density) {
    int at = int(load(texture_table, entry));
    int width = int(load(texture_table, entry + 1));
    int height = int(load(texture_table, entry + 2));
    const int levels = int(load(texture_table, entry + 3));
    const int wrap_u = int(load(texture_table, entry + 4));
    const int wrap_v = int(load(texture_table, entry + 5));
    for (int level = 1; level < levels && density > 2.0f; ++level) {
        at += width * height;
        width = max(width / 2, 1);
        height = max(height / 2, 1);
        density = 0.25f * density;
    }
    const float x = moderate(uv.x, wrap_u) * float(width) - 0.5f;
    const float y = moderate(uv.y, wrap_v) * float(height) - 0.5f;
    const float fx = x - floor(x);
    const float fy = y - floor(y);
    const int x0 = wrapped(int(floor(x)), width, wrap_u);
    const int x1 = wrapped(int(floor(x)) + 1, width, wrap_u);
    const int y0 = at + width * wrapped(int(floor(y)), height, wrap_v);
    const int y1 = at + width * wrapped(int(floor(y)) + 1, height, wrap_v);
    const vec4 v = (1.0f - fy) * ((1.0f - fx) * texel(ctx, y0 + x0) + fx * texel(ctx, y0 + x1)) +
                   fy * ((1.0f - fx) * texel(ctx, y1 + x0) + fx * texel(ctx, y1 + x1));
    if (!(v.w > 0.0f)) return vec4(0.0f);
    return vec4(v.x / v.w, v.y / v.w, v.z / v.w, v.w);
}

FN vec2 corner_uv(CTX, int t, int i) { return vec2(load(uvs, 6 * t + 2 * i), load(uvs, 6 * t + 2 * i + 1)); }

// Texture coordinates at a point p of triangle t, from its corners and normal n; all in voxels, seen along the axis in
// which n is largest. The middle where the triangle has no area.
FN vec2 uv_at(CTX, int t, vec3 p, vec3 a, vec3 b, vec3 c, vec3 n, int axis) {
    const vec2 s = corner_uv(ctx, t, 0);
    const vec2 u = corner_uv(ctx, t, 1) - s;
    const vec2 v = corner_uv(ctx, t, 2) - s;
    const float area = coordinate(n, axis);
    if (area == 0.0f) return s + (u + v) / 3.0f;
    const float along_b = coordinate(cross_of(p - a, c - a), axis) / area;
    const float along_c = coordinate(cross_of(b - a, p - a), axis) / area;
    return s + clamp(along_b, 0.0f, 1.0f) * u + clamp(along_c, 0.0f, 1.0f) * v;
}
#endif

#if LIST
FN void fragment(CTX, ivec3 p, int mesh_triangle) {
    const uint at = atomic_add(counters, COUNT_FRAGMENTS, 1u);
    if (at < uint(params.fragments)) {
        store(fragment_list, 4 * int(at), uint(p.x));
        store(fragment_list, 4 * int(at) + 1, uint(p.y));
        store(fragment_list, 4 * int(at) + 2, uint(p.z));
        store(fragment_list, 4 * int(at) + 3, uint(mesh_triangle));
    }
}
#endif

// The box round the centre of voxel p with half extents h, in half voxels.
FN int box_meets_roughly(vec4 la[3], vec4 lb[3], vec4 ld[3], vec4 lw[3], vec4 plane, float slack, ivec3 corner, ivec3 p, ivec3 h) {
    const vec3 c = vec3(float(p.x - corner.x) + 0.5f, float(p.y - corner.y) + 0.5f, float(p.z - corner.z) + 0.5f);
    return meets_roughly(la, lb, ld, lw, plane, slack, c, 0.5f * vec3(float(h.x), float(h.y), float(h.z)));
}

FN bool dilated_meets(ivec3 v0, ivec3 v1, ivec3 v2, int axis, ivec3 voxel) {
    const ivec2 p = projected(v0, axis);
    const ivec2 q = projected(v1, axis);
    const ivec2 r = projected(v2, axis);
    const uvec2 area = double_area(p, q, r);
    const ivec3 c = 2 * voxel + 1;
    bool meets = plane_meets_exactly(v0, v1, v2, c, ivec3(1, 1, 1));
    for (int i = 0; i < 3; ++i)
        meets = meets && edge_meets(edge_of(p, q, r, area, i), projected(c, axis), ivec2(1, 1));
    return meets;
}

FN ivec3 segment_along(int axis) { return ivec3(axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0); }

FN int voxel_meets_roughly(vec4 la[3], vec4 lb[3], vec4 ld[3], vec4 lw[3], vec4 plane, float slack, ivec3 v0, ivec3 v1,
                           ivec3 v2, int dominant, ivec3 corner, ivec3 p) {
    if (MODE == MODE_DILATED) return dilated_meets(v0, v1, v2, dominant, p) ? ROUGH_YES : ROUGH_NO;
    if (MODE == MODE_CONSERVATIVE) return box_meets_roughly(la, lb, ld, lw, plane, slack, corner, p, ivec3(1, 1, 1));
    const ivec3 low = min(v0, min(v1, v2));
    const ivec3 high = max(v0, max(v1, v2));
    int meets = ROUGH_NO;
    for (int axis = 0; axis < 3; ++axis) {
        const ivec3 h = segment_along(axis);
        if (bounds_meet(low, high, 2 * p + 1, h))
            meets = max(meets, box_meets_roughly(la, lb, ld, lw, plane, slack, corner, p, h));
    }
    return meets;
}

// Where that leaves it open.
FN bool voxel_meets(ivec3 v0, ivec3 v1, ivec3 v2, ivec3 p) {
    if (MODE == MODE_CONSERVATIVE) return meets_exactly(v0, v1, v2, 2 * p + 1, ivec3(1, 1, 1));
    const ivec3 low = min(v0, min(v1, v2));
    const ivec3 high = max(v0, max(v1, v2));
    bool meets = false;
    for (int axis = 0; axis < 3 && !meets; ++axis) {
        const ivec3 h = segment_along(axis);
        meets = bounds_meet(low, high, 2 * p + 1, h) && meets_exactly(v0, v1, v2, 2 * p + 1, h);
    }
    return meets;
}

FN void voxelize_piece(CTX, int t, int brick, int slot) {
    const ivec3 extent = ivec3(params.width, params.height, params.depth);
    const ivec3 v0 = vertex(ctx, t, 0);
    const ivec3 v1 = vertex(ctx, t, 1);
    const ivec3 v2 = vertex(ctx, t, 2);
    const ivec3 low = min(v0, min(v1, v2));
    const ivec3 high = max(v0, max(v1, v2));
    const ivec3 corner = BRICK * position_of(brick, blocks_of(extent, BRICK));
    const ivec3 first = max(corner, first_voxel(low, ivec3(params.first_x, params.first_y, params.first_z)));
    const ivec3 last = min(corner + (BRICK - 1), last_voxel(high, ivec3(params.last_x, params.last_y, params.last_z)));

    // Float first, in voxels from a corner of the brick; what that leaves open goes to the integers.
    const vec3 a = position(v0 - 65536 * corner);
    const vec3 b = position(v1 - 65536 * corner);
    const vec3 c = position(v2 - 65536 * corner);
    const vec3 ab = voxels_of(v1 - v0);
    const vec3 bc = voxels_of(v2 - v1);
    const vec3 ca = voxels_of(v0 - v2);
    ROUGH_TRIANGLE(8.0f)

    // The normal, where something needs it: from the integers, so that slivers have one.
    vec3 rough = vec3(0.0f, 0.0f, 0.0f);
    if (NORMAL != 0 || MODE == MODE_DILATED || WITH_TEXTURES) rough = normal_of(v0, v1, v2);
    const int dominant = dominant_axis(rough);
    const int material = clamp(load(triangles, t * TRIANGLE_WORDS + 9), 0, params.materials - 1);
    const vec4 colour = load(materials, 2 * material);
    const vec4 emission = load(materials, 2 * material + 1);
    vec3 normal = vec3(0.0f, 0.0f, 0.0f);
    if (NORMAL != 0) {
        const float size = sqrt(rough.x * rough.x + rough.y * rough.y + rough.z * rough.z);
        const float turn = (load(triangles, t * TRIANGLE_WORDS + 11) & 1) != 0 ? -1.0f : 1.0f;
        if (size > 0.0f) normal = turn * rough / size;
    }

#if TEXTURES
    const int entry = material * TEXTURE_WORDS;
    const float cutoff = float(load(texture_table, entry + 6)) / 65536.0f;
    float density = 0.0f;  // texels in the area of a voxel; none without a texture
    if (load(texture_table, entry + 1) > 0u) {
        const vec2 u = corner_uv(ctx, t, 1) - corner_uv(ctx, t, 0);
        const vec2 v = corner_uv(ctx, t, 2) - corner_uv(ctx, t, 0);
        const float size = sqrt(rough.x * rough.x + rough.y * rough.y + rough.z * rough.z) / 4294967296.0f;
        const float in_texels = abs(u.x * v.y - u.y * v.x) * float(load(texture_table, entry + 1)) *
                                float(load(texture_table, entry + 2));
        density = size > 0.0f ? max(in_texels / size, 1.0e-30f) : 1.0f;
    }
#endif

    // Look for the next voxel, then share in it: neighbouring invocations do the same thing at the same time.
    ivec3 next = first;
    for (;;) {
        ivec3 p = next;
        int meets = ROUGH_NO;
        while (next.z <= last.z && meets == ROUGH_NO) {
            p = next;
            meets = voxel_meets_roughly(la, lb, ld, lw, plane, slack, v0, v1, v2, dominant, corner, p);
            next = following(next, first, last);
        }
        if (meets == ROUGH_NO) break;
        if (meets == ROUGH_UNDECIDED && !voxel_meets(v0, v1, v2, p)) continue;
        vec4 paint = colour;
        vec4 part = vec4(0.0f);
        const vec3 at = vec3(float(p.x - corner.x), float(p.y - corner.y), float(p.z - corner.z));
        if (MERGE == MERGE_EXACT || WITH_TEXTURES) part = part_in_cube(a - at, b - at, c - at);
#if TEXTURES
        if (density > 0.0f) {
            const vec2 uv = uv_at(ctx, t, at + vec3(part.x, part.y, part.z), a, b, c, rough / 4294967296.0f, dominant);
            const vec4 found = texture_at(ctx, entry, uv, density);
            if (cutoff > 0.0f && found.w < cutoff) continue;
            paint = vec4(colour.x * found.x, colour.y * found.y, colour.z * found.z,
                         cutoff > 0.0f ? colour.w : colour.w * found.w);
        }
#endif
        const int voxel = slot * BRICK_VOXELS + linear_of(p - corner, ivec3(BRICK, BRICK, BRICK));
        if (MERGE == MERGE_MOVING_AVERAGE) {
            move_average(ctx, voxel, paint);
        } else if (MERGE == MERGE_LAST_WRITE) {
            write_last(ctx, voxel, paint);
        } else {
            const uint weight = max(uint(part.w * WEIGHT_STEPS + 0.5f), WEIGHT_LEAST);
            add_mean(ctx, voxel, weight, paint, vec3(emission.x, emission.y, emission.z), normal);
        }
#if LIST
        fragment(ctx, p, load(triangles, t * TRIANGLE_WORDS + 10));
#endif
    }
}

KERNEL(voxelize) {
    const int count = int(min(load(counters, COUNT_PIECES), uint(params.capacity)));
    for (int i = invocation_x(); i < count; i += params.stride) {
        const int brick = int(load(pieces, 2 * i + 1));
        const uint slot = load(slots, brick);
        if (slot > 0u) voxelize_piece(ctx, int(load(pieces, 2 * i)), brick, int(slot) - 1);
    }
}
