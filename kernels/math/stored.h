// Rounding by the storage formats as a function of the value, for values that invocations share before they are stored, and
// for bounds. Double precision stores doubles: nothing is rounded there.

// `n`: at least 1 and known at run time only (some compilers fold constants in double).
FN bool in_double(float n) { return n + 1.0e-9f > n; }

FN float stored_f16(float v, bool exact) { return exact ? v : f16_value(f16_bits(v)); }
FN float stored_unorm8(float v, bool exact) { return exact ? v : unorm8_value(unorm8_bits(v)); }

// The nearest half not above v, and not below v (NaN stays; beyond 65504 infinite, which f16 stores as 65504).
FN float f16_below(float v) {
    uint h = f16_bits(v);
    if (!(f16_value(h) > v)) return f16_value(h);
    return f16_value((h & 0x8000u) != 0u ? h + 1u : h - 1u);
}
FN float f16_above(float v) { return -f16_below(-v); }
FN vec2 outward_f16(vec2 v, bool exact) { return exact ? v : vec2(f16_below(v.x), f16_above(v.y)); }
