#include "host/vulkan/instance.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <string_view>
#include <utility>

#include "host/vulkan/result.h"

namespace luxel::vulkan {
namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

struct Messages {
  std::mutex mutex;
  std::vector<std::string> lines;
};

Messages& messages() {
  static Messages instance;
  return instance;
}

VKAPI_ATTR VkBool32 VKAPI_CALL keep_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                            const VkDebugUtilsMessengerCallbackDataEXT* data, void*) {
  const std::lock_guard lock(messages().mutex);
  messages().lines.emplace_back(data->pMessage);
  return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(bool best_practices) {
  auto info = structure<VkDebugUtilsMessengerCreateInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
  info.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  if (best_practices) info.messageType |= VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  info.pfnUserCallback = keep_message;
  return info;
}

bool has_instance_extension(const char* layer, const char* name) {
  std::uint32_t count = 0;
  if (vkEnumerateInstanceExtensionProperties(layer, &count, nullptr) != VK_SUCCESS) return false;
  std::vector<VkExtensionProperties> extensions(count);
  vkEnumerateInstanceExtensionProperties(layer, &count, extensions.data());
  return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties& extension) {
    return std::strcmp(extension.extensionName, name) == 0;
  });
}

bool has_layer(const char* name) {
  std::uint32_t count = 0;
  vkEnumerateInstanceLayerProperties(&count, nullptr);
  std::vector<VkLayerProperties> layers(count);
  vkEnumerateInstanceLayerProperties(&count, layers.data());
  return std::any_of(layers.begin(), layers.end(),
                     [&](const VkLayerProperties& layer) { return std::strcmp(layer.layerName, name) == 0; });
}

Status no_driver(const std::string& why) {
  return {Code::missing_driver, "vulkan: no device found (" + why +
                                    "); install a driver (Debian: mesa-vulkan-drivers, which has lavapipe, or the "
                                    "graphics card's own)"};
}

}  // namespace

Result<std::unique_ptr<Instance>> Instance::create() {
  const char* wanted = std::getenv("LUXEL_VALIDATION");
  if (wanted && std::string_view(wanted) != "" && std::string_view(wanted) != "0" && std::string_view(wanted) != "1" &&
      std::string_view(wanted) != "best_practices") {
    return Status(Code::invalid_argument, std::string("vulkan: LUXEL_VALIDATION is ") + wanted + "; expected 0, 1 or best_practices");
  }
  const bool best_practices = wanted && std::string_view(wanted) == "best_practices";
  const bool validate = best_practices || (wanted && std::string_view(wanted) == "1");
  if (validate && !has_layer(validation_layer)) {
    return Status(Code::missing_driver, std::string("vulkan: LUXEL_VALIDATION is ") + wanted + ", but the layer " +
                                            validation_layer +
                                            " is not installed; install it (Debian: vulkan-validationlayers)");
  }
  std::unique_ptr<Instance> instance(new Instance);
  instance->debug_utils_ = has_instance_extension(nullptr, VK_EXT_DEBUG_UTILS_EXTENSION_NAME) ||
                           (validate && has_instance_extension(validation_layer, VK_EXT_DEBUG_UTILS_EXTENSION_NAME));

  std::vector<const char*> extensions;
  if (instance->debug_utils_) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  if (validate) extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
  auto application = structure<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
  application.pApplicationName = "luxel";
  application.apiVersion = VK_API_VERSION_1_1;
  auto info = structure<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
  info.pApplicationInfo = &application;
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(best_practices);
  const VkValidationFeatureEnableEXT enabled[] = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT,
                                                  VK_VALIDATION_FEATURE_ENABLE_BEST_PRACTICES_EXT};
  auto features = structure<VkValidationFeaturesEXT>(VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT);
  features.enabledValidationFeatureCount = best_practices ? 2 : 1;
  features.pEnabledValidationFeatures = enabled;
  features.pNext = &messenger;
  if (validate) {
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &validation_layer;
    info.pNext = &features;
  }
  const VkResult created = vkCreateInstance(&info, nullptr, &instance->instance_);
  if (created == VK_ERROR_INCOMPATIBLE_DRIVER) return no_driver(name(created));
  if (created != VK_SUCCESS) return failure("vulkan: vkCreateInstance", created, Code::missing_driver);

  if (validate) {
    const auto create_messenger = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance->instance_, "vkCreateDebugUtilsMessengerEXT"));
    const VkResult result =
        create_messenger ? create_messenger(instance->instance_, &messenger, nullptr, &instance->messenger_)
                         : VK_ERROR_EXTENSION_NOT_PRESENT;
    if (result != VK_SUCCESS) return failure("vulkan: vkCreateDebugUtilsMessengerEXT", result);
  }

  std::uint32_t count = 0;
  VkResult result = vkEnumeratePhysicalDevices(instance->instance_, &count, nullptr);
  instance->devices_.resize(count);
  if (result == VK_SUCCESS) {
    result = vkEnumeratePhysicalDevices(instance->instance_, &count, instance->devices_.data());
  }
  instance->devices_.resize(count);
  if (result != VK_SUCCESS) return no_driver("vkEnumeratePhysicalDevices: " + name(result));
  if (count == 0) return no_driver("the installed drivers have none");
  return instance;
}

Instance::~Instance() {
  if (instance_ == VK_NULL_HANDLE) return;
  if (messenger_ != VK_NULL_HANDLE) {
    const auto destroy_messenger = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
    destroy_messenger(instance_, messenger_, nullptr);
  }
  vkDestroyInstance(instance_, nullptr);
}

std::vector<std::string> take_validation_messages() {
  const std::lock_guard lock(messages().mutex);
  return std::exchange(messages().lines, {});
}

}  // namespace luxel::vulkan
