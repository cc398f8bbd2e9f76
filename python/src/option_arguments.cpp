#include "option_arguments.hpp"

#include <pybind11/stl.h>

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

std::string text_of(const std::string& name, Quantity quantity, const py::handle& value) {
  if (value.is_none()) return "auto";
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  try {
    // Whole numbers and floats, numpy's among them. An option without a unit may be whole.
    return fmt::format("{}{}", value.cast<double>(), unit_of(quantity));
  } catch (const py::cast_error&) {
    raise({ErrorCode::kInvalidOption,
           fmt::format("{}: a value is a text, a number, True, False or None", name), ""});
  }
}

}  // namespace

Options options_from(const std::vector<OptionDescription>& known, const py::dict& arguments) {
  Options options;
  for (const auto& [key, value] : arguments) {
    std::string name = key.cast<std::string>();
    std::replace(name.begin(), name.end(), '_', '-');
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&](const OptionDescription& o) { return o.name == name; });
    const bool there = found != known.end();
    const Quantity quantity = there ? found->quantity : Quantity::kNone;
    if (there && found->repeatable && !py::isinstance<py::str>(value)) {
      for (const py::handle& one : value) options.emplace_back(name, text_of(name, quantity, one));
    } else {
      options.emplace_back(name, text_of(name, quantity, value));
    }
  }
  return options;
}

py::list described(const std::vector<OptionDescription>& options) {
  py::list list;
  for (const OptionDescription& option : options) {
    std::string name = option.name;
    std::replace(name.begin(), name.end(), '-', '_');
    py::dict entry;
    entry["name"] = name;
    entry["help"] = option.help;
    entry["default"] = option.default_value;
    entry["unit"] = unit_of(option.quantity);
    entry["choices"] = py::cast(option.choices);
    entry["minimum"] = option.range ? py::object(py::float_(option.range->min)) : py::none();
    entry["maximum"] = option.range ? py::object(py::float_(option.range->max)) : py::none();
    entry["flag"] = option.is_flag;
    list.append(entry);
  }
  return list;
}

}  // namespace turnscan::python
