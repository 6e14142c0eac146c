// The angle of (x, y) from +x, -pi..pi, by + - x / and square roots alone, so that every device gives the same bits: the
// half-angle formula twice, tan(a / 2) = y / (x + |(x, y)|), and the series of the arc tangent for what is left, to 1e-8.
// (0, 0) gives 0.
FN float arc(float y, float x) {
    const float ax = abs(x);
    const float ay = abs(y);
    const float large = max(ax, ay);
    if (!(large > 0.0f)) return 0.0f;
    const float small_part = min(ax, ay) / large;  // tangent of 0..pi/4
    const float half_angle = small_part / (1.0f + sqrt(1.0f + small_part * small_part));
    const float t = half_angle / (1.0f + sqrt(1.0f + half_angle * half_angle));
    const float t2 = t * t;
    const float series = t * (1.0f - t2 * (0.33333333333333333f - t2 * (0.2f - t2 * (0.14285714285714286f -
                         t2 * (0.11111111111111111f - t2 * (0.090909090909090909f - t2 * 0.076923076923076923f))))));
    float angle = 4.0f * series;
    if (ay > ax) angle = 1.5707963267948966f - angle;
    if (x < 0.0f) angle = 3.1415926535897932f - angle;
    return y < 0.0f ? -angle : angle;
}
