// Range checks that every validate() uses; the message names field, value and allowed range.
#pragma once
#include <sstream>
#include <string>

#include <luxel/status.h>

namespace luxel {

template <class T>
Status out_of_range(const char* field, T value, const std::string& expected) {
  std::ostringstream text;
  text << field << " is " << value << "; expected " << expected;
  return {Code::invalid_argument, text.str()};
}

/// Passes when low <= value <= high; NaN fails.
template <class T>
Status check_range(const char* field, T value, T low, T high) {
  if (value >= low && value <= high) return {};
  std::ostringstream range;
  range << low << ".." << high;
  return out_of_range(field, value, range.str());
}

}  // namespace luxel

#define LUXEL_CHECK(status) \
  do { \
    if (::luxel::Status checked_ = (status); !checked_) return checked_; \
  } while (false)
