// Arrays of any shape, and NPY files.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <luxel/status.h>

namespace luxel::io {

/// Element types, spelled as in NPY files: f float, u unsigned, i signed; the digit is the size in bytes.
enum class Dtype { f4, f8, u1, u2, u4, i4 };

std::size_t bytes_of(Dtype dtype);
const char* name(Dtype dtype);

/// Elements in C order (last index fastest), little-endian.
struct Array {
  std::vector<std::size_t> shape;
  Dtype dtype = Dtype::f4;
  std::vector<std::uint8_t> data;  // elements() * bytes_of(dtype) bytes

  /// Product of the shape; 1 for an empty shape.
  std::size_t elements() const;
};

/// Array of float32 from values in C order; `values` holds the product of the shape.
Array make_array(std::vector<std::size_t> shape, std::span<const float> values);

/// The elements as float: u1 divided by 255, all others as numbers (rounded to float where they do not fit).
std::vector<float> to_float(const Array& array);

/// Reads an NPY file, versions 1.0 and 2.0. Errors (io): unreadable or damaged file, Fortran order, big-endian or other
/// dtypes, a shape that does not match the length of the file.
Result<Array> read_npy(const std::string& path);

/// The same from memory; `file` names the source in errors.
Result<Array> decode_npy(std::span<const std::uint8_t> bytes, const std::string& file);

/// Writes version 1.0. The file appears whole or not at all; missing folders are made.
/// Errors: io; invalid_argument when data and shape differ in size, or for more than 32 dimensions.
Status write_npy(const std::string& path, const Array& array);

/// What write_npy writes, for an array that it accepts.
std::vector<std::uint8_t> encode_npy(const Array& array);

}  // namespace luxel::io
