#include "host/module.h"

namespace luxel {

const Module* find_module(std::string_view part, std::string_view name) {
  for (const Module* module : modules())
    if (module->part == part && module->name == name) return module;
  return nullptr;
}

}  // namespace luxel
