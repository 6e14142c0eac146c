// Outgoing radiance of the voxels of touched bricks: Le + rho / pi E, E from lights with shadow rays through the voxels, and
// the mean over the texels of a map.

FN ivec3 extent_of(CTX) { return ivec3(params.width, params.height, params.depth); }

// Where voxel p of the grid lies in the volumes.
FN ivec3 stored(CTX, ivec3 p) {
    if (TORUS == 0) return p;
    return torus(p + ivec3(params.turn_x, params.turn_y, params.turn_z), extent_of(ctx));
}

#if MAP
// Mean of the texels, in `w` how many.
FN vec4 mean_of_texels(CTX, int slot, int v) {
    const int at = (slot * LIT_BRICK_VOXELS + v) * 4;
    const uint texels = load(sums, at + 3);
    if (texels == 0u) return vec4(0.0f);
    const float unit = params.unit / float(texels);
    return vec4(unit * float(load(sums, at)), unit * float(load(sums, at + 1)), unit * float(load(sums, at + 2)),
                float(texels));
}
#endif

#if LIGHTS
FN vec3 normal_at(CTX, ivec3 p) {
    const vec4 n = load_voxel(normal, extent_of(ctx), stored(ctx, p));
    if (UNORM != 0) return vec3(2.0f * n.x - 1.0f, 2.0f * n.y - 1.0f, 2.0f * n.z - 1.0f);
    return vec3(n.x, n.y, n.z);
}

// Distance along one axis to the next boundary between cells.
FN float to_boundary(float from, int cell, float direction) {
    if (direction == 0.0f) return 1.0e30f;
    return (float(direction > 0.0f ? cell + 1 : cell) - from) / direction;
}
FN float across(float direction) { return direction == 0.0f ? 1.0e30f : abs(1.0f / direction); }
FN int side_of(float direction) { return direction > 0.0f ? 1 : -1; }

// Transmittance over `reach` voxels: cells of coverage a let (1 - a)^chord pass (Amanatides and Woo 1987, the walk).
FN float transmittance(CTX, vec3 from, vec3 direction, float reach) {
    const ivec3 extent = extent_of(ctx);
    ivec3 cell = ivec3(int(floor(from.x)), int(floor(from.y)), int(floor(from.z)));
    vec3 next = vec3(to_boundary(from.x, cell.x, direction.x), to_boundary(from.y, cell.y, direction.y),
                     to_boundary(from.z, cell.z, direction.z));
    const vec3 stride = vec3(across(direction.x), across(direction.y), across(direction.z));
    const ivec3 side = ivec3(side_of(direction.x), side_of(direction.y), side_of(direction.z));
    const int most = params.width + params.height + params.depth;
    float passed = 1.0f;
    float t = 0.0f;
    for (int step = 0; step < most && t < reach && in_grid(cell, extent); ++step) {
        const float leave = min(min(next.x, next.y), next.z);
        const float a = load_voxel(colour, extent, stored(ctx, cell)).w;
        if (a >= 1.0f) return 0.0f;
        if (a > 0.0f) {  // a chord may be longer than 1, its half is not
            const float half_passed = 1.0f - a * layer_part(a, 0.5f * (min(leave, reach) - t));
            passed = passed * (half_passed * half_passed);
        }
        t = leave;
        if (next.x <= next.y && next.x <= next.z) {
            next.x += stride.x;
            cell.x += side.x;
        } else if (next.y <= next.z) {
            next.y += stride.y;
            cell.y += side.y;
        } else {
            next.z += stride.z;
            cell.z += side.z;
        }
    }
    return passed;
}

// Half a voxel, and what depths of a map may be off.
FN bool in_voxel(vec3 p) { return max(abs(p.x), max(abs(p.y), abs(p.z))) <= 0.55f; }

// The share of the voxel's surface that the shadow map's light reaches: of the rays of light (texels) towards the voxel,
// those that end in it against those that something nearer stops; less than 0 where there are neither. Rays
// that end beside it, in the surface of which it is a part, tell nothing.
FN float share_seen(CTX, vec3 centre, vec3 above, bool plane) {
    const vec3 u = vec3(params.u_x, params.u_y, params.u_z);
    const vec3 v = vec3(params.v_x, params.v_y, params.v_z);
    const vec3 w = vec3(params.w_x, params.w_y, params.w_z);
    const vec3 place = vec3(inner(u, centre) + params.u_at, inner(v, centre) + params.v_at, inner(w, centre) + params.w_at);
    const vec3 per_u = u / inner(u, u);
    const vec3 per_v = v / inner(v, v);
    const vec3 per_w = w / inner(w, w);
    const float reach_u = 0.5f * (abs(u.x) + abs(u.y) + abs(u.z));
    const float reach_v = 0.5f * (abs(v.x) + abs(v.y) + abs(v.z));
    const float behind = 1.7320508f * sqrt(inner(w, w));  // a voxel's diagonal
    const float most_x = float(params.shadow_width);
    const float most_y = float(params.shadow_height);
    const int first_x = int(clamp(place.x - reach_u + 0.5f, 0.0f, most_x));
    const int first_y = int(clamp(place.y - reach_v + 0.5f, 0.0f, most_y));
    const int last_x = int(clamp(place.x + reach_u + 0.5f, 0.0f, most_x));
    const int last_y = int(clamp(place.y + reach_v + 0.5f, 0.0f, most_y));
    int ended = 0;
    int stopped = 0;
    for (int y = first_y; y < last_y; ++y) {
        for (int x = first_x; x < last_x; ++x) {
            const float deep = load(shadow, y * params.shadow_width + x) - place.z;
            const vec3 hit = (float(x) + 0.5f - place.x) * per_u + (float(y) + 0.5f - place.y) * per_v + deep * per_w;
            const float height = inner(above, hit);
            if (in_voxel(hit)) {
                ++ended;
            } else if (plane) {  // stopped on the way to the plane's part in the voxel
                if (deep < 0.0f && height > 1.0f && in_voxel(hit - height / inner(above, per_w) * per_w)) ++stopped;
            } else if (deep < -behind) {
                ++stopped;
            }
        }
    }
    return ended + stopped > 0 ? float(ended) / float(ended + stopped) : -1.0f;
}

// Irradiance by one light; n: mean normal, `length` long.
FN vec3 irradiance_by(CTX, int light, vec3 centre, vec3 n, float length) {
    const vec4 place = load(lights, 3 * light);
    const vec4 power = load(lights, 3 * light + 1);
    const vec4 front = load(lights, 3 * light + 2);
    vec3 to = vec3(place.x, place.y, place.z);
    float reach = 1.0e30f;
    float share = 1.0f;
    float tilt = 1.0f;
    if (place.w != float(LIGHT_SUN)) {
        to = to - centre;
        const float squared = inner(to, to);
        if (squared == 0.0f) return vec3(0.0f);
        reach = sqrt(squared);
        to = to / reach;
        share = 1.0f / ((squared + power.w) * params.voxel * params.voxel);
        if (place.w == float(LIGHT_PATCH)) {
            tilt = -inner(to, vec3(front.x, front.y, front.z));
            if (!(tilt > 0.0f)) return vec3(0.0f);
            share = share * tilt;
        }
    }
    const float facing = inner(n, to);
    share = share * ((params.two_sided != 0 ? abs(facing) : max(0.0f, facing)) + 0.25f * max(0.0f, 1.0f - length));
    if (!(share > 0.0f)) return vec3(0.0f);
    vec3 above = to;
    if (length > 0.0f) above = (facing < 0.0f && params.two_sided != 0 ? -1.0f : 1.0f) / length * n;
    float passed = -1.0f;
    if (SHADOW != 0 && light == 0) passed = share_seen(ctx, centre, above, length >= 0.5f);
    if (passed < 0.0f) {
        // The ray is moved off the surface, and ends where it comes as near to the light, or as far above the patch.
        if (place.w == float(LIGHT_POINT)) reach = reach - params.normal_offset * inner(above, to);
        if (place.w == float(LIGHT_PATCH))
            reach = reach + params.normal_offset * (inner(above, vec3(front.x, front.y, front.z)) - 1.0f) / tilt;
        passed = transmittance(ctx, centre + params.normal_offset * above, to, reach);
    }
    share = share * passed;
    return share * vec3(power.x, power.y, power.z);
}

FN vec3 by_lights(CTX, ivec3 p) {
    const vec3 n = normal_at(ctx, p);
    const float length = sqrt(inner(n, n));
    const vec3 centre = vec3(float(p.x) + 0.5f, float(p.y) + 0.5f, float(p.z) + 0.5f);
    vec3 sum = vec3(0.0f);
    for (int light = 0; light < params.lights; ++light) sum = sum + irradiance_by(ctx, light, centre, n, length);
    return sum;
}
#endif

KERNEL(voxel_inject) {
    const int slot = invocation_y();
    if (slot >= int(min(load(voxel_counters, LIT_COUNT_BRICKS), uint(params.bricks)))) return;
    const int v = invocation_x();
    const ivec3 extent = extent_of(ctx);
    const ivec3 p = lit_voxel(int(load(brick_list, slot)), v, lit_bricks(extent, TORUS)) -
                    TORUS * ivec3(params.inner_x, params.inner_y, params.inner_z);
    if (!in_grid(p, extent)) return;
    const ivec3 at = stored(ctx, p);
    const vec4 surface = load_voxel(colour, extent, at);
    if (!(surface.w > 0.0f)) {
        store_voxel(radiance, extent, at, vec4(0.0f));
        return;
    }
    vec3 arrived = vec3(0.0f);
    bool lit = false;
#if LIGHTS
    arrived = by_lights(ctx, p);
#endif
#if MAP
    const vec4 mean = mean_of_texels(ctx, slot, v);
    arrived = arrived + vec3(mean.x, mean.y, mean.z);
    lit = mean.w > 0.0f;
#endif
    lit = lit || arrived.x + arrived.y + arrived.z > 0.0f;
    vec3 outgoing = 0.318309886183791f * vec3(surface.x * arrived.x, surface.y * arrived.y, surface.z * arrived.z);
#if EMISSION
    const vec4 own = load_voxel(emission, extent, at);
    outgoing = outgoing + vec3(own.x, own.y, own.z);
#endif
    const float scale = params.scale * surface.w;
    store_voxel(radiance, extent, at, vec4(scale * outgoing.x, scale * outgoing.y, scale * outgoing.z, surface.w));
    if (COUNT != 0) atomic_add(outcomes, lit ? INJECT_LIT : INJECT_UNLIT, 1u);
}
