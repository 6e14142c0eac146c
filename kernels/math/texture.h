// Textures in a buffer. One is eight words of a table: first texel, width, height (0: none), levels, wrap along u and along v
// (0 repeat, 1 clamp, 2 mirror), alpha cutoff in 2^-16 (0: none).
#define TEXTURE_WORDS 8

FN int wrapped(int i, int n, int wrap) {
    if (wrap == 1) return clamp(i, 0, n - 1);
    const int period = wrap == 2 ? 2 * n : n;
    const int k = i >= 0 ? i % period : period - 1 - (-1 - i) % period;
    return k < n ? k : 2 * n - 1 - k;
}

// v moved by an even number into -1..1 (0 where it is no number), so that it fits an int; clamped, it stays outside 0..1.
FN float moderate(float v, int wrap) {
    if (!(abs(v) < 16777216.0f)) return 0.0f;
    return wrap == 1 ? clamp(v, -1.0f, 2.0f) : v - 2.0f * floor(0.5f * v + 0.5f);
}
