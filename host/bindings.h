// What every execution checks alike before it records anything: the plan against its modules, the names that were
// bound, and which bindings may not share memory.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <luxel/plan.h>

#include "host/module.h"

namespace luxel {

constexpr bool is_image(BindingKind kind) {
  return kind == BindingKind::image2d || kind == BindingKind::image3d || kind == BindingKind::sampled2d ||
         kind == BindingKind::sampled3d || kind == BindingKind::image_write2d || kind == BindingKind::image_read2d;
}
constexpr bool is_sampled(BindingKind kind) { return kind == BindingKind::sampled2d || kind == BindingKind::sampled3d; }
constexpr bool is_3d(BindingKind kind) { return kind == BindingKind::image3d || kind == BindingKind::sampled3d; }
constexpr bool is_written(BindingKind kind) {
  return kind == BindingKind::write || kind == BindingKind::update || kind == BindingKind::image_write2d;
}
constexpr bool is_read(BindingKind kind) { return !is_written(kind) || kind == BindingKind::update; }

/// A plan whose slots, parameters and constants do not fit its modules, or that calls resources `may_alias` although one
/// is still used when or after the other is written, is a defect: Code::internal.
Status check(const Plan& plan);

/// For each resource of the plan, and then for `scratch`, the index of its name in `names`; -1 for scratch where it is
/// neither needed nor given. Errors: invalid_argument for a name that is missing, unknown or given twice.
Result<std::vector<int>> match(const Plan& plan, std::span<const std::string_view> names);

/// How the plan's passes use a resource.
struct Use {
  int first_write = -1;  // index of a pass; -1: never
  int last_use = -1;
  bool read = false;
};
std::vector<Use> uses(const Plan& plan);

/// Pairs of different resources that may not share memory: one is written, and not both are `may_alias`. Indices as
/// `match` gives them, with scratch as the last, which shares with none.
std::vector<std::pair<int, int>> exclusive(const Plan& plan);

/// `gaussian_blur: bindings src and dst overlap ...`, for a pair of exclusive().
Status overlapping(const Plan& plan, std::pair<int, int> pair);

/// `gaussian_blur: binding dst ...`
Status bad_binding(const Plan& plan, std::string_view name, const std::string& what);

}  // namespace luxel
