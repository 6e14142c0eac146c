// Profiles that `luxel tune --profile` found, a file a device, and contexts that have them.
#pragma once
#include <memory>
#include <string>

#include <luxel/device.h>

#include "bench/report/json.h"

namespace luxel::report {

/// Folder of the files: LUXEL_PROFILES, else $XDG_CONFIG_HOME/luxel/profiles, else ~/.config/luxel/profiles.
std::string profile_folder();
/// The file of a device: its id, with what no file name should hold replaced.
std::string profile_path(const DeviceInfo& device);

/// {"device", "driver", "profile": name and shapes}.
Json to_json(const DeviceInfo& device, const Profile& profile);
/// Errors: invalid_argument, naming the field that is missing or out of range.
Result<Profile> profile_from(const Json& json);

/// A context's profile as the file of its device has it, where that is there and of the same driver; else as it was.
/// `problem` (optional): why a file that is there does not count.
std::shared_ptr<Context> tuned(std::shared_ptr<Context> context, std::string* problem = nullptr);
/// The same of a profile.
std::shared_ptr<Context> with_profile(std::shared_ptr<Context> context, const Profile& profile);

/// Opens a device (empty: the first of opencl, vulkan and cpu that works), tuned; a problem is a line on stderr.
Result<std::shared_ptr<Context>> open_tuned(const std::string& device);

/// "Profile" as C++: lines that set `p`.
std::string cpp_of(const Profile& profile);

}  // namespace luxel::report
