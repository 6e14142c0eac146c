// Octahedral maps with a border of one texel, which holds what lies across the edge, so that a bilinear look-up reads four
// texels without asking where they are. A map of `size` has size + 2 texels along each side.

// Texels of bordered maps before texel (x, y) of map `map`; coordinates -1 .. size.
FN int bordered(int map, int x, int y, int size) { return ((map * (size + 2)) + y + 1) * (size + 2) + x + 1; }

// The other places where a bordered map holds texel (x, y): across the nearest vertical edge, across the nearest horizontal
// edge, and the opposite corner's. The texel itself where there is none.
FN ivec3 mirrored_places(int map, int x, int y, int size) {
    const int last = size - 1;
    const int own = bordered(map, x, y, size);
    const bool side = x == 0 || x == last;
    const bool end = y == 0 || y == last;
    const int beside = x == 0 ? -1 : size;
    const int behind = y == 0 ? -1 : size;
    return ivec3(side ? bordered(map, beside, last - y, size) : own, end ? bordered(map, last - x, behind, size) : own,
                 side && end ? bordered(map, x == 0 ? size : -1, y == 0 ? size : -1, size) : own);
}

// A bilinear look-up at a place (-1..1) of a map: texels before the first of its four, and how far it lies towards the next ones.
FN vec3 octahedral_look_up(vec2 place, int size) {
    const float half_size = 0.5f * float(size);
    const float x = place.x * half_size + (half_size + 0.5f);
    const float y = place.y * half_size + (half_size + 0.5f);
    const int i = int(x);
    const int j = int(y);
    return vec3(float(j * (size + 2) + i), x - float(i), y - float(j));
}

// The place of d where 1 / (|x| + |y| + |z|) is at hand.
FN vec2 octahedral_by(vec3 d, float per_sum) {
    const float x = d.x * per_sum;
    const float y = d.y * per_sum;
    if (d.z >= 0.0f) return vec2(x, y);
    return vec2((1.0f - abs(y)) * (x < 0.0f ? -1.0f : 1.0f), (1.0f - abs(x)) * (y < 0.0f ? -1.0f : 1.0f));
}
