// Fills what planes hold beyond both ends of a row, after a pass wrote what is between.

KERNEL(bilateral_pad) {
    const int i = invocation_x();
    const int row = invocation_y();
    if (i >= params.pitch - params.width || row >= params.count * params.height) return;
    const int at = i < params.pad ? i : i + params.width;
    const int from = border_index(BORDER, at - params.pad, params.width) + params.pad;
    const int start = (params.first * params.height + row) * params.pitch;
    store(planes, start + at, load(planes, start + from));
}
