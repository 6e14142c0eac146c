/// \file
/// The version of these headers. The build reads it from here.
#pragma once

#define LUXEL_VERSION_MAJOR 0  ///< grows where callers must change
#define LUXEL_VERSION_MINOR 1  ///< grows where something is added
#define LUXEL_VERSION_PATCH 0  ///< grows where something is mended
#define LUXEL_VERSION_STRING "0.1.0"  ///< all three
/// As one number to compare: 10000 major + 100 minor + patch.
#define LUXEL_VERSION (LUXEL_VERSION_MAJOR * 10000 + LUXEL_VERSION_MINOR * 100 + LUXEL_VERSION_PATCH)
