// Octahedral map of directions (Cigolle et al., A Survey of Efficient Representations for Independent Unit Vectors, JCGT
// 2014): the pole is +z, both coordinates lie in -1..1; the lower half is folded over the outer triangles.
FN vec2 octahedral(vec3 d) {
    const float sum = abs(d.x) + abs(d.y) + abs(d.z);
    const float x = d.x / sum;
    const float y = d.y / sum;
    if (d.z >= 0.0f) return vec2(x, y);
    return vec2((1.0f - abs(y)) * (x < 0.0f ? -1.0f : 1.0f), (1.0f - abs(x)) * (y < 0.0f ? -1.0f : 1.0f));
}
