// The version of these headers. The build reads it from here.
#pragma once

#define LUXEL_VERSION_MAJOR 0
#define LUXEL_VERSION_MINOR 1
#define LUXEL_VERSION_PATCH 0
#define LUXEL_VERSION_STRING "0.1.0"
/// As one number, for `#if LUXEL_VERSION >= 100`: 10000 major + 100 minor + patch.
#define LUXEL_VERSION (LUXEL_VERSION_MAJOR * 10000 + LUXEL_VERSION_MINOR * 100 + LUXEL_VERSION_PATCH)
