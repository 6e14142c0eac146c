/// \file
/// octahedral_map: lists of directions to octahedral codes of 16 or 32 bits and back, and of colours to R11G11B10 (Cigolle et
/// al., A Survey of Efficient Representations for Independent Unit Vectors, JCGT 2014).
#pragma once
#include <luxel/plan.h>

namespace luxel {

/// Codes.
enum class OctahedralCode {
  snorm8,    ///< direction, 2 x 8 bits: at most .957 degrees off, .337 on average
  snorm16,   ///< direction, 2 x 16 bits: at most .0037 degrees off, .0013 on average
  r11g11b10  ///< colour, not negative, up to 64512: relative error at most 2^-7 (blue 2^-6)
};

/// A list is encoded or decoded.
struct OctahedralMapParams {
  int count = 0;        ///< of the list, 1..2^28
  OctahedralCode code = OctahedralCode::snorm8;  ///< which code
  bool decode = false;  ///< codes to values
};

/// Resources of the plan:
/// - `values`: a vec4 each: direction of any length (without length, or not finite: +z), or colour (what is not above 0 is 0,
///   what is too large the largest); decode: written: unit direction, or colour;
/// - `codes` (written; decode: read): a u32 each, x in the low bits;
/// - `places` (written; not decode): a vec4 each: place u, v in the map, -1..1, unrounded; x and y of the direction that it
///   gives back.
/// Errors: invalid_argument, naming field, value and range.
Status validate(const OctahedralMapParams& params);
/// The passes that do it on a device of this profile. Errors: as validate.
Result<Plan> plan(const OctahedralMapParams& params, const Profile& profile);

}  // namespace luxel
