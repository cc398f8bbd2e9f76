#pragma once
// The arguments of one subcommand. Each is declared once; parsing, --help, the TOML file and the
// reference page all come from that declaration. Options of the library come from OptionTable, so
// that names, defaults, ranges, units and error sentences have their one source beside the structs.

#include <deque>
#include <functional>
#include <string>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/result.hpp>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace turnscan::cli {

/// One argument as --help and the reference page show it.
struct ArgumentInfo {
  std::string usage;                   ///< "--voxel-size LENGTH", "RECORDING"
  std::string help;                    ///< one sentence or more
  std::string default_value;           ///< empty: none
  std::string allowed;                 ///< range or choices; empty: anything
  std::vector<std::string> choices{};  ///< of an enumeration
};

struct ArgumentGroup {
  std::string name;   ///< table in the TOML file; empty: command line only
  std::string title;  ///< for people
  std::vector<ArgumentInfo> arguments;
};

/// The keys of a table in a file that is no command's --config, for the reference page.
ArgumentGroup keys_of(const std::string& name, const std::string& title, const OptionTable& table);

class CommandLine {
 public:
  explicit CommandLine(CLI::App& app);

  /// Required arguments without a dash.
  void positional(const std::string& label, std::string& value, const std::string& help);
  /// May be left out.
  void optional_positional(const std::string& label, std::string& value, const std::string& help);
  void positionals(const std::string& label, std::vector<std::string>& values,
                   const std::string& help);
  void optional_positionals(const std::string& label, std::vector<std::string>& values,
                            const std::string& help);

  /// names: "-o,--out". The value stays as it is when the option is not given.
  void option(const std::string& names, const std::string& label, std::string& value,
              const std::string& help);
  void required_option(const std::string& names, const std::string& label, std::string& value,
                       const std::string& help);
  /// May be given several times.
  void repeatable(const std::string& names, const std::string& label,
                  std::vector<std::string>& values, const std::string& help);
  /// Must be given once at least.
  void required_repeatable(const std::string& names, const std::string& label,
                           std::vector<std::string>& values, const std::string& help);
  void flag(const std::string& names, bool& value, const std::string& help);

  /// Fields of an options struct, which must outlive this. With allow_config() before, they can
  /// also be set in the TOML file.
  void group(const std::string& name, const std::string& title, OptionTable table);

  /// Adds --config FILE.
  void allow_config();

  /// An option that names a file whose content takes precedence over the defaults, and the command
  /// line over it: `read` is called with its path before any field is set from the command line.
  void file_option(const std::string& names, const std::string& label, const std::string& help,
                   std::function<Result<>(const std::string&)> read);

  /// Called after parsing: sets the fields from the TOML file, then from the command line.
  Result<> apply();

  /// What most people use, by long names without dashes and by importance. --help lists these
  /// alone,
  /// --help-all everything.
  void common(std::vector<std::string> names) { common_ = std::move(names); }
  /// Leaves the others out of --help, and of each text all but its first sentence. Returns the
  /// common options, in their order; a command that names none shows all. Throws for a name that
  /// was not declared.
  std::vector<const CLI::Option*> show_common();
  /// How many options --help-all lists, --help and --help-all themselves apart.
  std::size_t option_count() const;

  /// The files that apply() has read.
  std::vector<std::string> files_read() const;

  const std::vector<ArgumentGroup>& groups() const { return groups_; }
  /// Every long name, without dashes.
  std::vector<std::string> long_names() const;

 private:
  struct Bound {
    CLI::Option* option;
    const OptionField* field;
  };
  struct Declared {
    CLI::Option* option;
    ArgumentInfo info;
  };

  CLI::Option* declare(CLI::Option* option, const std::string& label, const std::string& help);
  void bind(const OptionField& field, const std::string& title, ArgumentGroup& group);

  CLI::App& app_;
  struct FileOption {
    std::string path;
    std::function<Result<>(const std::string&)> read;
  };

  std::string config_path_;
  std::deque<FileOption> file_options_;  // a deque: paths keep their addresses
  std::vector<ArgumentGroup> groups_;
  std::deque<OptionGroup> option_groups_;  // a deque: fields keep their addresses
  std::vector<Bound> bound_;
  std::vector<Declared> declared_;
  std::vector<std::string> common_;
};

/// Of a help text, without its full stop.
std::string first_sentence(const std::string& text);

/// Breaks text at spaces into lines of at most `width` characters.
std::string wrapped(const std::string& text, std::size_t width);

}  // namespace turnscan::cli
