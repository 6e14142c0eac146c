#include "bench/report/schema.h"

#include <algorithm>
#include <map>

namespace luxel::report {
namespace {

// Type letters: s string, n number, b boolean, o object, a array, t a time {median, q1, q3, n, busy}; ? or null.
struct Field {
  const char* name;
  const char* type;
};
using Fields = std::vector<Field>;

const Fields time_fields{{"median", "n"}, {"q1", "n"}, {"q3", "n"}, {"n", "n"}, {"busy", "b"}};
const Fields phases{{"build", "t?"}, {"update", "t?"}, {"shade", "t?"}};
const Fields errors{{"metric", "s"},  {"rounding", "n?"},       {"storage", "n?"}, {"device", "n?"},
                    {"method", "n?"}, {"discretization", "n?"}, {"model", "n?"},   {"stderr", "n?"}};

const std::map<std::string, Fields>& sections() {
  static const std::map<std::string, Fields> all{
      {"frontier",
       {{"kernel", "s"},
        {"variant", "s"},
        {"device", "s"},
        {"scene", "s"},
        {"size", "s"},
        {"options", "o"},
        {"knobs", "o"},
        {"time_ms", "phases"},
        {"error", "errors"},
        {"bytes", "n?"},
        {"flops", "n?"},
        {"memory_bytes", "n?"},
        {"on_frontier", "b?"}}},
      {"defaults",
       {{"kernel", "s"},
        {"device", "s"},
        {"scene", "s"},
        {"size", "s"},
        {"metric", "s"},
        {"setting", "o"},
        {"error", "n?"},
        {"ms", "n"},
        {"better", "o?"},
        {"why", "s?"}}},
      {"stability",
       {{"kernel", "s"},
        {"case", "s"},
        {"device", "s"},
        {"promise", "s"},
        {"bound", "n"},
        {"measured", "n?"},
        {"pass", "b"}}},
      {"left_out",
       {{"kernel", "s"},
        {"scene", "s"},
        {"what", "s"},
        {"level", "n"},
        {"saved_ms", "n?"},
        {"saved_bytes", "n?"},
        {"error", "n?"},
        {"device", "s"}}},
      {"peers",
       {{"peer", "s"},
        {"version", "s"},
        {"kernel", "s"},
        {"size", "s"},
        {"time_ms", "t?"},
        {"error", "n?"},
        {"ratio", "n?"},
        {"q1", "n?"},
        {"q3", "n?"},
        {"device", "s"},
        {"options", "o"},
        {"own_ms", "t?"},
        {"own_error", "n?"},
        {"goal", "n?"}}},
      {"reproduction",
       {{"claim", "s"},
        {"source", "s"},
        {"source_value", "n?"},
        {"measured", "n?"},
        {"q1", "n?"},
        {"q3", "n?"},
        {"rule", "s"},
        {"verdict", "s"},
        {"reason", "s"},
        {"device", "s"}}},
      {"devices",
       {{"id", "s"},
        {"name", "s"},
        {"driver", "s"},
        {"profile", "s"},
        {"died", "b"},
        {"problems", "a"},
        {"limits", "a"},
        {"first_use", "a"}}},
  };
  return all;
}

void check_fields(const std::string& where, const Json& value, const Fields& fields, std::vector<std::string>& wrong);

void check_value(const std::string& where, const Json& v, const std::string& type, std::vector<std::string>& wrong) {
  if (type.back() == '?' && v.is_null()) return;
  const std::string kind = type.back() == '?' ? type.substr(0, type.size() - 1) : type;
  if (kind == "t") return check_fields(where, v, time_fields, wrong);
  if (kind == "phases") return check_fields(where, v, phases, wrong);
  if (kind == "errors") return check_fields(where, v, errors, wrong);
  const bool right = kind == "s"   ? v.is_string()
                     : kind == "n" ? v.is_number()
                     : kind == "b" ? v.is_boolean()
                     : kind == "o" ? v.is_object()
                                   : v.is_array();
  if (!right) wrong.push_back(where + " is a " + v.type_name() + "; expected type " + type);
}

void check_fields(const std::string& where, const Json& value, const Fields& fields, std::vector<std::string>& wrong) {
  if (!value.is_object()) {
    wrong.push_back(where + " is a " + value.type_name() + "; expected an object");
    return;
  }
  for (const Field& field : fields) {
    if (!value.contains(field.name))
      wrong.push_back(where + "." + field.name + " is missing");
    else
      check_value(where + "." + field.name, value.at(field.name), field.type, wrong);
  }
  for (const auto& [name, v] : value.items()) {
    const std::string& key = name;
    if (std::none_of(fields.begin(), fields.end(), [&](const Field& f) { return key == f.name; }))
      wrong.push_back(where + "." + key + " is unknown");
  }
}

}  // namespace

std::vector<std::string> check_row(const std::string& section, const Json& row) {
  std::vector<std::string> wrong;
  const auto found = sections().find(section);
  if (found == sections().end()) return {"section " + section + " is unknown"};
  Json copy = row;
  if (section == "frontier" && copy.is_object()) copy.erase("group");
  check_fields(section, copy, found->second, wrong);
  if (section == "frontier" && copy.is_object() && copy.contains("device") && copy["device"].is_string()) {
    const auto device = copy["device"].get<std::string>();
    if (!device.starts_with("opencl") && !device.starts_with("vulkan") && !device.starts_with("cpu"))
      wrong.push_back("frontier.device is " + device + "; expected opencl..., vulkan... or cpu...");
  }
  return wrong;
}

std::vector<std::string> check_schema(const Json& report) {
  std::vector<std::string> wrong;
  const Fields top{{"schema", "s"},    {"machine", "o"},  {"devices", "a"}, {"frontier", "a"}, {"defaults", "a"},
                   {"stability", "a"}, {"left_out", "a"}, {"peers", "a"},   {"reproduction", "a"}};
  check_fields("report", report, top, wrong);
  if (!wrong.empty()) return wrong;
  if (report["schema"] != schema_name)
    wrong.push_back("report.schema is " + report["schema"].dump() + "; expected " + schema_name);
  for (const char* section : {"devices", "frontier", "defaults", "stability", "left_out", "peers", "reproduction"})
    for (std::size_t i = 0; i < report[section].size(); ++i)
      for (const std::string& line : check_row(section, report[section][i]))
        wrong.push_back("row " + std::to_string(i) + ": " + line);
  return wrong;
}

}  // namespace luxel::report
