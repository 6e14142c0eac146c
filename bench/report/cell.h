// Values of the report's rows. The constructors of nlohmann's own are templates, which each file of rows would instantiate
// anew: half of what it takes to compile one, and more.
#pragma once
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace luxel::report {

struct Field;

/// A number, a text, true or false, null, or named fields in their order.
class Cell {
 public:
  Cell(std::nullptr_t = nullptr);
  Cell(bool value);
  Cell(int value);
  Cell(unsigned value);
  Cell(long value);
  Cell(unsigned long value);
  Cell(double value);
  Cell(const char* value);
  Cell(const std::string& value);
  Cell(std::initializer_list<Field> fields);

  /// Sets a field of fields, or of null.
  void set(const std::string& name, const Cell& value);
  /// NaN where it is none.
  double number() const;
  std::string text() const;  ///< as JSON
  const nlohmann::ordered_json& json() const { return *json_; }

 private:
  std::shared_ptr<const nlohmann::ordered_json> json_;  // shared by copies: never written to
};

struct Field {
  std::string name;
  Cell value;
};

}  // namespace luxel::report
