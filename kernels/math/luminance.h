// Luminance of linear colour, Rec. 709; the mean of two channels; the value of one.
#if CHANNELS == 4
FN float luminance_of(vec4 v) { return 0.2126f * v.x + 0.7152f * v.y + 0.0722f * v.z; }
#elif CHANNELS == 2
FN float luminance_of(vec2 v) { return 0.5f * (v.x + v.y); }
#else
FN float luminance_of(float v) { return v; }
#endif
