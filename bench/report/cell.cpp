#include "bench/report/cell.h"

#include <limits>

#include "bench/report/json.h"

namespace luxel::report {
namespace {

template <class T>
std::shared_ptr<const Json> make(T value) {
  return std::make_shared<const Json>(value);
}

}  // namespace

Cell::Cell(std::nullptr_t) : json_(make(nullptr)) {}
Cell::Cell(bool value) : json_(make(value)) {}
Cell::Cell(int value) : json_(make(value)) {}
Cell::Cell(unsigned value) : json_(make(value)) {}
Cell::Cell(long value) : json_(make(value)) {}
Cell::Cell(unsigned long value) : json_(make(value)) {}
Cell::Cell(double value) : json_(make(value)) {}
Cell::Cell(const char* value) : json_(make(value)) {}
Cell::Cell(const std::string& value) : json_(make(value)) {}

Cell::Cell(std::initializer_list<Field> fields) {
  Json object = Json::object();
  for (const Field& f : fields) object[f.name] = f.value.json();
  json_ = std::make_shared<const Json>(std::move(object));
}

void Cell::set(const std::string& name, const Cell& value) {
  Json object = *json_;
  object[name] = value.json();
  json_ = std::make_shared<const Json>(std::move(object));
}

std::string Cell::text() const { return json_->dump(); }
double Cell::number() const { return json_->is_number() ? json_->get<double>() : std::numeric_limits<double>::quiet_NaN(); }

}  // namespace luxel::report
