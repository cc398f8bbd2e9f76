#include <turnscan/workflow/config_file.hpp>

#include <toml++/toml.h>

#include <turnscan/io/text/toml_options.hpp>

namespace turnscan {

namespace {

tl::unexpected<Error> fail_in(const std::string& path, const toml::source_region& where,
                              const std::string& message) {
  return tl::unexpected<Error>(Error{
      ErrorCode::kInvalidOption, fmt::format("{}:{}: {}", path, where.begin.line, message), path});
}

Result<std::string> text_of(const toml::node& value) {
  if (const auto* text = value.as_string()) return text->get();
  if (const auto* number = value.as_integer()) return fmt::format("{}", number->get());
  if (const auto* number = value.as_floating_point()) return fmt::format("{}", number->get());
  if (const auto* flag = value.as_boolean()) return std::string(flag->get() ? "true" : "false");
  return fail(ErrorCode::kInvalidOption,
              "the value is neither text, number, true nor false; write it as on the command line");
}

const OptionGroup* group_of(const std::deque<OptionGroup>& groups, std::string_view field) {
  for (const OptionGroup& group : groups) {
    if (group.table.find(field)) return &group;
  }
  return nullptr;
}

/// Looks the key up in the table of all fields, so that the nearest name is searched among all of
/// them.
Result<> set_field(const std::deque<OptionGroup>& groups, const std::string& table,
                   const std::string& key, const std::string& value) {
  const OptionGroup* group = group_of(groups, key);
  if (group && !table.empty() && group->name != table)
    return fail(ErrorCode::kInvalidOption, "'{}' does not belong to [{}]; move it to [{}]", key,
                table, group->name);
  OptionTable all;
  for (const OptionGroup& g : groups) all.append(g.table);
  return all.set(key, value);
}

Result<> check_table(const std::deque<OptionGroup>& groups, const std::string& name) {
  std::string known;
  for (const OptionGroup& group : groups) {
    if (group.name == name) return {};
    known += (known.empty() ? "[" : ", [") + group.name + "]";
  }
  return fail(ErrorCode::kInvalidOption, "there is no table [{}]; use one of {}", name, known);
}

Result<> read_table(const std::string& path, const toml::table& table, const std::string& name,
                    const std::deque<OptionGroup>& groups) {
  for (const auto& [toml_key, node] : table) {
    const std::string key(toml_key.str());
    if (const toml::table* inner = node.as_table(); inner && name.empty()) {
      if (auto known = check_table(groups, key); !known)
        return fail_in(path, toml_key.source(), known.error().message);
      TURNSCAN_TRY(read_table(path, *inner, key, groups));
      continue;
    }
    const Result<std::string> value = text_of(node);
    if (!value) return fail_in(path, node.source(), key + ": " + value.error().message);
    if (auto set = set_field(groups, name, key, *value); !set)
      return fail_in(path, node.source(), set.error().message);
  }
  return {};
}

}  // namespace

Result<> read_config_file(const std::string& path, const std::deque<OptionGroup>& groups) {
  TURNSCAN_ASSIGN(const toml::table table, scene::read_toml(path));
  return read_table(path, table, "", groups);
}

}  // namespace turnscan
