// Lobes of light in a cell of a propagation grid, bands 0 to 2, and the fluxes that they send through the faces of the six
// cells around (Kaplanyan and Dachsbacher 2010, section 4.3; the factor of a flux is the face's solid angle, not a share of
// 4 pi). LOBE is what holds one coefficient: `float`, or with WIDE `wide`, one value for each of neighbouring cells.
//
// Seen from the middle of a cell of side 1, the neighbour's face that is opposite to the shared one takes 0.4006697 sr and
// each of its four sides 0.4234314 sr, 2 pi / 3 together; they are met along (1, 0, 0) and (2, 1, 0) / sqrt(5). Fluxes are
// counted in units of Y0 2 pi / 3, so that those of c0 weigh LOBE_FRONT + 4 LOBE_SIDE = 1, exactly in f32 too: then a step
// keeps the flux whatever the number of steps. sqrt(3) = Y1 / Y0 turns band 1 into that unit.
// Digits of f32, in double too (compilers fold constants in double): the solid angles are right to 8e-8.
#define LOBE_SIDE 0.20217357575893402f
#define LOBE_FRONT 0.19130569696426392f
#define LOBE_FRONT_ALONG 0.33135118691948023f  // LOBE_FRONT sqrt(3)
#define LOBE_SIDE_ALONG 0.31320595678302193f    // LOBE_SIDE sqrt(3) 2 / sqrt(5)
#define LOBE_SIDE_ACROSS 0.15660297839151097f  // LOBE_SIDE sqrt(3) / sqrt(5)
#define LOBE_SIDE_CROSS 0.313205956783022f    // LOBE_SIDE sqrt(15) 2 / 5
#define LOBE_SIDE_SQUARE 0.16173886060714723f   // LOBE_SIDE 4 / 5: the square of the direction's part along the axis
#define LOBE_SIDE_OTHER 0.04043471515178681f    // LOBE_SIDE / 5

#if WIDE && !defined(OCL_JOIN)
#define lobe_splat(s) wide_splat(s)
FN wide lobe_positive(wide v) {
    UNROLL for (int k = 0; k < PIXELS; ++k) if (get_pixel(v, k) < 0.0f) set_pixel(v, k, get_pixel(wide_splat(0.0f), k));
    return v;
}
FN wide lobe_saturate(wide v) {
    UNROLL for (int k = 0; k < PIXELS; ++k) {
        const float p = get_pixel(v, k);
        set_pixel(v, k, p > 0.0f ? (p < 1.0f ? p : 1.0f) : 0.0f);
    }
    return v;
}
FN wide lobe_sqrt(wide v) {
    UNROLL for (int k = 0; k < PIXELS; ++k) set_pixel(v, k, sqrt(get_pixel(v, k)));
    return v;
}
FN wide lobe_ratio(wide part, wide whole) {
    UNROLL for (int k = 0; k < PIXELS; ++k) {
        const float p = get_pixel(part, k);
        const float w = get_pixel(whole, k);
        set_pixel(part, k, w <= p ? 1.0f : p > 0.0f ? p / w : 0.0f);
    }
    return part;
}
#else
#if WIDE
#define lobe_splat(s) wide_splat(s)
#else
#define lobe_splat(s) (s)
#endif
// v where it is not negative, else 0. NaN stays.
FN LOBE lobe_positive(LOBE v) { return v < lobe_splat(0.0f) ? lobe_splat(0.0f) : v; }
// v within 0..1; NaN becomes 0.
FN LOBE lobe_saturate(LOBE v) {
    const LOBE most = v < lobe_splat(1.0f) ? v : lobe_splat(1.0f);
    return v > lobe_splat(0.0f) ? most : lobe_splat(0.0f);
}
FN LOBE lobe_sqrt(LOBE v) { return sqrt(v); }
// part / whole, at most 1; 1 where whole is no more than part, 0 where part is not positive.
FN LOBE lobe_ratio(LOBE part, LOBE whole) {
    const LOBE some = part > lobe_splat(0.0f) ? part / whole : lobe_splat(0.0f);
    return whole <= part ? lobe_splat(1.0f) : some;
}
#endif

// Flat index of the function of band 1 that goes along an axis (0 x, 1 y, 2 z); of the function of band 2 across two axes.
FN int lobe_axis(int axis) { return axis == 0 ? 3 : axis; }
FN int lobe_across(int a, int b) { return a + b == 1 ? 4 : a + b == 3 ? 5 : 7; }
// The part of band 2 that is a sum of squares, as what it gives along an axis: sqrt(5) c6 along z.
FN LOBE lobe_square(int axis, LOBE c6, LOBE c8) {
    if (axis == 2) return 2.2360679774997896f * c6;
    const LOBE even = 1.118033988749895f * c6;
    const LOBE odd = 1.9364916731037085f * c8;
    return axis == 0 ? odd - even : lobe_splat(0.0f) - odd - even;
}

// How much of bands 1 and 2 leaves no direction negative: |c1 . w| <= |c1| sqrt(3), |band 2| <= |c2| sqrt(5) (addition
// theorem) in units of Y0. one, two: the squares of the coefficients, summed.
FN LOBE lobe_shrink(LOBE c0, LOBE one, LOBE two) {
    return lobe_ratio(c0, 1.7320508075688772f * lobe_sqrt(one) + 2.2360679774997896f * lobe_sqrt(two));
}

// Sum of the fluxes that are not negative, through ten faces: those of the two neighbours along an axis. y, z: the other axes;
// square: lobe_square; cross: the function of band 2 across the axis and the other.
FN LOBE lobe_sent(LOBE c0, LOBE along, LOBE y, LOBE z, LOBE square, LOBE square_y, LOBE square_z, LOBE cross_y, LOBE cross_z) {
    const LOBE front = LOBE_FRONT * (c0 + square);
    const LOBE middle = LOBE_SIDE * c0 + LOBE_SIDE_SQUARE * square;
    const LOBE base_y = middle + LOBE_SIDE_OTHER * square_y;
    const LOBE base_z = middle + LOBE_SIDE_OTHER * square_z;
    const LOBE ahead = LOBE_SIDE_ALONG * along;
    const LOBE to_y = LOBE_SIDE_ACROSS * y;
    const LOBE to_z = LOBE_SIDE_ACROSS * z;
    const LOBE bend_y = LOBE_SIDE_CROSS * cross_y;
    const LOBE bend_z = LOBE_SIDE_CROSS * cross_z;
    const LOBE fronts = lobe_positive(front + LOBE_FRONT_ALONG * along) + lobe_positive(front - LOBE_FRONT_ALONG * along);
    const LOBE forth = (lobe_positive((base_y + ahead) + (to_y + bend_y)) + lobe_positive((base_y + ahead) - (to_y + bend_y))) +
                       (lobe_positive((base_z + ahead) + (to_z + bend_z)) + lobe_positive((base_z + ahead) - (to_z + bend_z)));
    const LOBE back = (lobe_positive((base_y - ahead) + (to_y - bend_y)) + lobe_positive((base_y - ahead) - (to_y - bend_y))) +
                      (lobe_positive((base_z - ahead) + (to_z - bend_z)) + lobe_positive((base_z - ahead) - (to_z - bend_z)));
    return fronts + (forth + back);
}
// What a lobe's thirty fluxes are multiplied by so that, with the negative ones left out, their sum is the linear one, 6 c0.
FN LOBE lobe_rescale(LOBE c0, LOBE cx, LOBE cy, LOBE cz, LOBE sx, LOBE sy, LOBE sz, LOBE xy, LOBE yz, LOBE xz) {
    const LOBE sent = (lobe_sent(c0, cx, cy, cz, sx, sy, sz, xy, xz) + lobe_sent(c0, cy, cx, cz, sy, sx, sz, xy, yz)) +
                      lobe_sent(c0, cz, cx, cy, sz, sx, sy, xz, yz);
    return lobe_ratio(6.0f * c0, sent);
}
