// Minimum and maximum that ignore NaN unless there is nothing else. Comparisons only: min and max of the languages treat
// NaN differently from device to device.
FN float lower_of(float a, float b) { return (b < a || isnan(a)) ? b : a; }
FN float upper_of(float a, float b) { return (b > a || isnan(a)) ? b : a; }
