// Minimum and maximum that ignore NaN unless there is nothing else. Comparisons only: min and max of the languages
// treat NaN differently from device to device.
FN float lower_of(float a, float b) { return (b < a || isnan(a)) ? b : a; }
FN float upper_of(float a, float b) { return (b > a || isnan(a)) ? b : a; }

// The nearest half not above v, and not below v (NaN stays; beyond 65504 infinite, which f16 stores as 65504).
FN float f16_below(float v) {
    uint h = f16_bits(v);
    if (!(f16_value(h) > v)) return f16_value(h);
    return f16_value((h & 0x8000u) != 0u ? h + 1u : h - 1u);
}
FN float f16_above(float v) { return -f16_below(-v); }
FN vec2 outward_f16(vec2 v) { return vec2(f16_below(v.x), f16_above(v.y)); }
