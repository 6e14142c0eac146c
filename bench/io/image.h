// Images in files: EXR, HDR, PNG and NPY, told apart by extension. No colour conversion in either direction.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <luxel/status.h>

#include "array.h"

namespace luxel::io {

/// Largest width and height that is read or written, in pixels.
constexpr int largest_side = 65535;

/// Rows from top to bottom, pixels from left to right, channels interleaved.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;           // 1..4
  std::vector<float> pixels;  // width * height * channels
};

/// Reads by extension (.exr .hdr .png .npy, case ignored).
/// EXR: the data window; half, float and uint channels; the first part that is not deep, in it the unnamed layer if
/// that holds an image, else the first layer with R, G, B, else the first that holds one. A layer is RGB(A), XYZ, Y(A),
/// UV, Z, or a single channel. PNG: divided by 255 (16 bits: by 65535), palettes and transparency expanded. NPY: [y][x]
/// or [y][x][c], u1 divided by 255.
/// Errors: io, one line with the file, what is wrong, and the remedy.
Result<Image> read_image(const std::string& path);

/// What a writer had to change, because the file format cannot hold it.
struct WriteReport {
  std::size_t not_finite = 0;    // values that were NaN (PNG, HDR) or infinite (HDR)
  std::size_t out_of_range = 0;  // finite or infinite values clamped to 0..1 (PNG), or finite ones to 0..1.69e38 (HDR)
};

/// Writes by extension. EXR: float32, channels Y, Y A, R G B or R G B A. PNG: 8 bits, value * 255 rounded half to even,
/// clamped, NaN becomes 0. HDR: 1 channel (as grey) or 3; 4 where alpha is 1 everywhere. NPY: float32, [y][x] for one
/// channel, else [y][x][c]. The file appears whole or not at all; missing folders are made.
/// Errors: invalid_argument for an unknown extension or an image that the format cannot hold; io when writing fails.
Status write_image(const std::string& path, const Image& image, WriteReport* report = nullptr);

/// Whether `path` has an extension that write_image knows. Errors: invalid_argument, naming those that it knows.
Status check_image_path(const std::string& path);

/// Array [y][x] or [y][x][c] as an image, c up to 4. Errors: io, naming `file`.
Result<Image> image_from_array(const Array& array, const std::string& file);

}  // namespace luxel::io
