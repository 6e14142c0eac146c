#include <bit>
#include <charconv>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "host/files.h"
#include "codecs.h"

namespace luxel::io {
namespace {

static_assert(std::endian::native == std::endian::little, "elements are kept as the file stores them");

constexpr std::string_view magic("\x93NUMPY", 6);
constexpr std::size_t most_dimensions = 32;  // as NumPy

// Header of an NPY file: a Python dictionary with three known keys. Parsed by hand, so that nothing else is accepted.
class Header {
 public:
  explicit Header(std::string_view text) : rest_(text) {}

  /// False when it is not such a dictionary.
  bool parse() {
    if (!take('{')) return false;
    while (!take('}')) {
      std::string_view key;
      if (!quoted(key) || !take(':') || !value(key)) return false;
      if (!take(',') && !(space(), !rest_.empty() && rest_[0] == '}')) return false;
    }
    space();
    return rest_.empty() && has_descr && has_order && has_shape;
  }

  std::string_view descr;
  bool structured = false;  // descr is a list of fields
  bool fortran = false;
  std::vector<std::size_t> shape;
  bool overflow = false;  // a dimension beyond 64 bits

 private:
  void space() {
    while (!rest_.empty() && (rest_[0] == ' ' || rest_[0] == '\n' || rest_[0] == '\t')) rest_.remove_prefix(1);
  }

  bool take(char c) {
    space();
    if (rest_.empty() || rest_[0] != c) return false;
    rest_.remove_prefix(1);
    return true;
  }

  bool word(std::string_view w) {
    space();
    if (!rest_.starts_with(w)) return false;
    rest_.remove_prefix(w.size());
    return true;
  }

  bool quoted(std::string_view& text) {
    space();
    if (rest_.empty() || (rest_[0] != '\'' && rest_[0] != '"')) return false;
    const std::size_t end = rest_.find(rest_[0], 1);
    if (end == std::string_view::npos) return false;
    text = rest_.substr(1, end - 1);
    rest_.remove_prefix(end + 1);
    return true;
  }

  bool value(std::string_view key) {
    if (key == "descr" && !has_descr) {
      has_descr = true;
      space();
      structured = !rest_.empty() && rest_[0] == '[';
      return structured ? skip_list() : quoted(descr);
    }
    if (key == "fortran_order" && !has_order) {
      has_order = true;
      fortran = word("True");
      return fortran || word("False");
    }
    if (key == "shape" && !has_shape) {
      has_shape = true;
      return tuple();
    }
    return false;
  }

  bool skip_list() {
    int depth = 0;
    std::size_t i = 0;
    for (; i < rest_.size(); ++i) {
      if (rest_[i] == '[') ++depth;
      if (rest_[i] == ']' && --depth == 0) break;
    }
    if (i == rest_.size()) return false;
    rest_.remove_prefix(i + 1);
    return true;
  }

  bool tuple() {
    if (!take('(')) return false;
    while (!take(')')) {
      space();
      std::size_t n = 0;
      const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), n);
      if (error == std::errc::invalid_argument || shape.size() == most_dimensions) return false;
      overflow |= error == std::errc::result_out_of_range;
      rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
      shape.push_back(n);
      if (!take(',') && !(space(), !rest_.empty() && rest_[0] == ')')) return false;
    }
    return true;
  }

  std::string_view rest_;
  bool has_descr = false, has_order = false, has_shape = false;
};

std::optional<Dtype> dtype_of(std::string_view descr) {
  if (descr.size() != 3 || (descr[0] != '<' && !(descr[0] == '|' && descr[2] == '1'))) return {};
  for (const Dtype d : {Dtype::f4, Dtype::f8, Dtype::u1, Dtype::u2, Dtype::u4, Dtype::i4})
    if (descr.substr(1) == name(d)) return d;
  return {};
}

// As Python writes a tuple.
std::string shape_text(const std::vector<std::size_t>& shape) {
  return fmt::format("({}{})", fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
}

// Bytes of an array, or nothing where the product does not fit.
std::optional<std::size_t> byte_count(const std::vector<std::size_t>& shape, Dtype dtype) {
  std::size_t total = bytes_of(dtype);
  bool empty = false, overflow = false;
  for (const std::size_t n : shape) {
    if (n == 0) empty = true;
    else if (total > std::numeric_limits<std::size_t>::max() / n) overflow = true;
    else total *= n;
  }
  if (empty) return 0;
  if (overflow) return {};
  return total;
}

// File content may hold anything; errors are one line of readable text.
std::string printable(std::string_view text) {
  std::string out;
  for (const char c : text.substr(0, 40)) out += c >= 32 && c < 127 ? c : '?';
  return out;
}

template <class T>
void append_as_float(const Array& array, float scale, std::vector<float>& out) {
  const std::size_t count = array.data.size() / sizeof(T);
  for (std::size_t i = 0; i < count; ++i) {
    T v;
    std::memcpy(&v, array.data.data() + i * sizeof(T), sizeof(T));
    out.push_back(static_cast<float>(v) / scale);
  }
}

}  // namespace

std::size_t bytes_of(Dtype dtype) {
  switch (dtype) {
    case Dtype::u1: return 1;
    case Dtype::u2: return 2;
    case Dtype::f4: case Dtype::u4: case Dtype::i4: return 4;
    case Dtype::f8: return 8;
  }
  return 0;
}

const char* name(Dtype dtype) {
  switch (dtype) {
    case Dtype::f4: return "f4";
    case Dtype::f8: return "f8";
    case Dtype::u1: return "u1";
    case Dtype::u2: return "u2";
    case Dtype::u4: return "u4";
    case Dtype::i4: return "i4";
  }
  return "?";
}

std::size_t Array::elements() const {
  std::size_t n = 1;
  for (const std::size_t s : shape) n *= s;
  return n;
}

Array make_array(std::vector<std::size_t> shape, std::span<const float> values) {
  Array array;
  array.shape = std::move(shape);
  array.data.resize(values.size_bytes());
  if (!values.empty()) std::memcpy(array.data.data(), values.data(), values.size_bytes());
  return array;
}

std::vector<float> to_float(const Array& array) {
  std::vector<float> out;
  out.reserve(array.data.size() / bytes_of(array.dtype));
  switch (array.dtype) {
    case Dtype::f4: append_as_float<float>(array, 1.0f, out); break;
    case Dtype::f8: append_as_float<double>(array, 1.0f, out); break;
    case Dtype::u1: append_as_float<std::uint8_t>(array, 255.0f, out); break;
    case Dtype::u2: append_as_float<std::uint16_t>(array, 1.0f, out); break;
    case Dtype::u4: append_as_float<std::uint32_t>(array, 1.0f, out); break;
    case Dtype::i4: append_as_float<std::int32_t>(array, 1.0f, out); break;
  }
  return out;
}

Result<Array> decode_npy(std::span<const std::uint8_t> bytes, const std::string& file) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (!text.starts_with(magic)) return failure(file, "is not an NPY file", "write it with numpy.save");
  if (bytes.size() < 10) return failure(file, "ends within the NPY header", damaged);
  const int major = bytes[6], minor = bytes[7];
  if ((major != 1 && major != 2) || minor != 0)
    return failure(file, fmt::format("has NPY version {}.{}; expected 1.0 or 2.0", major, minor),
                   "save it with numpy.save as a plain array");
  const std::size_t start = major == 1 ? 10 : 12;
  if (bytes.size() < start) return failure(file, "ends within the NPY header", damaged);
  std::size_t length = bytes[8] | bytes[9] << 8;
  if (major == 2) length |= std::size_t{bytes[10]} << 16 | std::size_t{bytes[11]} << 24;
  if (length > bytes.size() - start) return failure(file, "ends within the NPY header", damaged);

  Header header(text.substr(start, length));
  if (!header.parse())
    return failure(file, fmt::format("has a malformed NPY header: {}", printable(text.substr(start, length))), damaged);
  if (header.structured)
    return failure(file, "holds structured elements", "save one field as a plain array of f4");
  const std::optional<Dtype> dtype = dtype_of(header.descr);
  if (!dtype) {
    const bool big = header.descr.starts_with('>');
    return failure(file, fmt::format("has dtype {}{}; expected f4, f8, u1, u2, u4 or i4, little-endian",
                                     printable(header.descr), big ? " (big-endian)" : ""),
                   "convert it with array.astype('<f4')");
  }
  if (header.fortran) return failure(file, "is in Fortran order", "save numpy.ascontiguousarray(array)");
  const std::optional<std::size_t> wanted = byte_count(header.shape, *dtype);
  const std::span<const std::uint8_t> data = bytes.subspan(start + length);
  if (header.overflow || !wanted)
    return failure(file, fmt::format("has the impossible shape {}", shape_text(header.shape)), damaged);
  if (data.size() != *wanted)
    return failure(file, fmt::format("holds {} bytes of data; its shape {} of {} needs {}", data.size(),
                                     shape_text(header.shape), name(*dtype), *wanted), damaged);
  Array array;
  array.shape = std::move(header.shape);
  array.dtype = *dtype;
  array.data.assign(data.begin(), data.end());
  return array;
}

Result<Array> read_npy(const std::string& path) {
  const Result<Bytes> bytes = read_bytes(path);
  if (!bytes) return bytes.status();
  return decode_npy(bytes.value(), path);
}

std::vector<std::uint8_t> encode_npy(const Array& array) {
  std::string header = fmt::format("{{'descr': '{}{}', 'fortran_order': False, 'shape': {}, }}",
                                   bytes_of(array.dtype) == 1 ? '|' : '<', name(array.dtype), shape_text(array.shape));
  // NumPy aligns the data to 64 bytes; the last byte of the header is a newline.
  constexpr std::size_t start = 10;
  const std::size_t length = (start + header.size() + 1 + 63) / 64 * 64 - start;
  header.resize(length - 1, ' ');
  header += '\n';
  std::string start_text(magic);
  for (const std::size_t byte : {std::size_t{1}, std::size_t{0}, length & 255, length >> 8})
    start_text += static_cast<char>(byte);
  header.insert(0, start_text);
  Bytes out(header.begin(), header.end());
  out.insert(out.end(), array.data.begin(), array.data.end());
  return out;
}

Status write_npy(const std::string& path, const Array& array) {
  if (array.shape.size() > most_dimensions)
    return Status(Code::invalid_argument, fmt::format("{}: the array has {} dimensions; expected 0..{}", path,
                                                      array.shape.size(), most_dimensions));
  const std::optional<std::size_t> wanted = byte_count(array.shape, array.dtype);
  if (!wanted || *wanted != array.data.size())
    return Status(Code::invalid_argument,
                  fmt::format("{}: the array holds {} bytes, which is not what its shape {} of {} needs", path,
                              array.data.size(), shape_text(array.shape), name(array.dtype)));
  if (!write_file_atomically(path, encode_npy(array)))
    return failure(path, "cannot be written", "check that its folder can be written to and the disk has room");
  return {};
}

}  // namespace luxel::io
