// What the Contexts of the three executions share: the bases of their memory and programs, and what they refuse.
#pragma once
#include <cstddef>

#include <luxel/device.h>

namespace luxel {

class Memory {
 public:
  Memory(const Context* owner, Resource resource, std::size_t bytes)
      : owner(owner), resource(std::move(resource)), bytes(bytes) {}
  virtual ~Memory() = default;
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  const Context* const owner;  // only it may use this memory
  const Resource resource;     // what it was made for
  const std::size_t bytes;
};

class Program {
 public:
  explicit Program(const Context* owner) : owner(owner) {}
  virtual ~Program() = default;
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  const Context* const owner;
};

/// Where a resource begins in its memory, in bytes.
std::size_t offset_bytes(const Plan& plan, const Named& named, bool real64);

/// What a run of any Context refuses: memory that is missing, of another device, or of another kind, extent or format
/// than the plan's resource, and names that are missing, unknown or given twice (`scratch` may be left out). Whether
/// buffers are large enough is the execution's to check.
Status check_memories(const Context* owner, const Plan& plan, const std::vector<Named>& resources);

}  // namespace luxel
