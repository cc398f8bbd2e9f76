#include "cli/program.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <deque>
#include <filesystem>
#include <new>
#include <system_error>
#include <turnscan/core/near_name.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/process/program_folders.hpp>
#include <turnscan/sensors/scanner_model.hpp>
#include <turnscan/workflow/output_file.hpp>
#include <turnscan/workflow/text/shown_text.hpp>
#include <version/named_version.hpp>

#include "cli/command_line.hpp"
#include "cli/completion.hpp"
#include "cli/interrupt.hpp"
#include "cli/man_page.hpp"
#include "cli/progress_display.hpp"
#include "cli/reference_page.hpp"

namespace turnscan::cli {

namespace {

constexpr int kExitFailed = 1;
constexpr int kExitUsage = 2;
constexpr std::size_t kListWidth = 76;  // of lines of --help
constexpr std::string_view kHelpCommand = "help";

struct RunOptions {
  int threads = 0;
  bool quiet = false;
};

OptionTable describe(RunOptions& o) {
  OptionTable table;
  table.number("threads", o.threads, {0, 1024},
               "Number of threads; 0 uses all cores. It does not change the result");
  table.flag("quiet", o.quiet, "Show no progress on standard error");
  return table;
}

/// Formats --help with wrapped lines, the common options in their order, and flags without CLI11's
/// marks.
class HelpFormatter : public CLI::Formatter {
 public:
  void put_first(std::vector<const CLI::Option*> options) { first_ = std::move(options); }

  std::string make_group(std::string title, bool is_positional,
                         std::vector<const CLI::Option*> options) const override {
    std::stable_sort(options.begin(), options.end(),
                     [this](const auto* a, const auto* b) { return place(a) < place(b); });
    return Formatter::make_group(std::move(title), is_positional, std::move(options));
  }
  std::string make_option_name(const CLI::Option* option, bool is_positional) const override {
    std::string name = Formatter::make_option_name(option, is_positional);
    if (const auto mark = name.find("{false}"); mark != std::string::npos)
      name.erase(mark, std::strlen("{false}"));
    for (auto i = name.find(','); i != std::string::npos; i = name.find(',', i + 2))
      name.insert(i + 1, " ");
    return name;
  }
  std::string make_option_usage(const CLI::Option* option) const override {
    std::string usage = Formatter::make_option_usage(option);
    if (const auto twice = usage.find("......"); twice != std::string::npos) usage.erase(twice, 3);
    return usage;
  }
  std::string make_subcommand(const CLI::App* command) const override {
    std::ostringstream out;
    CLI::detail::format_help(out, command->get_name(),
                             wrapped(command->get_description(), kListWidth), 16);
    return out.str();
  }

 private:
  std::ptrdiff_t place(const CLI::Option* option) const {
    return std::find(first_.begin(), first_.end(), option) - first_.begin();
  }

  std::vector<const CLI::Option*> first_;
};

/// Expands "help COMMAND" to "COMMAND --help". Reversed, as CLI11 expects.
std::vector<std::string> reversed_arguments(int argc, char** argv) {
  std::vector<std::string> arguments(argv + std::min(1, argc), argv + argc);
  if (!arguments.empty() && arguments.front() == kHelpCommand) {
    arguments.erase(arguments.begin());
    arguments.emplace_back("--help");
  }
  std::reverse(arguments.begin(), arguments.end());
  return arguments;
}

int exit_code_of(ErrorCode code) {
  if (code == ErrorCode::kCancelled) return kExitCancelled;
  return code == ErrorCode::kInvalidOption ? kExitUsage : kExitFailed;
}

/// Whether users write such files by hand, and can therefore correct them.
bool is_text_file(const std::string& path) {
  constexpr std::array<std::string_view, 7> kEndings{".json", ".csv",  ".toml", ".txt",
                                                     ".conf", ".yaml", ".yml"};
  return std::find(kEndings.begin(), kEndings.end(), ending_of(path)) != kEndings.end();
}

/// Advice for errors whose message gives none.
std::string_view advice_for(const Error& error) {
  switch (error.code) {
    case ErrorCode::kNotFound:
      return "check the path";
    case ErrorCode::kIo:
      return "check permissions and free space";
    case ErrorCode::kFormat:
      if (is_text_file(error.path)) return "correct it there";
      return "the file is damaged or not what its name says, so get it again";
    case ErrorCode::kUnsupported:
      return "use another format";
    case ErrorCode::kAlreadyExists:
      return "choose another name";
    case ErrorCode::kMissingData:
    case ErrorCode::kTooFewPoints:
      return "look at the input with 'turnscan info'; docs/how-to/bad-scan.md lists causes";
    case ErrorCode::kDeviceBusy:
      return "close the other program that uses it";
    case ErrorCode::kDeviceLost:
      return "check the cable and the power supply (docs/how-to/connect-a-sensor.md)";
    case ErrorCode::kNoPermission:
      return "let your user open it (docs/reference/devices.md says how)";
    default:
      return "try other options";
  }
}

std::string with_advice(const Error& error) {
  std::string text = error.text();
  if (text.find("; ") != std::string::npos) return text;
  return fmt::format("{}; {}", text, advice_for(error));
}

/// Allocates no memory, which may be what is lacking.
void put_error(std::string_view text) {
  std::fprintf(stderr, "turnscan: %.*s\n", static_cast<int>(text.size()), text.data());
}

/// Prints a single line, whatever a path or a library's message contains.
void print_error(const std::string& text) { put_error(shown_line(text)); }

std::string text_of_exception(const std::exception& error) {
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  const std::string_view what = error.what();
  // oneTBB throws a plain error with this message.
  if ((system != nullptr && system->code() == std::errc::resource_unavailable_try_again) ||
      what.find("pthread_create") != std::string_view::npos)
    return "the system allows no more threads; end other programs, raise the limit (ulimit -u), or "
           "use --threads 1";
  return shown_line(system != nullptr
                        ? fmt::format("system: {}; check limits and permissions", what)
                        : fmt::format("internal error: {}; please report it with the command that "
                                      "you ran",
                                      what));
}

std::string with_hint(const std::string& text, const std::string& command) {
  const char* joint = text.find("; ") == std::string::npos ? "; " : ", or ";
  return fmt::format("{}{}see '{} --help'", text, joint, command);
}

int usage_error(const std::string& text, const std::string& command) {
  print_error(with_hint(text, command));
  return kExitUsage;
}

/// Flushes at the end, because a full disk is only detected when the buffer is flushed.
int put_text(const std::string& text) {
  std::fputs(shown_text(text).c_str(), stdout);
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return 0;
  print_error(fmt::format("standard output: {}; make room or print elsewhere",
                          errno != 0 ? std::strerror(errno) : "cannot be written"));
  return kExitFailed;
}

/// CLI11's usage errors in the style of our own messages.
std::string parse_error_text(const CLI::ParseError& error) {
  std::string text = error.what();
  if (const auto at = text.rfind(" is required"); at != std::string::npos)
    return text.substr(0, at) + ": missing; give it";
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr)
    return text.substr(0, text.find(':')) + ": its value is missing; give one";
  return text;
}

std::string name_of_option(std::string_view argument) {
  argument = argument.substr(0, argument.find('='));
  return std::string(argument.substr(std::min(argument.find_first_not_of('-'), argument.size())));
}

/// names: all option names; also_in: the commands that have one with that name.
std::string unknown_argument(const std::string& argument, const std::vector<std::string>& names,
                             const std::vector<std::string>& also_in) {
  if (argument.rfind('-', 0) != 0)
    return fmt::format("{}: unexpected argument; remove it", argument);
  const std::string plain = argument.substr(0, argument.find('='));
  const std::string none = fmt::format("{}: there is no such option", plain);
  if (const auto near = near_name(name_of_option(plain), names))
    return fmt::format("{}; did you mean '--{}'", none, *near);
  if (also_in.empty()) return none;
  return fmt::format("{} here; it belongs to {}", none, fmt::join(also_in, ", "));
}

/// Where the pages of the manual are that the texts of this program name.
std::string place_of_manual() {
  for (const char* first : {"html/index.html", "docs/index.md"})
    for (const auto& folder : process::own_folders("share/doc/turnscan"))
      if (std::error_code error; std::filesystem::exists(folder / first, error))
        return fmt::format("The manual is {}.", (folder / first).string());
  return "The manual is docs/index.md, in the sources.";
}

}  // namespace

struct Program::Entry {
  std::string help, page;
  std::unique_ptr<Command> command;
  CLI::App* app;
  CommandLine line;
  RunOptions run_options;

  Entry(std::string help_text, std::string of_manual, std::unique_ptr<Command> c, CLI::App* a)
      : help(std::move(help_text)),
        page(std::move(of_manual)),
        command(std::move(c)),
        app(a),
        line(*a) {
    command->declare(line);
    line.group("run", "Running", describe(run_options));
    app->allow_extras();  // so that we can suggest the nearest option ourselves
  }
};

struct Program::Parts {
  CLI::App app{"turnscan makes watertight meshes from recordings of objects on a turntable."};
  std::shared_ptr<HelpFormatter> formatter = std::make_shared<HelpFormatter>();
  std::deque<Entry> entries;
};

Program::Program() : parts_(std::make_unique<Parts>()) {
  CLI::App& app = parts_->app;
  app.name("turnscan");
  app.require_subcommand(0, 1);
  app.allow_extras();
  app.set_version_flag("-v,--version", "turnscan " + named_version(), "Print the version");
  HelpFormatter& formatter = *parts_->formatter;
  formatter.column_width(36);
  formatter.label("SUBCOMMAND", "COMMAND ...");
  formatter.label("Positionals", "Arguments");
  app.formatter(parts_->formatter);
  app.set_help_flag("-h,--help", "Print this help and exit");
  app.footer("'turnscan help COMMAND' or 'turnscan COMMAND --help' explains one command.\n" +
             place_of_manual());
}

Program::~Program() = default;

namespace {

FileReference scanner_file() {
  ScannerParameters parameters;
  return {"Scanner files",
          "A virtual scanner is a TOML file; the presets are in data/scanners. A quantity with a "
          "unit is a text: `near = \"0.5m\"`.",
          {keys_of("", "Scanner", describe(parameters)),
           keys_of("noise", "Noise", describe(parameters.noise))}};
}

}  // namespace

void Program::add(const std::string& name, const std::string& help, const std::string& page,
                  std::unique_ptr<Command> command) {
  CLI::App* app = parts_->app.add_subcommand(name, help);
  app->group("Commands");
  parts_->entries.emplace_back(help, page, std::move(command), app);
  app->set_help_all_flag("--help-all", "Print all options and exit");
}

Result<std::string> Program::reference(const std::string& format) const {
  std::vector<CommandReference> commands;
  for (const Entry& entry : parts_->entries)
    commands.push_back({entry.app->get_name(), entry.help, entry.line.groups()});
  if (format == "markdown") return reference_page(commands, {scanner_file()});
  if (format == "man") return man_page(commands);
  if (format == "bash") return bash_completion(commands);
  if (format == "zsh") return zsh_completion(commands);
  if (format == "fish") return fish_completion(commands);
  return fail(ErrorCode::kInvalidOption,
              "FORMAT {}: there is no such format; use markdown, man, bash, zsh or fish", format);
}

void Program::add_reference() {
  class ReferenceCommand : public Command {
   public:
    explicit ReferenceCommand(const Program& program) : program_(program) {}
    void declare(CommandLine& line) override {
      line.optional_positional("FORMAT", format_,
                               "markdown: this page (default); man: the manual page; bash, zsh, "
                               "fish: what the shell completes");
    }
    FileRoles files() const override { return {}; }
    Result<> run(Session& session) override {
      TURNSCAN_ASSIGN(const std::string page, program_.reference(format_));
      session.print("{}", page);
      return {};
    }

   private:
    const Program& program_;
    std::string format_ = "markdown";
  };
  add("reference", "Print the reference page of all commands and options",
      "docs/reference/options.md", std::make_unique<ReferenceCommand>(*this));
}

std::vector<std::string> Program::commands_with(const std::string& option) const {
  std::vector<std::string> out;
  for (const Entry& entry : parts_->entries) {
    const auto names = entry.line.long_names();
    if (std::find(names.begin(), names.end(), option) != names.end())
      out.push_back(entry.app->get_name());
  }
  return out;
}

std::optional<std::string> Program::unknown_argument_of(const Entry& entry) const {
  auto extra = entry.app->remaining();
  std::erase(extra, "--");  // what follows it was treated as arguments
  if (extra.empty()) return std::nullopt;
  return unknown_argument(extra.front(), entry.line.long_names(),
                          commands_with(name_of_option(extra.front())));
}

Program::Entry* Program::chosen() {
  for (Entry& entry : parts_->entries)
    if (parts_->app.got_subcommand(entry.app)) return &entry;
  return nullptr;
}

int Program::run_command(Entry& entry) {
  const std::string called = "turnscan " + entry.app->get_name();
  if (const auto unknown = unknown_argument_of(entry)) return usage_error(*unknown, called);
  if (auto applied = entry.line.apply(); !applied) {
    const Error& error = applied.error();
    if (exit_code_of(error.code) == kExitUsage) return usage_error(error.text(), called);
    print_error(with_advice(error));
    return exit_code_of(error.code);
  }
  FileRoles files = entry.command->files();
  for (std::string& file : entry.line.files_read()) files.inputs.push_back(std::move(file));
  if (const auto checked = check_file_roles(files); !checked)
    return usage_error(checked.error().text(), called);
  set_thread_count(entry.run_options.threads);
  Session session{RunContext()};
  const InterruptWatch watch(session.context());
  ProgressDisplay display(session.context(), session.status(), entry.run_options.quiet);
  session.on_question([&](bool paused) { display.pause(paused); });
  session.on_plan([&](PhasePlan phases) { display.plan(std::move(phases)); });
  Result<> result = entry.command->run(session);
  display.finish(result ? RunEnd::kDone : RunEnd::kFailed);
  const int put = put_text(session.text());
  if (result) return put;
  const int code = exit_code_of(result.error().code);
  if (code == kExitUsage) return usage_error(result.error().text(), called);
  // A command that leaves partial results when it is stopped says so itself.
  const bool told = result.error().message.find("; ") != std::string::npos;
  print_error(code == kExitCancelled && !told
                  ? entry.app->get_name() + ": cancelled; run it again to finish"
                  : with_advice(result.error()));
  return code;
}

std::string Program::help() {
  if (Entry* entry = chosen()) {
    parts_->formatter->put_first(entry->line.show_common());
    entry->app->footer(
        fmt::format("'turnscan {} --help-all' explains all {} options.\nThe manual has more in {}.",
                    entry->app->get_name(), entry->line.option_count(), entry->page));
  }
  return parts_->app.help();
}

int Program::unknown_command(const std::string& name) {
  std::vector<std::string> names;
  for (const Entry& entry : parts_->entries) names.push_back(entry.app->get_name());
  const auto near = near_name(name, names);
  return usage_error(fmt::format("{}: there is no such command; {}", name,
                                 near ? fmt::format("did you mean '{}'", *near)
                                      : fmt::format("use one of {}", fmt::join(names, ", "))),
                     "turnscan");
}

int Program::run(int argc, char** argv) {
  CLI::App& app = parts_->app;
  try {
    app.parse(reversed_arguments(argc, argv));
  } catch (const CLI::CallForHelp&) {
    const auto extra = app.remaining();
    const bool named = !extra.empty() && !extra.front().starts_with('-');
    return named ? unknown_command(extra.front()) : put_text(help());
  } catch (const CLI::CallForAllHelp&) {
    return put_text(app.help());
  } catch (const CLI::CallForVersion& version_text) {
    return put_text(std::string(version_text.what()) + "\n");
  } catch (const CLI::ParseError& error) {
    const Entry* entry = chosen();
    if (entry == nullptr) return usage_error(parse_error_text(error), "turnscan");
    // A mistyped option may be the one that is missing.
    return usage_error(unknown_argument_of(*entry).value_or(parse_error_text(error)),
                       "turnscan " + entry->app->get_name());
  }
  if (Entry* entry = chosen()) return run_command(*entry);
  const auto extra = app.remaining();
  if (extra.empty()) return usage_error("no command was given", "turnscan");
  if (extra.front().rfind('-', 0) == 0)
    return usage_error(unknown_argument(extra.front(), {"help", "version"},
                                        commands_with(name_of_option(extra.front()))),
                       "turnscan");
  return unknown_command(extra.front());
}

int run_guarded(int (*body)(int, char**), int argc, char** argv) {
  try {
    return body(argc, argv);
  } catch (const std::bad_alloc&) {
    put_error("out of memory; use larger voxels, fewer frames or --threads 1");
  } catch (const std::exception& error) {
    put_error(text_of_exception(error));
  }
  return kExitFailed;
}

}  // namespace turnscan::cli
