#pragma once
// Parameters have one source. Beside each options struct stands a function `describe` that lists
// its fields: name, range, unit, help. The command line, the TOML file, the desktop program's
// fields and docs/reference/options.md are made from that list.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>
#include <turnscan/core/units.hpp>
#include <variant>
#include <vector>

namespace turnscan {

/// Inclusive limits of a number, in SI units. NaN is never allowed.
struct Range {
  double min;
  double max;
};

/// One field of one options struct, bound to an instance of it.
struct OptionField {
  std::string name;  ///< lower case with hyphens, unique in the table: "voxel-size"
  std::string help;  ///< one sentence
  Quantity quantity = Quantity::kNone;
  std::optional<Range> range;
  std::vector<std::string> choices;  ///< allowed texts of an enumeration
  bool is_flag = false;              ///< bool: true/false, --name / --no-name
  bool may_be_auto = false;          ///< "auto" leaves the value to be found from the data
  /// Current value as text that set() accepts.
  std::function<std::string()> get;
  /// Reads a value; the error names the field, the value and what is allowed.
  std::function<Result<>(std::string_view)> set;
  /// Succeeds, or the error names the field, the value and the allowed range; NaN fails.
  std::function<Result<>()> check;
};

/// Table of the fields of one or more options structs. It refers to them; they must outlive it.
/// Two fields of one name throw std::invalid_argument.
class OptionTable {
 public:
  OptionTable& flag(const std::string& name, bool& value, const std::string& help);
  OptionTable& number(const std::string& name, double& value, Quantity quantity, Range range,
                      const std::string& help);
  OptionTable& number(const std::string& name, int& value, Range range, const std::string& help);
  /// "auto" is std::nullopt.
  OptionTable& number(const std::string& name, std::optional<double>& value, Quantity quantity,
                      Range range, const std::string& help);
  OptionTable& number(const std::string& name, std::optional<int>& value, Range range,
                      const std::string& help);
  OptionTable& text(const std::string& name, std::string& value, const std::string& help);
  /// readable(text) succeeds, or its error names the field and says what is allowed.
  OptionTable& text(const std::string& name, std::string& value, const std::string& help,
                    const std::function<Result<>(std::string_view)>& readable);
  /// Enumeration: choices[i] stands for static_cast<E>(i).
  template <class E>
  OptionTable& choice(const std::string& name, E& value, const std::vector<std::string>& choices,
                      const std::string& help) {
    return choice_index(
        name, choices, help, [&value] { return static_cast<int>(value); },
        [&value](int i) { value = static_cast<E>(i); });
  }

  /// Appends the fields of another table, each name with `prefix` before it.
  OptionTable& append(OptionTable other, const std::string& prefix = "");

  const std::vector<OptionField>& fields() const { return fields_; }
  /// nullptr if there is none of that name.
  const OptionField* find(std::string_view name) const;
  /// Sets a field by name; an unknown name is an error that names the nearest ones.
  Result<> set(std::string_view name, std::string_view value) const;
  /// The first field that fails, or success.
  Result<> check() const;

 private:
  OptionTable& choice_index(const std::string& name, const std::vector<std::string>& choices,
                            const std::string& help, const std::function<int()>& get,
                            const std::function<void(int)>& set);
  OptionTable& add(OptionField field);
  std::vector<OptionField> fields_;
};

/// The options of one stage under the name of their table in a TOML file.
struct OptionGroup {
  std::string name;
  OptionTable table;
};

}  // namespace turnscan
