// Where a pixel outside an image is read, for the four borders of include/luxel/gaussian_blur.h.
#define BORDER_CLAMP 0
#define BORDER_MIRROR 1
#define BORDER_WRAP 2
#define BORDER_ZERO 3

// i modulo n for any sign of i, n > 0.
FN int wrap_index(int i, int n) { return i >= 0 ? i % n : n - 1 - (-1 - i) % n; }

FN int border_index(int border, int i, int n) {
    if (i >= 0 && i < n) return i;
    if (border == BORDER_WRAP) return wrap_index(i, n);
    if (border == BORDER_MIRROR && n > 1) {
        int j = wrap_index(i, 2 * n - 2);
        return j < n ? j : 2 * n - 2 - j;
    }
    return clamp(i, 0, n - 1);
}
