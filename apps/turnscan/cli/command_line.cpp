#include "cli/command_line.hpp"

#include <CLI/CLI.hpp>
#include <cmath>

#include <turnscan/workflow/config_file.hpp>

namespace turnscan::cli {

namespace {

constexpr std::size_t kHelpWidth = 64;  // of the right-hand column of --help

std::string spaced_names(const std::string& names) {
  std::string out;
  for (const char c : names) out += c == ',' ? ", " : std::string(1, c);
  return out;
}

std::string label_of(const OptionField& field) {
  if (!field.choices.empty()) return "CHOICE";
  switch (field.quantity) {
    case Quantity::kLength:
      return "LENGTH";
    case Quantity::kAngle:
      return "ANGLE";
    case Quantity::kTime:
      return "TIME";
    case Quantity::kAngularSpeed:
      return "SPEED";
    case Quantity::kNone:
      break;
  }
  return field.range ? "NUMBER" : "TEXT";
}

std::string limit_text(double value, Quantity quantity) {
  if (quantity == Quantity::kNone && value == std::floor(value) && std::fabs(value) < 1e15)
    return fmt::format("{:.0f}", value);
  if (quantity == Quantity::kLength && std::fabs(value) >= 1.0) return fmt::format("{:g}m", value);
  if (quantity == Quantity::kLength && value != 0.0 && std::fabs(value) < 1e-5)
    return fmt::format("{:g}um", value * 1e6);
  if (quantity == Quantity::kAngularSpeed) return fmt::format("{:g}rad/s", value);
  return format_quantity(value, quantity);
}

std::string allowed_text(const OptionField& field) {
  std::string text = fmt::format("{}", fmt::join(field.choices, ", "));
  if (field.range)
    text = fmt::format("{} to {}", limit_text(field.range->min, field.quantity),
                       limit_text(field.range->max, field.quantity));
  return field.may_be_auto ? "auto, or " + text : text;
}

std::string help_text(const ArgumentInfo& info) {
  std::string text = info.help;
  if (!info.allowed.empty()) text += fmt::format(" [{}]", info.allowed);
  if (!info.default_value.empty()) text += fmt::format(" (default: {})", info.default_value);
  return wrapped(text, kHelpWidth);
}

std::string without_full_stop(std::string text) {
  if (!text.empty() && text.back() == '.') text.pop_back();
  return text;
}

Error as_usage_error(Error error) {
  error.code = ErrorCode::kInvalidOption;
  return error;
}

}  // namespace

std::string first_sentence(const std::string& text) {
  constexpr std::string_view kExample = "e.g";  // its dot does not end a sentence
  auto end = text.find(". ");
  while (end != std::string::npos && text.substr(0, end).ends_with(kExample))
    end = text.find(". ", end + 1);
  return without_full_stop(text.substr(0, end));
}

ArgumentGroup keys_of(const std::string& name, const std::string& title, const OptionTable& table) {
  ArgumentGroup group{name, title, {}};
  for (const OptionField& field : table.fields())
    group.arguments.push_back(
        {field.name, without_full_stop(field.help), field.get(), allowed_text(field), {}});
  return group;
}

std::string wrapped(const std::string& text, std::size_t width) {
  std::string out;
  std::size_t column = 0, begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::size_t length = end - begin;
    if (column > 0 && column + 1 + length > width) {
      out += '\n';
      column = 0;
    }
    if (column > 0) {
      out += ' ';
      ++column;
    }
    out.append(text, begin, length);
    column += length;
    begin = end + 1;
  }
  return out;
}

CommandLine::CommandLine(CLI::App& app) : app_(app), groups_(2) {
  groups_[0].title = "Arguments";
  groups_[1].title = "Options";
}

CLI::Option* CommandLine::declare(CLI::Option* option, const std::string& label,
                                  const std::string& help) {
  const bool positional = option->get_positional();
  const bool takes_value = option->get_type_size() != 0;
  ArgumentInfo info;
  info.usage = positional ? option->get_name(true) : spaced_names(option->get_name(false, true));
  if (takes_value && !positional) info.usage += " " + label;
  info.help = help;
  option->group(positional ? "Arguments" : "Options");
  option->option_text(positional || !takes_value ? " " : label);
  option->description(wrapped(help, kHelpWidth));
  declared_.push_back({option, info});
  groups_[positional ? 0 : 1].arguments.push_back(std::move(info));
  return option;
}

void CommandLine::positional(const std::string& label, std::string& value,
                             const std::string& help) {
  declare(app_.add_option(label, value), label, help)->required();
}

void CommandLine::optional_positional(const std::string& label, std::string& value,
                                      const std::string& help) {
  declare(app_.add_option(label, value), label, help);
}

void CommandLine::positionals(const std::string& label, std::vector<std::string>& values,
                              const std::string& help) {
  declare(app_.add_option(label, values), label, help)->required();
}

void CommandLine::optional_positionals(const std::string& label, std::vector<std::string>& values,
                                       const std::string& help) {
  declare(app_.add_option(label, values), label, help);
}

void CommandLine::option(const std::string& names, const std::string& label, std::string& value,
                         const std::string& help) {
  declare(app_.add_option(names, value), label, help)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

void CommandLine::required_option(const std::string& names, const std::string& label,
                                  std::string& value, const std::string& help) {
  option(names, label, value, help);
  app_.get_options().back()->required();
}

void CommandLine::repeatable(const std::string& names, const std::string& label,
                             std::vector<std::string>& values, const std::string& help) {
  declare(app_.add_option(names, values), label, help)->allow_extra_args(false);
}

void CommandLine::required_repeatable(const std::string& names, const std::string& label,
                                      std::vector<std::string>& values, const std::string& help) {
  repeatable(names, label, values, help);
  app_.get_options().back()->required();
}

void CommandLine::flag(const std::string& names, bool& value, const std::string& help) {
  declare(app_.add_flag(names, value), "", help);
}

void CommandLine::bind(const OptionField& field, const std::string& title, ArgumentGroup& group) {
  ArgumentInfo info;
  info.help = without_full_stop(field.help);
  info.default_value = field.get();
  CLI::Option* option = nullptr;
  const std::string flag = "--" + field.name;
  if (field.is_flag) {
    option = app_.add_flag(flag + ",!--no-" + field.name);
    info.usage = flag + ", --no-" + field.name;
    info.default_value = info.default_value == "true" ? "on" : "off";
    option->option_text(" ");
  } else {
    const std::string label = label_of(field);
    option = app_.add_option(flag);
    info.usage = flag + " " + label;
    info.allowed = allowed_text(field);
    info.choices = field.choices;
    option->option_text(label);
    option->type_size(1)->expected(1);
  }
  option->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  option->group(title);
  option->description(help_text(info));
  declared_.push_back({option, info});
  group.arguments.push_back(std::move(info));
  bound_.push_back({option, &field});
}

void CommandLine::group(const std::string& name, const std::string& title, OptionTable table) {
  const OptionGroup& kept = option_groups_.emplace_back(OptionGroup{name, std::move(table)});
  ArgumentGroup shown{name, title, {}};
  for (const OptionField& field : kept.table.fields()) bind(field, title, shown);
  groups_.push_back(std::move(shown));
}

void CommandLine::allow_config() {
  option("--config", "FILE.toml", config_path_,
         "Read options from a TOML file: keys are the option names without the dashes, alone or "
         "under the table of their stage. The command line takes precedence over the file");
}

void CommandLine::file_option(const std::string& names, const std::string& label,
                              const std::string& help,
                              std::function<Result<>(const std::string&)> read) {
  FileOption& kept = file_options_.emplace_back(FileOption{{}, std::move(read)});
  option(names, label, kept.path, help);
}

Result<> CommandLine::apply() {
  for (const FileOption& file : file_options_)
    if (!file.path.empty()) TURNSCAN_TRY(file.read(file.path));
  if (!config_path_.empty()) TURNSCAN_TRY(read_config_file(config_path_, option_groups_));
  for (const Bound& bound : bound_) {
    if (bound.option->count() == 0) continue;
    if (auto set = bound.field->set(bound.option->results().back()); !set)
      return tl::unexpected<Error>(as_usage_error(std::move(set).error()));
  }
  return {};
}

std::vector<const CLI::Option*> CommandLine::show_common() {
  std::vector<const CLI::Option*> shown;
  for (const std::string& name : common_) shown.push_back(app_.get_option("--" + name));
  for (Declared& declared : declared_) {
    CLI::Option& option = *declared.option;
    declared.info.help = first_sentence(declared.info.help);
    option.description(help_text(declared.info));
    if (shown.empty() || option.get_positional()) continue;
    const bool is_common = std::find(shown.begin(), shown.end(), &option) != shown.end();
    option.group(is_common ? "Options" : "");
  }
  return shown;
}

std::size_t CommandLine::option_count() const {
  return std::size_t(std::count_if(declared_.begin(), declared_.end(),
                                   [](const Declared& d) { return !d.option->get_positional(); }));
}

std::vector<std::string> CommandLine::files_read() const {
  std::vector<std::string> files{config_path_};
  for (const FileOption& file : file_options_) files.push_back(file.path);
  return files;
}

std::vector<std::string> CommandLine::given() const {
  std::vector<std::string> names;
  for (const CLI::Option* option : app_.get_options())
    if (option->count() > 0 && !option->get_lnames().empty())
      names.push_back(option->get_lnames().front());
  return names;
}

std::vector<std::string> CommandLine::long_names() const {
  std::vector<std::string> names;
  for (const CLI::Option* option : app_.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back(name);
  }
  return names;
}

}  // namespace turnscan::cli
