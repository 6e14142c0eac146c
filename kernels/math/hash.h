// PCG hash (O'Neill; Jarzynski and Olano, Hash Functions for GPU Rendering, JCGT 2020).
FN uint hash(uint v) {
    const uint state = v * 747796405u + 2891336453u;
    const uint word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}
