#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <turnscan/core/near_name.hpp>
#include <turnscan/core/option_table.hpp>

namespace turnscan {

namespace {

Result<> check_range(const std::string& name, double value, Quantity quantity, Range range) {
  if (value >= range.min && value <= range.max) return {};
  return fail(ErrorCode::kInvalidOption, "{} = {} is outside {} to {}", name,
              format_quantity(value, quantity), format_quantity(range.min, quantity),
              format_quantity(range.max, quantity));
}

Result<double> parse_field(const std::string& name, std::string_view text, Quantity quantity,
                           Range range) {
  auto value = parse_quantity(text, quantity);
  if (!value) return fail(ErrorCode::kInvalidOption, "{}: {}", name, value.error().message);
  TURNSCAN_TRY(check_range(name, *value, quantity, range));
  return value;
}

Result<int> parse_integer(const std::string& name, std::string_view text, Range range) {
  range.min = std::max(range.min, double(std::numeric_limits<int>::min()));
  range.max = std::min(range.max, double(std::numeric_limits<int>::max()));
  TURNSCAN_ASSIGN(const double value, parse_field(name, text, Quantity::kNone, range));
  if (value != std::floor(value))
    return fail(ErrorCode::kInvalidOption, "{} = {} is not a whole number", name, text);
  return static_cast<int>(value);
}

}  // namespace

OptionTable& OptionTable::add(OptionField field) {
  if (find(field.name) != nullptr)
    throw std::invalid_argument("two options are named " + field.name);
  fields_.push_back(std::move(field));
  return *this;
}

OptionTable& OptionTable::flag(const std::string& name, bool& value, const std::string& help) {
  OptionField f;
  f.name = name;
  f.help = help;
  f.is_flag = true;
  f.get = [&value] { return std::string(value ? "true" : "false"); };
  f.set = [&value, name](std::string_view text) -> Result<> {
    if (text != "true" && text != "false")
      return fail(ErrorCode::kInvalidOption, "{} = {} is neither true nor false", name, text);
    value = text == "true";
    return {};
  };
  f.check = [] { return Result<>(); };
  return add(std::move(f));
}

OptionTable& OptionTable::number(const std::string& name, double& value, Quantity quantity,
                                 Range range, const std::string& help) {
  OptionField f;
  f.name = name;
  f.help = help;
  f.quantity = quantity;
  f.range = range;
  f.get = [&value, quantity] { return format_quantity(value, quantity); };
  f.set = [=, &value](std::string_view text) -> Result<> {
    TURNSCAN_ASSIGN(value, parse_field(name, text, quantity, range));
    return {};
  };
  f.check = [=, &value] { return check_range(name, value, quantity, range); };
  return add(std::move(f));
}

OptionTable& OptionTable::number(const std::string& name, int& value, Range range,
                                 const std::string& help) {
  OptionField f;
  f.name = name;
  f.help = help;
  f.range = range;
  f.get = [&value] { return std::to_string(value); };
  f.set = [=, &value](std::string_view text) -> Result<> {
    TURNSCAN_ASSIGN(value, parse_integer(name, text, range));
    return {};
  };
  f.check = [=, &value] { return check_range(name, value, Quantity::kNone, range); };
  return add(std::move(f));
}

OptionTable& OptionTable::number(const std::string& name, std::optional<double>& value,
                                 Quantity quantity, Range range, const std::string& help) {
  OptionField f;
  f.name = name;
  f.help = help;
  f.quantity = quantity;
  f.range = range;
  f.may_be_auto = true;
  f.get = [&value, quantity] {
    return value ? format_quantity(*value, quantity) : std::string("auto");
  };
  f.set = [=, &value](std::string_view text) -> Result<> {
    if (text == "auto") {
      value.reset();
      return {};
    }
    TURNSCAN_ASSIGN(value, parse_field(name, text, quantity, range));
    return {};
  };
  f.check = [=, &value] { return value ? check_range(name, *value, quantity, range) : Result<>(); };
  return add(std::move(f));
}

OptionTable& OptionTable::number(const std::string& name, std::optional<int>& value, Range range,
                                 const std::string& help) {
  OptionField f;
  f.name = name;
  f.help = help;
  f.range = range;
  f.may_be_auto = true;
  f.get = [&value] { return value ? std::to_string(*value) : std::string("auto"); };
  f.set = [=, &value](std::string_view text) -> Result<> {
    if (text == "auto") {
      value.reset();
      return {};
    }
    TURNSCAN_ASSIGN(value, parse_integer(name, text, range));
    return {};
  };
  f.check = [=, &value] {
    return value ? check_range(name, *value, Quantity::kNone, range) : Result<>();
  };
  return add(std::move(f));
}

OptionTable& OptionTable::text(const std::string& name, std::string& value,
                               const std::string& help) {
  return text(name, value, help, [](std::string_view) { return Result<>(); });
}

OptionTable& OptionTable::text(const std::string& name, std::string& value, const std::string& help,
                               const std::function<Result<>(std::string_view)>& readable) {
  OptionField f;
  f.name = name;
  f.help = help;
  f.get = [&value] { return value; };
  f.set = [&value, readable](std::string_view text) -> Result<> {
    TURNSCAN_TRY(readable(text));
    value = std::string(text);
    return {};
  };
  f.check = [&value, readable] { return readable(value); };
  return add(std::move(f));
}

OptionTable& OptionTable::choice_index(const std::string& name,
                                       const std::vector<std::string>& choices,
                                       const std::string& help, const std::function<int()>& get,
                                       const std::function<void(int)>& set) {
  OptionField f;
  f.name = name;
  f.help = help;
  f.choices = choices;
  f.get = [choices, get] { return choices.at(static_cast<std::size_t>(get())); };
  f.set = [choices, name, set](std::string_view text) -> Result<> {
    const auto found = std::find(choices.begin(), choices.end(), text);
    if (found == choices.end())
      return fail(ErrorCode::kInvalidOption, "{} = {} is not one of {}", name, text,
                  fmt::join(choices, ", "));
    set(static_cast<int>(found - choices.begin()));
    return {};
  };
  f.check = [choices, name, get]() -> Result<> {
    if (get() >= 0 && static_cast<std::size_t>(get()) < choices.size()) return {};
    return fail(ErrorCode::kInvalidOption, "{} = {} is not one of {}", name, get(),
                fmt::join(choices, ", "));
  };
  return add(std::move(f));
}

OptionTable& OptionTable::append(OptionTable other, const std::string& prefix) {
  for (OptionField& field : other.fields_) {
    field.name = prefix + field.name;
    add(std::move(field));
  }
  return *this;
}

const OptionField* OptionTable::find(std::string_view name) const {
  const auto found = std::find_if(fields_.begin(), fields_.end(),
                                  [&](const OptionField& f) { return f.name == name; });
  return found == fields_.end() ? nullptr : &*found;
}

Result<> OptionTable::set(std::string_view name, std::string_view value) const {
  if (const OptionField* field = find(name)) return field->set(value);
  std::vector<std::string> names;
  for (const OptionField& field : fields_) names.push_back(field.name);
  const auto nearest = near_name(name, names);
  if (!nearest) return fail(ErrorCode::kInvalidOption, "there is no option '{}'", name);
  return fail(ErrorCode::kInvalidOption, "there is no option '{}'; did you mean '{}'", name,
              *nearest);
}

Result<> OptionTable::check() const {
  for (const OptionField& field : fields_) TURNSCAN_TRY(field.check());
  return {};
}

}  // namespace turnscan
