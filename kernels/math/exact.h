// Whether the kernel runs in double, where storage rounds nothing. `n`: a whole number of at least 1, known at run time
// only (some compilers fold constants in double).
FN bool in_double(int n) { return float(n) + 1.0e-9f > float(n); }
