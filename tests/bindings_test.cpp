// The verdicts that every execution shares: names, aliases, and plans that contradict their modules.
#include <gtest/gtest.h>

#include <functional>

#include "host/bindings.h"
#include "tests/support/probe_list.h"

namespace luxel {
namespace {

constexpr BindingInfo in_out[] = {{BindingKind::read, 0, "f32x1", "a", 0}, {BindingKind::write, 1, "f32x1", "b", 0}};

Module copy_module() {
  Module module{};
  module.part = module.name = "copy";
  module.bindings = in_out;
  return module;
}

Slot resource(int index) { return {Slot::Source::resource, index}; }

/// src -> scratch -> dst, and src -> extra in a pass of its own.
struct Chain {
  Module module = copy_module();
  Plan plan;

  Chain() {
    plan.kernel = "chain";
    for (const char* name : {"src", "dst", "extra"}) {
      Resource next{name, ResourceKind::buffer, Format::f32x1, 400};
      next.written = plan.resources.size() > 0;
      plan.resources.push_back(next);
    }
    plan.scratch = {{Format::f32x1, 100, 0}};
    plan.scratch_bytes = 512;
    const Slot middle{Slot::Source::scratch, 0};
    for (const std::pair<Slot, Slot>& slots :
         {std::pair{resource(0), middle}, std::pair{resource(0), resource(2)}, std::pair{middle, resource(1)}}) {
      Pass pass;
      pass.module = &module;
      pass.label = "step";
      pass.slots = {slots.first, slots.second};
      plan.passes.push_back(pass);
    }
  }
};

TEST(Bindings, NamesAreMatchedInAnyOrder) {
  const Chain chain;
  const std::string_view names[] = {"extra", "scratch", "src", "dst"};
  EXPECT_EQ(match(chain.plan, names).value(), (std::vector<int>{2, 3, 0, 1}));
}

TEST(Bindings, ScratchMayBeLeftOutOrGivenWhereNoneIsNeeded) {
  Chain chain;
  chain.plan.scratch_bytes = 0;
  const std::string_view names[] = {"src", "dst", "extra", "scratch"};
  EXPECT_EQ(match(chain.plan, std::span(names, 3)).value().back(), -1);
  EXPECT_EQ(match(chain.plan, names).value().back(), 3);
}

TEST(Bindings, NamesThatAreMissingUnknownOrTwiceAreNamed) {
  const Chain chain;
  const auto message = [&](std::vector<std::string_view> names) {
    const Status status = match(chain.plan, names).status();
    EXPECT_EQ(status.code(), Code::invalid_argument);
    return status.message();
  };
  EXPECT_EQ(message({"src", "dst", "scratch"}), "chain: binding extra is missing; expected src, dst, extra, scratch");
  EXPECT_EQ(message({"src", "dst", "extra"}), "chain: binding scratch is missing; needs at least 512 bytes");
  EXPECT_EQ(message({"src", "dst", "extra", "scratch", "more"}),
            "chain: binding more is unknown; expected src, dst, extra, scratch");
  EXPECT_EQ(message({"src", "src", "dst", "extra", "scratch"}), "chain: binding src is given twice");
  EXPECT_EQ(message({}), "chain: binding src is missing; expected src, dst, extra, scratch");
}

TEST(Bindings, OnlyDeclaredAliasesMayOverlap) {
  Chain chain;
  using Pairs = std::vector<std::pair<int, int>>;
  EXPECT_EQ(exclusive(chain.plan), (Pairs{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}));
  chain.plan.resources[0].may_alias = chain.plan.resources[1].may_alias = true;
  EXPECT_EQ(exclusive(chain.plan), (Pairs{{0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}));
  EXPECT_EQ(overlapping(chain.plan, {0, 3}).message(),
            "chain: bindings src and scratch overlap; this plan needs them apart");
}

TEST(Bindings, UsesSayWhoWritesFirstAndWhoIsUsedLast) {
  const std::vector<Use> use = uses(Chain().plan);
  EXPECT_EQ(use[0].first_write, -1);
  EXPECT_EQ(use[0].last_use, 1);
  EXPECT_TRUE(use[0].read);
  EXPECT_EQ(use[1].first_write, 2);
  EXPECT_FALSE(use[1].read);
  EXPECT_EQ(use[2].first_write, 1);
}

TEST(Bindings, AGoodPlanPassesAndEveryDefectIsInternal) {
  const Chain good;
  EXPECT_TRUE(check(good.plan).ok()) << check(good.plan).message();
  const std::vector<std::function<void(Plan&)>> defects = {
      [](Plan& p) { p.passes[0].module = nullptr; },
      [](Plan& p) { p.passes[0].slots.pop_back(); },
      [](Plan& p) { p.passes[0].parameters = {1.0}; },
      [](Plan& p) { p.passes[0].constants = {1.0}; },
      [](Plan& p) { p.passes[0].slots[0].index = 3; },
      [](Plan& p) { p.passes[0].slots[0].index = -1; },
      [](Plan& p) { p.passes[0].slots[1] = {Slot::Source::scratch, 1}; },
      [](Plan& p) { p.passes[0].slots[0] = {Slot::Source::table, 0}; },
      [](Plan& p) { p.passes[0].workgroup[2] = 0; },
      [](Plan& p) { p.passes[0].groups[0] = 0; },
      [](Plan& p) { p.resources[0].kind = ResourceKind::image; },
      [](Plan& p) { p.resources[1].written = false; },
      [](Plan& p) { p.scratch[0].count = 129; },
      [](Plan& p) { p.scratch[0].count = 0; },
      [](Plan& p) { p.tables = p.exact_tables = {{1.0}}; },
      [](Plan& p) {
        p.tables = p.exact_tables = {std::vector<double>(4097)};
        p.scratch_bytes += 2 * table_bytes;
        p.scratch[0].offset = 2 * table_bytes;
      },
      [](Plan& p) { p.exact_tables = {{1.0}}; },
      [](Plan& p) { p.resources[0].may_alias = p.resources[2].may_alias = true; },
  };
  for (std::size_t i = 0; i < defects.size(); ++i) {
    Chain chain;
    defects[i](chain.plan);
    EXPECT_EQ(check(chain.plan).code(), Code::internal) << "defect " << i;
    EXPECT_EQ(check(chain.plan).message().rfind("chain: ", 0), 0u);
  }
  Plan counted = probe_list_plan(3);
  EXPECT_TRUE(check(counted).ok()) << check(counted).message();
  const std::vector<std::pair<std::function<void(Plan&)>, std::string>> miscounted = {
      {[](Plan& p) { p.passes[1].counts->first = 2; }, "probe: pass walk finds no three u32 where its counts are"},
      {[](Plan& p) { p.passes[1].counts->slot.index = 2; }, "finds no three u32"},
      {[](Plan& p) { p.passes[1].counts->slot = {Slot::Source::table, 0}; }, "finds no three u32"},
      {[](Plan& p) { p.scratch[1].format = Format::f32x1; }, "finds no three u32"},
      {[](Plan& p) { p.passes[1].counts->slot = {Slot::Source::resource, 0}; }, "counts that no earlier pass wrote"},
      {[](Plan& p) { std::swap(p.passes[0], p.passes[1]); }, "counts that no earlier pass wrote"},
      {[](Plan& p) { p.passes[0].counts = p.passes[1].counts; }, "probe: pass make writes its own counts"},
  };
  for (const auto& [change, what] : miscounted) {
    Plan plan = probe_list_plan(3);
    change(plan);
    EXPECT_EQ(check(plan).code(), Code::internal) << what;
    EXPECT_NE(check(plan).message().find(what), std::string::npos) << check(plan).message() << "\nexpected: " << what;
  }
  counted.resources[0].may_alias = counted.resources[1].may_alias = true;  // both are u32 that the walk still needs
  EXPECT_TRUE(check(counted).ok()) << "marked is read for the last time before done is written";
  Chain aliases;  // dst is written after src was read for the last time
  aliases.plan.resources[0].may_alias = aliases.plan.resources[1].may_alias = true;
  EXPECT_TRUE(check(aliases.plan).ok());
}

}  // namespace
}  // namespace luxel
