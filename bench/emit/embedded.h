// Text files that the build put into the program (embed.py): the emitter's scripts, the licence, the schema.
#pragma once
#include <string_view>
#include <vector>

namespace luxel::emit {

struct Embedded {
  std::string_view name;
  std::string_view text;
};

const std::vector<Embedded>& embedded();

}  // namespace luxel::emit
