// Generated images, the same on every machine: interleaved channels, row 0 on top, linear values.
#pragma once
#include <cstdint>
#include <vector>

namespace luxel::scene {

/// PCG hash (O'Neill; Jarzynski and Olano, Hash Functions for GPU Rendering, JCGT 2020): equal numbers on every
/// compiler.
std::uint32_t hash(std::uint32_t v);

/// Uniform in [0, 1), multiples of 2^-24, so that f32 holds them.
double random01(std::uint32_t index, std::uint32_t seed);

/// Independent uniform values.
std::vector<double> noise(int width, int height, int channels, std::uint32_t seed);

/// 1 in every channel of one pixel, 0 elsewhere.
std::vector<double> impulse(int width, int height, int channels, int x, int y);

/// 0 left of `x`, 1 from there on.
std::vector<double> step_edge(int width, int height, int channels, int x);

/// A sky with a sun of 2000, a checkered floor, thin dark bars and soft discs; alpha (a fourth channel) is 1.
/// What a blur meets in practice: a high dynamic range, edges, gradients. Values are floats.
std::vector<double> hdr_landscape(int width, int height, int channels);

}  // namespace luxel::scene
