#include <algorithm>
#include <turnscan/api/named_options.hpp>

namespace turnscan::api {

std::vector<std::string> take(Options& options, std::string_view name) {
  std::vector<std::string> values;
  for (const auto& [given, value] : options)
    if (given == name) values.push_back(value);
  std::erase_if(options, [&](const auto& option) { return option.first == name; });
  return values;
}

Result<> set_fields(const OptionTable& table, const Options& options) {
  for (const auto& [name, value] : options) TURNSCAN_TRY(table.set(name, value));
  return {};
}

std::vector<OptionDescription> describe_fields(const OptionTable& table,
                                               const std::vector<RepeatableOption>& more) {
  std::vector<OptionDescription> out;
  for (const OptionField& field : table.fields())
    out.push_back({field.name, field.help, field.get(), field.quantity, field.range, field.choices,
                   field.is_flag, field.may_be_auto, false});
  for (const RepeatableOption& option : more) {
    OptionDescription description;
    description.name = option.name;
    description.help = option.help;
    description.repeatable = true;
    out.push_back(std::move(description));
  }
  return out;
}

}  // namespace turnscan::api
