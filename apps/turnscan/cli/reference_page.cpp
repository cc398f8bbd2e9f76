#include "cli/reference_page.hpp"

#include <fmt/format.h>

namespace turnscan::cli {

namespace {

std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|') out += '\\';
    out += c;
  }
  return out;
}

std::string code_cell(const std::string& text) {
  return text.empty() ? std::string() : fmt::format("`{}`", cell(text));
}

void append_plain(std::string& page, const ArgumentGroup& group) {
  page += fmt::format("\n| {} | meaning |\n|---|---|\n",
                      group.title == "Arguments" ? "argument" : "option");
  for (const ArgumentInfo& info : group.arguments)
    page += fmt::format("| `{}` | {} |\n", cell(info.usage), cell(info.help));
}

void append_group(std::string& page, const ArgumentGroup& group) {
  page += fmt::format("\n### {} `[{}]`\n\n", group.title, group.name);
  page += "| option | default | allowed | meaning |\n|---|---|---|---|\n";
  for (const ArgumentInfo& info : group.arguments)
    page += fmt::format("| `{}` | {} | {} | {} |\n", cell(info.usage),
                        code_cell(info.default_value), cell(info.allowed), cell(info.help));
}

void append_keys(std::string& page, const ArgumentGroup& group) {
  page += fmt::format("\n### {}{}\n\n", group.title,
                      group.name.empty() ? "" : fmt::format(" `[{}]`", group.name));
  page += "| key | default | allowed | meaning |\n|---|---|---|---|\n";
  for (const ArgumentInfo& info : group.arguments)
    page += fmt::format("| `{}` | {} | {} | {} |\n", cell(info.usage),
                        code_cell(info.default_value), cell(info.allowed), cell(info.help));
}

std::string usage(const CommandReference& command) {
  std::string text = "turnscan " + command.name;
  for (const ArgumentGroup& group : command.groups) {
    if (group.title != "Arguments") continue;
    for (const ArgumentInfo& info : group.arguments) text += " " + info.usage;
  }
  return text + " [OPTIONS]";
}

}  // namespace

std::string reference_page(const std::vector<CommandReference>& commands,
                           const std::vector<FileReference>& files) {
  std::string page =
      "# Reference of commands and options\n\n"
      "<!-- Printed by `turnscan reference`. Change the option tables in the sources, not this "
      "page. -->\n\n"
      "Values carry their unit: lengths um, mm, cm, m, in; angles deg, rad; times ms, s, min; "
      "angular speeds deg/s, rad/s, rpm.\n"
      "The name in brackets behind a title is the stage's table in a TOML file "
      "(`--config FILE.toml`).\n";
  for (const CommandReference& command : commands) {
    page += fmt::format("\n## turnscan {}\n\n{}.\n\n    {}\n", command.name, command.help,
                        usage(command));
    for (const ArgumentGroup& group : command.groups) {
      if (group.arguments.empty()) continue;
      if (group.name.empty()) {
        append_plain(page, group);
      } else {
        append_group(page, group);
      }
    }
  }
  for (const FileReference& file : files) {
    page += fmt::format("\n## {}\n\n{}\n", file.title, file.help);
    for (const ArgumentGroup& group : file.groups) append_keys(page, group);
  }
  return page;
}

}  // namespace turnscan::cli
