#include "cli/completion.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace turnscan::cli {

namespace {

constexpr std::size_t kLongestHelp = 70;

/// An option as seen by a shell.
struct ShellOption {
  std::vector<std::string> names;  ///< with dashes
  std::vector<std::string> choices;
  bool takes_value = false;
  std::string help;  ///< short
};

/// "-o, --out MESH" -> -o, --out, with a value.
ShellOption shell_option(const ArgumentInfo& info) {
  ShellOption option;
  std::string rest = info.usage;
  while (rest.starts_with('-')) {
    const std::size_t end = std::min(rest.find_first_of(", "), rest.size());
    option.names.push_back(rest.substr(0, end));
    rest.erase(0, std::min(rest.find_first_not_of(", ", end), rest.size()));
  }
  option.takes_value = !rest.empty();
  option.choices = info.choices;
  option.help = first_sentence(info.help);
  if (option.help.size() > kLongestHelp) {
    option.help.resize(std::min(option.help.rfind(' ', kLongestHelp - 3), kLongestHelp));
    option.help += " ...";
  }
  return option;
}

std::vector<ShellOption> options_of(const CommandReference& command) {
  std::vector<ShellOption> options;
  for (const ArgumentGroup& group : command.groups)
    for (const ArgumentInfo& info : group.arguments)
      if (info.usage.starts_with('-')) options.push_back(shell_option(info));
  return options;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// Escapes for zsh's _arguments, in single quotes.
std::string zsh_text(std::string text) {
  for (const char* special : {"\\", "[", "]", ":"})
    text = replaced(text, special, std::string("\\") + special);
  return replaced(text, "'", "'\\''");
}

std::string fish_text(const std::string& text) {
  return replaced(replaced(text, "\\", "\\\\"), "'", "\\'");
}

std::vector<std::string> names_of(const std::vector<CommandReference>& commands) {
  std::vector<std::string> names;
  for (const CommandReference& command : commands) names.push_back(command.name);
  return names;
}

void add_zsh_option(const ShellOption& option, std::string& page) {
  const std::string names = option.names.size() == 1
                                ? "'" + option.names.front()
                                : fmt::format("'({})'{{{}}}'", fmt::join(option.names, " "),
                                              fmt::join(option.names, ","));
  std::string value;
  if (!option.choices.empty())
    value = fmt::format(":value:({})", fmt::join(option.choices, " "));
  else if (option.takes_value)
    value = ":value:_files";
  page += fmt::format("      {}[{}]{}' \\\n", names, zsh_text(option.help), value);
}

void add_fish_option(const std::string& command, const ShellOption& option, std::string& page) {
  page += fmt::format("complete -c turnscan -n '__fish_seen_subcommand_from {}'", command);
  for (const std::string& name : option.names)
    page += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (!option.choices.empty())
    page += fmt::format(" -xa '{}'", fmt::join(option.choices, " "));
  else if (option.takes_value)
    page += " -r";
  page += fmt::format(" -d '{}'\n", fish_text(option.help));
}

}  // namespace

std::string bash_completion(const std::vector<CommandReference>& commands) {
  std::string choices, options;
  for (const CommandReference& command : commands) {
    std::vector<std::string> names;
    for (const ShellOption& option : options_of(command)) {
      names.insert(names.end(), option.names.begin(), option.names.end());
      if (option.choices.empty()) continue;
      choices += fmt::format(
          "    {0}/{1}) COMPREPLY=($(compgen -W \"{2}\" -- \"$cur\")); return ;;\n", command.name,
          fmt::join(option.names, "|" + command.name + "/"), fmt::join(option.choices, " "));
    }
    options += fmt::format("    {}) words=\"--help --help-all {}\" ;;\n", command.name,
                           fmt::join(names, " "));
  }
  return fmt::format(
      "# Completion of turnscan for bash. Printed by 'turnscan reference bash'.\n"
      "_turnscan() {{\n"
      "  local cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD-1]}} words=\n"
      "  COMPREPLY=()\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
      "    COMPREPLY=($(compgen -W \"--help --version help {}\" -- \"$cur\"))\n"
      "    return\n"
      "  fi\n"
      "  case \"${{COMP_WORDS[1]}}/$prev\" in\n{}  esac\n"
      "  # Anything else is completed as a file.\n"
      "  [[ $cur == -* ]] || return\n"
      "  case \"${{COMP_WORDS[1]}}\" in\n{}  esac\n"
      "  COMPREPLY=($(compgen -W \"$words\" -- \"$cur\"))\n"
      "}}\n"
      "complete -o default -o bashdefault -F _turnscan turnscan\n",
      fmt::join(names_of(commands), " "), choices, options);
}

std::string zsh_completion(const std::vector<CommandReference>& commands) {
  std::string page =
      "#compdef turnscan\n# Completion of turnscan for zsh. Printed by 'turnscan reference "
      "zsh'.\n\n"
      "_turnscan() {\n  if (( CURRENT == 2 )); then\n    local -a commands=(\n";
  for (const CommandReference& command : commands)
    page += fmt::format("      '{}:{}'\n", command.name, zsh_text(command.help));
  page +=
      "    )\n    _describe command commands\n    return\n  fi\n  local command=$words[2]\n"
      "  shift words\n  (( CURRENT-- ))\n  case $command in\n";
  for (const CommandReference& command : commands) {
    page += fmt::format("    {}) _arguments \\\n", command.name);
    for (const ShellOption& option : options_of(command)) add_zsh_option(option, page);
    page +=
        "      '--help[Print the most used options and exit]' "
        "'--help-all[Print all options and exit]' '*:file:_files' ;;\n";
  }
  return page + "  esac\n}\n\n_turnscan \"$@\"\n";
}

std::string fish_completion(const std::vector<CommandReference>& commands) {
  const std::string names = fmt::format("{}", fmt::join(names_of(commands), " "));
  std::string page =
      "# Completion of turnscan for fish. Printed by 'turnscan reference fish'.\n"
      "complete -c turnscan -l help -d 'Print the most used options and exit'\n"
      "complete -c turnscan -l help-all -d 'Print all options and exit'\n";
  for (const CommandReference& command : commands) {
    page += fmt::format(
        "complete -c turnscan -f -n 'not __fish_seen_subcommand_from {}' -a {} -d '{}'\n", names,
        command.name, fish_text(command.help));
    for (const ShellOption& option : options_of(command))
      add_fish_option(command.name, option, page);
  }
  return page;
}

}  // namespace turnscan::cli
