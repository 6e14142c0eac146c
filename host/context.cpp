#include "host/context.h"

#include "host/bindings.h"

namespace luxel {
namespace {

std::string texels_of(const Resource& resource) {
  std::string text;
  for (const int side : resource.extent) text += (text.empty() ? "" : "x") + std::to_string(side);
  return text + " " + name(resource.format);
}

}  // namespace

std::size_t offset_bytes(const Plan& plan, const Named& named, bool real64) {
  for (const Resource& resource : plan.resources) {
    if (resource.name != named.name) continue;
    const bool doubles = real64 && resource.format != Format::u32;
    return named.first * (doubles ? 8 * static_cast<std::size_t>(channels(resource.format))
                                  : bytes_per_pixel(resource.format));
  }
  return named.first;
}

Status check_memories(const Context* owner, const Plan& plan, const std::vector<Named>& resources) {
  std::vector<std::string_view> names;
  bool scratch = false;
  for (const Named& named : resources) {
    if (!named.memory) return bad_binding(plan, named.name, "has no memory");
    if (named.memory->owner != owner) return bad_binding(plan, named.name, "belongs to another device");
    names.push_back(named.name);
    if (named.first > 0 && named.memory->resource.kind != ResourceKind::buffer)
      return bad_binding(plan, named.name, "is an image bound from texel " + std::to_string(named.first) + "; expected 0");
    if (offset_bytes(plan, named, owner->real64()) > named.memory->bytes)
      return bad_binding(plan, named.name, "begins at pixel " + std::to_string(named.first) + ", behind the end of its " +
                                               std::to_string(named.memory->bytes) + " bytes");
    scratch = scratch || named.name == "scratch";
  }
  if (!scratch) names.push_back("scratch");
  const Result<std::vector<int>> matched = match(plan, names);
  if (!matched) return matched.status();
  for (std::size_t i = 0; i < plan.resources.size(); ++i) {
    const Resource& wanted = plan.resources[i];
    const Resource& made = resources[static_cast<std::size_t>(matched.value()[i])].memory->resource;
    const bool buffer = wanted.kind == ResourceKind::buffer;
    if (buffer != (made.kind == ResourceKind::buffer)) {
      return bad_binding(plan, wanted.name,
                         buffer ? "is an image; expected a buffer" : "is a buffer; expected an image");
    }
    if (!buffer && (wanted.extent != made.extent || wanted.format != made.format)) {
      return bad_binding(plan, wanted.name, "is an image of " + texels_of(made) + "; expected " + texels_of(wanted));
    }
  }
  return {};
}

}  // namespace luxel
