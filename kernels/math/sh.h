// Real spherical harmonics of bands 0..4 (25 functions), orthonormal over the sphere. Flat index i = l l + l + m, so that
// bands 0 and 1 read (1; y, z, x). No alternating sign: the functions of band 1 are +sqrt(3/(4 pi)) times y, z, x, as in
// Ramamoorthi and Hanrahan, An Efficient Representation for Irradiance Environment Maps, 2001, and Sloan, Stupid Spherical
// Harmonics Tricks, 2008. Directions are unit vectors.

// Band of a flat index.
FN int sh_band(int i) { return i < 1 ? 0 : i < 4 ? 1 : i < 9 ? 2 : i < 16 ? 3 : 4; }

// Function i in direction d.
FN float sh_basis(int i, vec3 d) {
    const float x = d.x;
    const float y = d.y;
    const float z = d.z;
    if (i < 4) return i == 0 ? 0.28209479177387814f : 0.4886025119029199f * (i == 1 ? y : i == 2 ? z : x);
    if (i == 4) return 1.0925484305920792f * (x * y);
    if (i == 5) return 1.0925484305920792f * (y * z);
    if (i == 6) return 0.31539156525252005f * (3.0f * (z * z) - 1.0f);
    if (i == 7) return 1.0925484305920792f * (x * z);
    if (i == 8) return 0.5462742152960396f * (x * x - y * y);
    if (i == 9) return 0.5900435899266435f * (y * (3.0f * (x * x) - y * y));
    if (i == 10) return 2.890611442640554f * (x * y * z);
    if (i == 11) return 0.4570457994644658f * (y * (5.0f * (z * z) - 1.0f));
    if (i == 12) return 0.3731763325901154f * (z * (5.0f * (z * z) - 3.0f));
    if (i == 13) return 0.4570457994644658f * (x * (5.0f * (z * z) - 1.0f));
    if (i == 14) return 1.445305721320277f * (z * (x * x - y * y));
    if (i == 15) return 0.5900435899266435f * (x * (x * x - 3.0f * (y * y)));
    if (i == 16) return 2.5033429417967046f * (x * y * (x * x - y * y));
    if (i == 17) return 1.7701307697799304f * (y * z * (3.0f * (x * x) - y * y));
    if (i == 18) return 0.9461746957575601f * (x * y * (7.0f * (z * z) - 1.0f));
    if (i == 19) return 0.6690465435572892f * (y * z * (7.0f * (z * z) - 3.0f));
    if (i == 20) return 0.10578554691520431f * (z * z * (35.0f * (z * z) - 30.0f) + 3.0f);
    if (i == 21) return 0.6690465435572892f * (x * z * (7.0f * (z * z) - 3.0f));
    if (i == 22) return 0.47308734787878004f * ((x * x - y * y) * (7.0f * (z * z) - 1.0f));
    if (i == 23) return 1.7701307697799304f * (x * z * (x * x - 3.0f * (y * y)));
    return 0.6258357354491761f * (x * x * (x * x - 3.0f * (y * y)) - y * y * (3.0f * (x * x) - y * y));
}

// What band l of a function is multiplied by when it is convolved with the clamped cosine <n|w>+ (Ramamoorthi and Hanrahan
// 2001, eq. 8): pi, 2 pi / 3, pi / 4, 0, -pi / 24.
FN float sh_cosine_factor(int l) {
    return l == 0 ? 3.141592653589793f : l == 1 ? 2.0943951023931953f : l == 2 ? 0.7853981633974483f
         : l == 3 ? 0.0f : -0.1308996938995747f;
}

// Coefficient i of the lobe <n|w>+. Also: irradiance on a surface of normal n is the sum over i of this times the
// coefficients of the radiance.
FN float sh_cosine(int i, vec3 n) { return sh_cosine_factor(sh_band(i)) * sh_basis(i, n); }

// Coefficient i of a lobe that is symmetric about `axis`, from the lobe's coefficient of m = 0 of the same band when its
// axis is +z: sqrt(4 pi / (2 l + 1)) zonal Y_i(axis) (Sloan 2008).
FN float sh_zonal(int i, float zonal, vec3 axis) {
    const int l = sh_band(i);
    const float scale = l == 0 ? 3.5449077018110318f : l == 1 ? 2.0466534158929770f : l == 2 ? 1.5853309190424043f
                      : l == 3 ? 1.3398491713813585f : 1.1816359006036772f;
    return scale * zonal * sh_basis(i, axis);
}

// Coefficients 0..3 together, in flat order: x 1, y the y axis, z the z axis, w the x axis.
FN vec4 sh2_basis(vec3 d) {
    return vec4(0.28209479177387814f, 0.4886025119029199f * d.y, 0.4886025119029199f * d.z, 0.4886025119029199f * d.x);
}
FN vec4 sh2_cosine(vec3 n) {
    return vec4(0.886226925452758f, 1.0233267079464885f * n.y, 1.0233267079464885f * n.z, 1.0233267079464885f * n.x);
}

// Cosine and sine of k 36 degrees, k of 0..9.
FN float sh_cosine_of(int k) {
    return k == 0 ? 1.0f : k == 5 ? -1.0f : k == 1 || k == 9 ? 0.8090169943749475f
         : k == 2 || k == 8 ? 0.30901699437494745f : k == 3 || k == 7 ? -0.30901699437494745f : -0.8090169943749475f;
}
FN float sh_sine_of(int k) {
    const float s = k == 0 || k == 5 ? 0.0f : k == 1 || k == 4 || k == 6 || k == 9 ? 0.5877852522924731f : 0.9510565162951535f;
    return k > 5 ? -s : s;
}

// Element (m, n) of the rotation of band l, both -l..l: the rotated function f(R^-1 w) has in place m the sum over n of this
// times the function's coefficient n. R is given by the images rx, ry, rz of the axes (its columns); reflections are
// taken too. The integral of Y_m(R w) Y_n(w) over the sphere by a product rule (5 Gauss-Legendre nodes, 10 azimuths) that
// is exact for polynomials of degree 9; two functions of band 4 make 8.
FN float sh_rotation(int l, int m, int n, vec3 rx, vec3 ry, vec3 rz) {
    const int i = l * l + l + m;
    const int j = l * l + l + n;
    float sum = 0.0f;
    for (int a = 0; a < 5; ++a) {
        const float z = a == 0 ? 0.0f : a == 1 ? 0.5384693101056831f : a == 2 ? -0.5384693101056831f
                      : a == 3 ? 0.906179845938664f : -0.906179845938664f;
        const float weight = a == 0 ? 0.5688888888888889f : a < 3 ? 0.47862867049936647f : 0.23692688505618908f;
        const float r = sqrt(1.0f - z * z);
        for (int k = 0; k < 10; ++k) {
            const vec3 d = vec3(r * sh_cosine_of(k), r * sh_sine_of(k), z);
            const vec3 e = d.x * rx + d.y * ry + d.z * rz;
            sum += 0.6283185307179586f * weight * (sh_basis(i, e) * sh_basis(j, d));
        }
    }
    return sum;
}
