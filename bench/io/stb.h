// The parts of stb that are built in: PNG in and out, HDR out, from and to memory.
#pragma once
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STBI_NO_FAILURE_STRINGS
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>
