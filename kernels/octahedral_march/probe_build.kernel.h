// Octahedral maps of one quantity, from values a texel (ray-caster hits), latitude-longitude images or cubes.

// The pixel of a probe's image or cube at (x, y) of a face, the edges repeated. Images wrap around sideways.
FN int pixel_index(CTX, int probe, int face, int x, int y) {
    const int cx = SOURCE == 1 ? (x + params.width) % params.width : clamp(x, 0, params.width - 1);
    const int cy = clamp(y, 0, params.height - 1);
    const int faces = SOURCE == 2 ? 6 : 1;
    return ((probe * faces + face) * params.height + cy) * params.width + cx;
}

// Pixel coordinates (0 at the outer corner of the first) of a direction, and the face. Image: row t = angle from +y over
// pi, column the angle about y from -x over 2 pi. Cube: faces +x -x +y -y +z -z as OpenGL and Vulkan lay them out.
FN vec3 image_place(CTX, vec3 d) {
    if (SOURCE == 1) {
        const float around = arc(d.z, d.x) * 0.15915494309189535f + 0.5f;
        const float down = arc(sqrt(d.x * d.x + d.z * d.z), d.y) * 0.3183098861837907f;
        return vec3(around * float(params.width), down * float(params.height), 0.0f);
    }
    const vec3 a = abs(d);
    float face = 0.0f;
    float major = a.x;
    float s = 0.0f;
    float t = 0.0f;
    if (a.x >= a.y && a.x >= a.z) {
        face = d.x < 0.0f ? 1.0f : 0.0f;
        s = d.x < 0.0f ? d.z : -d.z;
        t = -d.y;
    } else if (a.y >= a.z) {
        face = d.y < 0.0f ? 3.0f : 2.0f;
        major = a.y;
        s = d.x;
        t = d.y < 0.0f ? -d.z : d.z;
    } else {
        face = d.z < 0.0f ? 5.0f : 4.0f;
        major = a.z;
        s = d.z < 0.0f ? -d.x : d.x;
        t = -d.y;
    }
    return vec3((s / major + 1.0f) * 0.5f * float(params.width), (t / major + 1.0f) * 0.5f * float(params.height), face);
}

// What lies at a pixel coordinate, 0 .. n, as the number of a pixel.
FN int whole(float v, int n) { return clamp(int(floor(v)), 0, n - 1); }

#if QUANTITY == 0
// What cannot be radiance is none: NaN, below 0, infinite.
FN float clean(float v) { return v > 0.0f && v < 3.0e38f ? v : 0.0f; }
FN vec4 cleaned(vec4 v) { return vec4(clean(v.x), clean(v.y), clean(v.z), 0.0f); }

FN vec4 bilinear(CTX, int probe, vec3 d) {
    const vec3 at = image_place(ctx, d);
    const int face = int(at.z);
    const float x = at.x - 0.5f;
    const float y = at.y - 0.5f;
    const int ix = int(floor(x));
    const int iy = int(floor(y));
    const float fx = x - float(ix);
    const float fy = y - float(iy);
    const vec4 upper = cleaned(load(source, pixel_index(ctx, probe, face, ix, iy))) * (1.0f - fx) +
                       cleaned(load(source, pixel_index(ctx, probe, face, ix + 1, iy))) * fx;
    const vec4 lower = cleaned(load(source, pixel_index(ctx, probe, face, ix, iy + 1))) * (1.0f - fx) +
                       cleaned(load(source, pixel_index(ctx, probe, face, ix + 1, iy + 1))) * fx;
    return upper * (1.0f - fy) + lower * fy;
}

// The mean over directions of the texel.
FN vec4 radiance_of(CTX, int i) {
    if (SOURCE == 0) return cleaned(load(source, i));
    const int x = i % params.size;
    const int y = i / params.size % params.size;
    const int probe = i / params.size / params.size;
    const int fine = params.size * params.samples;
    vec4 sum = vec4(0.0f, 0.0f, 0.0f, 0.0f);
    for (int k = 0; k < params.samples * params.samples; ++k)
        sum = sum + bilinear(ctx, probe, octahedral_direction(octahedral_centre(x * params.samples + k % params.samples,
                                                                              y * params.samples + k / params.samples, fine)));
    return sum / float(params.samples * params.samples);
}
#else
// The source's element for the centre of a texel.
FN int nearest(CTX, int i) {
    if (SOURCE == 0) return i;
    const vec3 d = octahedral_direction(octahedral_centre(i % params.size, i / params.size % params.size, params.size));
    const vec3 at = image_place(ctx, d);
    return pixel_index(ctx, i / params.size / params.size, int(at.z), whole(at.x, params.width), whole(at.y, params.height));
}
#endif

#if QUANTITY == 1
// NaN and what is below 0 are no distance: the probe knows nothing there, and says 0.
FN float distance_of(CTX, int i) {
    float v = load(source, nearest(ctx, i));
    if (SOURCE == 2 && params.planar != 0) {
        const vec3 d = octahedral_direction(octahedral_centre(i % params.size, i / params.size % params.size, params.size));
        v = v / max(abs(d.x), max(abs(d.y), abs(d.z)));
    }
    return v >= 0.0f ? min(v, 1.0e30f) : 0.0f;
}
#endif

#if QUANTITY == 2
FN uint normal_of(CTX, int i) {
    const vec4 v = load(source, nearest(ctx, i));
    return direction_bits(unit(vec3(v.x, v.y, v.z)), PAIRS != 0 ? 8 : 16);
}
#endif

KERNEL(probe_build) {
#if PAIRS
    // Two texels a word.
    for (int j = invocation_x(); 2 * j < params.texels; j += params.stride)
#if QUANTITY == 1
        store(map, j, f16_bits(distance_of(ctx, 2 * j) * params.per_unit) | (f16_bits(distance_of(ctx, 2 * j + 1) * params.per_unit) << 16));
#else
        store(map, j, normal_of(ctx, 2 * j) | (normal_of(ctx, 2 * j + 1) << 16));
#endif
#else
    for (int i = invocation_x(); i < params.texels; i += params.stride) {
#if QUANTITY == 1
        store(map, i, distance_of(ctx, i));
#elif QUANTITY == 2
        store(map, i, normal_of(ctx, i));
#elif PACKED
        const vec4 v = radiance_of(ctx, i);
        store(map, i, r11g11b10_bits(vec3(v.x, v.y, v.z)));
#else
        store_pixel(map, 0, i, 0, radiance_of(ctx, i));
#endif
    }
#endif
}
