// Fills what planes hold beyond both ends of a row, after a pass wrote what is between. Where outside is nothing, with the mark of
// bilateral_split, which weighs nothing.

KERNEL(bilateral_pad) {
    const int i = invocation_x();
    const int row = invocation_y();
    if (i >= params.pitch - params.width || row >= params.count * params.height) return;
    const int at = i < params.pad ? i : i + params.width;
    const int from = border_index(BORDER, at - params.pad, params.width) + params.pad;
    const int start = (params.first * params.height + row) * params.pitch;
    if (BORDER == BORDER_ZERO) store(planes, start + at, 1.32922800e36f);
    else store(planes, start + at, load(planes, start + from));
}
