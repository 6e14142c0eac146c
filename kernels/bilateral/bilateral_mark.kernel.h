// Pixels that bilateral_split marked weigh nothing: a plane that guides the filter says so, or one that is added to the
// exponent.

KERNEL(bilateral_mark) {
    const int x = invocation_x();
    const int y = invocation_y();
    if (x >= params.pitch || y >= params.height) return;
    const bool marked = load(colours, y * params.pitch + x) >= 1.0e36f;
    const int at = (params.first * params.height + y) * params.pitch + x;
    if (BIAS != 0) store(planes, at, marked ? -1.0e30f : 0.0f);
    else if (marked) store(planes, at, uintBitsToFloat(0x7fc00000u));
}
