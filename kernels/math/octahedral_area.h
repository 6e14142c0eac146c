// Solid angle of a texel of an octahedral map of an even size, at least 4. `dot3` of math/vector.h.

// Of the triangle with corners a, b, c and determinant det (Van Oosterom and Strackee, The Solid Angle of a Plane Triangle,
// 1983): tan(half of it) = det / (abc + (a b)c + (a c)b + (b c)a). The arc tangent by its series: in maps of 8 and more its
// argument lies below 1/12, and the next term below 2e-11 of the sum.
FN float triangle_solid_angle(vec3 a, vec3 b, vec3 c, float det) {
    const float la = sqrt(dot3(a, a));
    const float lb = sqrt(dot3(b, b));
    const float lc = sqrt(dot3(c, c));
    const float t = det / (la * lb * lc + dot3(a, b) * lc + dot3(a, c) * lb + dot3(b, c) * la);
    const float q = t * t;
    return 2.0f * t * (1.0f - q * (0.333333333333f - q * (0.2f - q * 0.142857142857f)));
}

// A texel is a parallelogram on a face of the octahedron x + y + z = 1, or two triangles of equal size on two faces. All
// determinants are the square of its side: nothing cancels. Faces mirror each other.
FN float octahedral_solid_angle(int x, int y, int size) {
    const int half_size = size / 2;
    int i = x >= half_size ? x - half_size : half_size - 1 - x;
    int j = y >= half_size ? y - half_size : half_size - 1 - y;
    if (i + j > half_size - 1) {  // below the equator
        const int k = half_size - 1 - j;
        j = half_size - 1 - i;
        i = k;
    }
    const float e = 1.0f / float(half_size);
    const float u = float(i) * e;
    const float v = float(j) * e;
    const vec3 right = vec3(u + e, v, 1.0f - u - v - e);
    const vec3 down = vec3(u, v + e, 1.0f - u - v - e);
    const float part = triangle_solid_angle(vec3(u, v, 1.0f - u - v), right, down, e * e);
    if (i + j == half_size - 1) return 2.0f * part;
    return part + triangle_solid_angle(vec3(u + e, v + e, 1.0f - u - v - 2.0f * e), right, down, e * e);
}
