// A ray on the screen. With the parameter s = t / depth(t), where t is the length in view space, a ray is linear both in
// pixels and in reciprocal depth w = 1 / depth (McGuire and Mara, Efficient GPU Screen-Space Ray Tracing, 2014, walk
// between two projected ends; this form needs no end, so that none is lost behind the camera or at infinity):
//     pixel(s) = p + s v,   w(s) = w0 + s g,   v = f d.xy - (p - c) d.z,   g = -w0 d.z,   t = s / w(s)
// d is the direction, d.z its rate of depth; f focal lengths, c the centre, in pixels.

#define NO_SURFACE 0.0f      // reciprocal depth of the sky, and of depth that is no number
#define AT_THE_EYE 1.0e30f   // of depth that is 0 or below: in front of every ray, and no surface either

// Reciprocal depth of a stored value; never increases where a linear or standard value does, never decreases where a
// reversed one does, so that a bound of stored values is one of these. convention: 0 linear, 1 standard, 2 reversed.
FN float reciprocal_depth(float stored, int convention, float scale, float offset) {
    if (convention == 0) return stored > 0.0f ? (stored < 1.0e10f ? 1.0f / stored : NO_SURFACE) : stored <= 0.0f ? AT_THE_EYE : NO_SURFACE;
    const float x = convention == 1 ? 1.0f - stored : stored;
    return x > 0.0f ? x * scale + offset : NO_SURFACE;
}

FN bool is_surface(float w) { return w > NO_SURFACE && w < AT_THE_EYE; }

// Of the back of a surface at w.
FN float behind_surface(float w, float thickness) { return w / (1.0f + thickness * w); }

// A hit: the ray's interval of depth within the pixel meets that from the surface to its back.
FN bool meets(float w_in, float w_out, float front, float back) {
    return min(w_in, w_out) <= front && max(w_in, w_out) >= back;
}

// Where along the part from s_in to s_out of a hit the ray first lies between the surface and its back.
FN float first_inside(float s_in, float s_out, float w0, float g, float front, float back) {
    const float w = w0 + s_in * g;
    if (w > front) return clamp((front - w0) / g, s_in, s_out);
    if (w < back) return clamp((back - w0) / g, s_in, s_out);
    return s_in;
}

// Along one axis. ahead: 1 where the ray goes towards larger coordinates (or does not move), else 0.
// Where a plane of the grid is met; a difference first, so that nothing cancels and 0 times infinity cannot be.
FN float plane_met(int plane, float p, float inverse) { return (float(plane) - p) * inverse; }
// The plane that ends the pixel, or the cell of a level above it.
FN int far_plane(int at, int level, int ahead) { return ((at >> level) + ahead) << level; }
FN int near_plane(int at, int ahead) { return at + 1 - ahead; }
FN int next_pixel(int at, int level, int ahead) { return far_plane(at, level, ahead) - 1 + ahead; }
FN float inverse_of(float v) { return abs(v) > 1.0e-30f ? 1.0f / v : 1.0e30f; }
FN int ahead_of(float v) { return v < -1.0e-30f ? 0 : 1; }

// The pixel at s: that whose far plane is met after s, its near plane not. Any two walks agree on it.
FN int pixel_at(float s, float p, float v, float inverse, int ahead) {
    const float q = clamp(p + s * v, -2.0f, 70000.0f);
    const int at = ahead != 0 ? int(floor(q)) : int(ceil(q)) - 1;
    const int step = 2 * ahead - 1;
    if (plane_met(far_plane(at, 0, ahead), p, inverse) <= s) return at + step;
    if (plane_met(near_plane(at, ahead), p, inverse) > s) return at - step;
    return at;
}
