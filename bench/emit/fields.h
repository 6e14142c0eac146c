// Fields of a kernel's parameters by name: what `luxel emit --options` sets.
#pragma once
#include <array>
#include <charconv>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <luxel/plan.h>

namespace luxel::emit {

/// The names of an enumeration's values, in order. Each that --options takes has a specialisation in kernels.cpp.
template <class E> struct Names;

template <> struct Names<Format> {
  static constexpr std::array<std::string_view, 7> of{"f32x1", "f32x2", "f32x4", "f16x2", "f16x4", "unorm8x4", "u32"};
};
template <> struct Names<Input> {
  static constexpr std::array<std::string_view, 3> of{"buffer", "image", "storage_image"};
};

inline bool read(std::string_view text, double& to) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), to);
  return error == std::errc() && end == text.data() + text.size();
}
inline bool read(std::string_view text, int& to) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), to);
  return error == std::errc() && end == text.data() + text.size();
}
inline bool read(std::string_view text, unsigned& to) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), to);
  return error == std::errc() && end == text.data() + text.size();
}
inline bool read(std::string_view text, bool& to) {
  to = text == "1" || text == "true" || text == "on";
  return to || text == "0" || text == "false" || text == "off";
}
template <class E> requires std::is_enum_v<E>
bool read(std::string_view text, E& to) {
  for (std::size_t i = 0; i < Names<E>::of.size(); ++i)
    if (Names<E>::of[i] == text) return to = static_cast<E>(i), true;
  return false;
}
/// 8x4x8
template <class T, std::size_t N>
bool read(std::string_view text, std::array<T, N>& to) {
  for (std::size_t i = 0; i < N; ++i) {
    const std::size_t end = i + 1 < N ? text.find('x') : text.size();
    if (end == std::string_view::npos || !read(text.substr(0, end), to[i])) return false;
    text.remove_prefix(std::min(text.size(), end + 1));
  }
  return true;
}

/// What may be written for a value of a type.
template <class T> std::string expected() {
  if constexpr (std::is_same_v<T, bool>) return "0 or 1";
  else if constexpr (std::is_same_v<T, int> || std::is_same_v<T, unsigned>) return "a whole number";
  else if constexpr (std::is_same_v<T, double>) return "a number";
  else if constexpr (std::is_enum_v<T>) {
    std::string names;
    for (std::string_view name : Names<T>::of) names += (names.empty() ? "" : ", ") + std::string(name);
    return "one of " + names;
  } else {
    return "numbers joined by x, as 8x4x8";
  }
}

/// A field of `Params`: sets it from text, or says what it takes.
template <class Params>
struct Field {
  std::string name;
  std::function<bool(Params&, std::string_view)> set;
  std::string takes;
  std::function<std::string(Params&)> value;  // its name; empty where values have no names
};

template <class Params, class Get>
Field<Params> field(std::string name, Get get) {
  using T = std::remove_cvref_t<decltype(get(std::declval<Params&>()))>;
  return {std::move(name), [get](Params& p, std::string_view text) { return read(text, get(p)); }, expected<T>(),
          [get](Params& p) -> std::string {
            if constexpr (std::is_enum_v<T>) return std::string(Names<T>::of[static_cast<std::size_t>(get(p))]);
            else return {};
          }};
}

}  // namespace luxel::emit
