// Every built module: what the SPIR-V says of parameters, constants and bindings is what the host's table says.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "host/module.h"

namespace luxel {
namespace {

// Decorations of a SPIR-V module that the host relies on (SPIR-V specification 1.6, sections 3.20 and 3.49).
struct Decorations {
  std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> offsets;  // struct id -> member -> offset
  std::map<std::uint32_t, std::uint32_t> binding, spec_id;                  // id -> number
  std::map<std::uint32_t, std::uint32_t> pointee, type_of;                  // pointer type -> type; variable -> pointer type
  std::uint32_t push_constants = 0;                                         // struct id
};

Decorations read(std::span<const std::uint32_t> words) {
  Decorations d;
  for (std::size_t at = 5; at < words.size(); at += words[at] >> 16) {
    const std::uint32_t* w = &words[at];
    switch (w[0] & 0xffff) {
      case 71:  // OpDecorate
        if (w[2] == 1) d.spec_id[w[1]] = w[3];
        if (w[2] == 33) d.binding[w[1]] = w[3];
        break;
      case 72:  // OpMemberDecorate
        if (w[3] == 35) d.offsets[w[1]][w[2]] = w[4];
        break;
      case 32: d.pointee[w[1]] = w[3]; break;  // OpTypePointer
      case 59:                                 // OpVariable
        if (w[3] == 9) d.push_constants = d.pointee[w[1]];
        break;
      default: break;
    }
  }
  return d;
}

TEST(Modules, ThereAreSome) { EXPECT_GT(modules().size(), 20u); }

TEST(Modules, ParametersLieWhereTheHostWritesThem) {
  for (const Module* module : modules()) {
    const Decorations d = read(module->spirv);
    const std::string what = std::string(module->part) + "." + std::string(module->name);
    ASSERT_NE(d.push_constants, 0u) << what;
    const auto& members = d.offsets.at(d.push_constants);
    ASSERT_EQ(members.size(), module->parameters.size()) << what;
    for (const auto& [member, offset] : members)
      EXPECT_EQ(offset, 4 * member) << what << ", parameter " << module->parameters[member].name;
    EXPECT_LE(module->parameters.size() * 4, 128u) << what << ": push constants are 128 bytes at least on every device";
  }
}

TEST(Modules, BindingsAndConstantsAreTheTablesOwn) {
  for (const Module* module : modules()) {
    const Decorations d = read(module->spirv);
    const std::string what = std::string(module->part) + "." + std::string(module->name);
    std::set<std::uint32_t> bound, listed, numbered, ids{100, 101, 102};
    for (const auto& [id, slot] : d.binding) bound.insert(slot);
    for (const BindingInfo& info : module->bindings) listed.insert(static_cast<std::uint32_t>(info.slot));
    EXPECT_EQ(listed.size(), module->bindings.size()) << what << ": a slot is used twice";
    EXPECT_EQ(bound, listed) << what;
    for (const auto& [id, number] : d.spec_id) numbered.insert(number);
    for (const ConstantInfo& info : module->constants) ids.insert(static_cast<std::uint32_t>(info.id));
    EXPECT_EQ(ids.size(), module->constants.size() + 3) << what << ": a constant's id is used twice";
    EXPECT_EQ(numbered, ids) << what;
  }
}

TEST(Modules, NamesAreUniqueAndFound) {
  std::set<std::string> names;
  for (const Module* module : modules()) {
    EXPECT_TRUE(names.insert(std::string(module->part) + "." + std::string(module->name)).second);
    EXPECT_EQ(find_module(module->part, module->name), module);
  }
  EXPECT_EQ(find_module("gaussian_blur", "no_such"), nullptr);
}

}  // namespace
}  // namespace luxel
