// Vectors of three.
FN bool finite(vec4 v) {
    const vec4 zero = v - v;
    return zero.x + zero.y + zero.z + zero.w == 0.0f;
}
FN float dot3(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
FN vec3 cross3(vec3 a, vec3 b) {
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

// v / |v|; zero where v is not finite or has no length.
FN vec3 unit(vec3 v) {
    const float most = max(abs(v.x), max(abs(v.y), abs(v.z)));
    if (!finite(vec4(v.x, v.y, v.z, 0.0f)) || most < 1.0e-30f) return vec3(0.0f, 0.0f, 0.0f);
    const vec3 u = v / most;
    return u / sqrt(dot3(u, u));
}
