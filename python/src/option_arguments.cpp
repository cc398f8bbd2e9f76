#include "option_arguments.hpp"

#include <algorithm>

namespace turnscan::python {

namespace {

std::string unit_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::kLength:
      return "m";
    case Quantity::kAngle:
      return "rad";
    case Quantity::kTime:
      return "s";
    case Quantity::kAngularSpeed:
      return "rad/s";
    case Quantity::kNone:
      break;
  }
  return {};
}

std::string text_of(const OptionField* field, const py::handle& value) {
  if (value.is_none()) return "auto";
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  // Whole numbers and floats, numpy's among them. A field without a unit may be whole.
  const double number = value.cast<double>();
  const std::string unit = field != nullptr ? unit_of(field->quantity) : "";
  return fmt::format("{}{}", number, unit);
}

}  // namespace

void set_options(const OptionTable& table, const py::dict& options) {
  for (const auto& [key, value] : options) {
    std::string name = key.cast<std::string>();
    std::replace(name.begin(), name.end(), '_', '-');
    const OptionField* field = table.find(name);
    std::string text;
    try {
      text = text_of(field, value);
    } catch (const py::cast_error&) {
      raise({ErrorCode::kInvalidOption,
             fmt::format("{}: a value is a text, a number, True, False or None", name), ""});
    }
    unwrap(table.set(name, text));
  }
}

py::list described(const OptionTable& table) {
  py::list list;
  for (const OptionField& field : table.fields()) {
    std::string name = field.name;
    std::replace(name.begin(), name.end(), '-', '_');
    py::dict entry;
    entry["name"] = name;
    entry["help"] = field.help;
    entry["default"] = field.get();
    entry["unit"] = unit_of(field.quantity);
    py::list choices;
    for (const std::string& choice : field.choices) choices.append(choice);
    entry["choices"] = choices;
    entry["minimum"] = field.range ? py::object(py::float_(field.range->min)) : py::none();
    entry["maximum"] = field.range ? py::object(py::float_(field.range->max)) : py::none();
    entry["flag"] = field.is_flag;
    list.append(entry);
  }
  return list;
}

}  // namespace turnscan::python
