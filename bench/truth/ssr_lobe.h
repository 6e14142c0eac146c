// The GGX lobe in double, by quadrature.
#pragma once
#include <array>

namespace luxel::truth {

/// What a GGX surface of this alpha mirrors of an even environment at a cosine of the view direction: F0 A + B, by
/// `steps` x `steps` normals distributed as D cos (the kernel samples visible ones).
std::array<double, 2> split_sum(double cosine, double alpha, int steps);

}  // namespace luxel::truth
