/// \file
/// Running luxel plans on Vulkan compute. Borrows every handle; owns only pipelines, layouts and linear samplers.
#pragma once
#include <vulkan/vulkan_core.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <luxel/plan.h>

/// Plans on Vulkan, in the caller's command buffers.
namespace luxel::vulkan {

/// A device of the caller's (Vulkan 1.1 or newer). Vulkan cannot be asked what was enabled, so the caller says it.
struct Adopt {
  VkInstance instance = VK_NULL_HANDLE;  ///< that the device is of
  VkPhysicalDevice physical = VK_NULL_HANDLE;  ///< that the device is of
  VkDevice device = VK_NULL_HANDLE;  ///< what is borrowed
  bool push_descriptor = false;   ///< VK_KHR_push_descriptor is enabled
  bool debug_utils = false;       ///< VK_EXT_debug_utils is enabled on the instance
  std::string cache_directory;    ///< pipeline cache; empty: none on disk
};

/// A borrowed device and the kernels that were compiled for it. Copies share both.
class Device {
 public:
  /// Borrow a device, which must outlive the result and every Pipeline made with it. Compiled kernels are kept until
  /// then, so that another plan of the same kernel costs nothing. Errors: invalid_argument for a null handle, or an
  /// extension that is not enabled; unsupported; out_of_memory.
  static Result<Device> adopt(const Adopt& info);

  const Profile& profile() const;  ///< what the device is fast at
  const std::string& name() const;          ///< as the driver reports it
  const std::string& driver() const;        ///< driver name and version

  struct State;
  std::shared_ptr<State> state;  ///< opaque; shared by copies
};

/// One resource of a plan, or `scratch`. Exactly one of buffer and view is set, as the resource's kind asks.
struct Binding {
  std::string_view name;  ///< of the resource, or `scratch`
  VkBuffer buffer = VK_NULL_HANDLE;  ///< usage STORAGE_BUFFER
  VkDeviceSize offset = 0;                  ///< a multiple of the device's alignment: 256 always is
  VkDeviceSize bytes = 0;                   ///< available from offset
  VkImageView view = VK_NULL_HANDLE;  ///< of all the image, identity swizzle
  VkImageLayout layout = VK_IMAGE_LAYOUT_GENERAL;  ///< that the image is in
};

/// Options of Pipeline::record.
struct Record {
  VkDescriptorPool pool = VK_NULL_HANDLE;   ///< needed where push descriptors were not named: a set a pass is allocated
  VkQueryPool timestamps = VK_NULL_HANDLE;  ///< optional: passes + 1 queries from first_query on, already reset
  std::uint32_t first_query = 0;  ///< of `timestamps`
  bool tables_current = false;              ///< scratch still holds this pipeline's tables from an earlier record
  /// The buffers that counts() names were made with the usage INDIRECT_BUFFER (Vulkan cannot be asked): passes along a list
  /// whose length is found on the device are dispatched with no more workgroups than it needs. False: by a fixed number.
  bool indirect = false;
  /// Needed where reads_texels(): views that record makes are appended; the caller destroys them once the commands ran.
  std::vector<VkBufferView>* texel_views = nullptr;
};

/// A plan compiled for a device. Any number of threads may record one pipeline at the same time.
class Pipeline {
 public:
  /// Compiles everything. Errors: unsupported (names the limit), compile_failed, out_of_memory.
  static Result<Pipeline> create(const Device& device, Plan plan);

  const Plan& plan() const;  ///< what it was made from

  /// What one record takes out of Record::pool, beside one set a pass. Empty with push descriptors.
  const std::vector<VkDescriptorPoolSize>& pool_sizes() const;

  /// Some pass reads through a texel buffer: buffers then need the usage UNIFORM_TEXEL_BUFFER as well. (Storage images
  /// of f32x2 need the device feature shaderStorageImageExtendedFormats.)
  bool reads_texels() const;

  /// What holds numbers of workgroups that one pass writes and a later one is dispatched by: names of resources, or
  /// `scratch`. Give these buffers the usage INDIRECT_BUFFER and set Record::indirect. Empty: no pass is of that kind.
  std::vector<std::string> counts() const;

  /// Records the plan's passes with the barriers between them; none at the edges. `scratch` needs the usages
  /// STORAGE_BUFFER, UNIFORM_BUFFER and TRANSFER_DST. What the caller's barriers must cover: resources are read and
  /// written in COMPUTE_SHADER by SHADER_READ and SHADER_WRITE; scratch moreover in TRANSFER by TRANSFER_WRITE (tables)
  /// and in COMPUTE_SHADER by UNIFORM_READ. (Counts are read in DRAW_INDIRECT only after this record wrote them, so that
  /// they ask for nothing of the caller.) Between two records that share scratch, or one of which writes what the
  /// other uses, one barrier from COMPUTE_SHADER with SHADER_WRITE to COMPUTE_SHADER and TRANSFER with SHADER_READ,
  /// SHADER_WRITE, UNIFORM_READ and TRANSFER_WRITE is enough. Binds a compute pipeline, its descriptors and push
  /// constants; other state of the command buffer stays. Errors: invalid_argument, out_of_memory, before anything is
  /// recorded.
  Status record(VkCommandBuffer commands, const std::vector<Binding>& bindings, const Record& options = {}) const;

  struct State;
  std::shared_ptr<State> state;  ///< opaque; shared by copies
};

}  // namespace luxel::vulkan
