#include "cli/man_page.hpp"

#include <fmt/format.h>

namespace turnscan::cli {

namespace {

/// Escapes text for roff. Hyphens of options must stay hyphens when they are copied.
std::string roff_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  const bool control = !out.empty() && (out.front() == '.' || out.front() == '\'');
  return control ? "\\&" + out : out;
}

std::string closed(std::string text) {
  if (!text.empty() && text.back() != '.') text += '.';
  return text;
}

void add_argument(const ArgumentInfo& info, std::string& page) {
  std::string text = closed(info.help);
  if (!info.allowed.empty()) text += fmt::format(" Allowed: {}.", info.allowed);
  if (!info.default_value.empty()) text += fmt::format(" Default: {}.", info.default_value);
  page += fmt::format(".TP\n.B {}\n{}\n", roff_text(info.usage), roff_text(text));
}

}  // namespace

std::string man_page(const std::vector<CommandReference>& commands) {
  std::string page =
      ".\\\" Printed by 'turnscan reference man'.\n"
      ".TH TURNSCAN 1 \"\" \"turnscan\" \"User Commands\"\n.SH NAME\n"
      "turnscan \\- make watertight meshes of objects on a turntable\n.SH SYNOPSIS\n"
      ".B turnscan\n.I COMMAND\n[\\fIARGUMENT\\fR ...] [\\fIOPTION\\fR ...]\n.SH DESCRIPTION\n"
      "A depth sensor looks at a turntable; turnscan finds the table, records what stands on it, "
      "and\n"
      "reconstructs a closed mesh of each object. Virtual scanners do the same, so that a rig can "
      "be\n"
      "judged before it is built.\n.PP\n"
      "Values carry their unit: lengths um, mm, cm, m, in; angles deg, rad; times ms, s, min;\n"
      "angular speeds deg/s, rad/s, rpm.\n.SH COMMANDS\n";
  for (const CommandReference& command : commands)
    page +=
        fmt::format(".TP\n.B {}\n{}\n", roff_text(command.name), roff_text(closed(command.help)));
  for (const CommandReference& command : commands) {
    page += fmt::format(".SH TURNSCAN {}\n{}\n", command.name, roff_text(closed(command.help)));
    for (const ArgumentGroup& group : command.groups) {
      if (group.arguments.empty()) continue;
      page += fmt::format(".SS {}\n", roff_text(group.title));
      for (const ArgumentInfo& info : group.arguments) add_argument(info, page);
    }
  }
  return page +
         ".SH EXIT STATUS\n.TP\n.B 0\nDone.\n.TP\n.B 1\nFailed; an error is one line on standard "
         "error.\n.TP\n.B 2\nWrong usage.\n.TP\n.B 130\nCancelled.\n.SH SEE ALSO\n"
         ".BR turnscan\\-studio (1),\nand the folder docs of the package, index.md first.\n";
}

}  // namespace turnscan::cli
