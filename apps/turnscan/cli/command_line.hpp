#pragma once
// The arguments of one subcommand. Each is declared once; parsing, --help, the TOML file and the
// reference page all use that declaration. Options of the library come from OptionTable, so that
// names, defaults, ranges, units and error messages are defined only once, next to the structs.

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

/// An argument as shown by --help and the reference page.
struct ArgumentInfo {
  std::string usage;                   ///< "--voxel-size LENGTH", "RECORDING"
  std::string help;                    ///< one sentence or more
  std::string default_value;           ///< empty: none
  std::string allowed;                 ///< range or choices; empty: anything
  std::vector<std::string> choices{};  ///< if it is an enumeration
};

struct ArgumentGroup {
  std::string name;   ///< table in the TOML file; empty: command line only
  std::string title;  ///< human-readable
  std::vector<ArgumentInfo> arguments;
};

/// The keys of a table in a file other than a command's --config, for the reference page.
ArgumentGroup keys_of(const std::string& name, const std::string& title, const OptionTable& table);

class CommandLine {
 public:
  explicit CommandLine(CLI::App& app);

  /// Required positional arguments.
  void positional(const std::string& label, std::string& value, const std::string& help);
  /// Optional ones.
  void optional_positional(const std::string& label, std::string& value, const std::string& help);
  void positionals(const std::string& label, std::vector<std::string>& values,
                   const std::string& help);
  void optional_positionals(const std::string& label, std::vector<std::string>& values,
                            const std::string& help);

  /// names: "-o,--out". The value is unchanged if the option is not given.
  void option(const std::string& names, const std::string& label, std::string& value,
              const std::string& help);
  void required_option(const std::string& names, const std::string& label, std::string& value,
                       const std::string& help);
  /// May be given several times.
  void repeatable(const std::string& names, const std::string& label,
                  std::vector<std::string>& values, const std::string& help);
  /// Must be given at least once.
  void required_repeatable(const std::string& names, const std::string& label,
                           std::vector<std::string>& values, const std::string& help);
  void flag(const std::string& names, bool& value, const std::string& help);

  /// Fields of an options struct, which must outlive this. After allow_config() they can also be
  /// set in the TOML file.
  void group(const std::string& name, const std::string& title, OptionTable table);

  /// Adds --config FILE.
  void allow_config();

  /// An option that names a file whose content overrides the defaults and is overridden by the
  /// command line: `read` is called with its path before any field is set from the command line.
  void file_option(const std::string& names, const std::string& label, const std::string& help,
                   std::function<Result<>(const std::string&)> read);

  /// Called after parsing: sets the fields from the TOML file, then from the command line.
  Result<> apply();

  /// Long names without dashes of the most used options, by importance. --help lists only these,
  /// --help-all everything.
  void common(std::vector<std::string> names) { common_ = std::move(names); }
  /// Hides the other options from --help, and shortens each text to its first sentence. Returns the
  /// common options, in their order; a command that names none shows all. Throws for a name that
  /// was not declared.
  std::vector<const CLI::Option*> show_common();
  /// Number of options that --help-all lists, excluding --help and --help-all themselves.
  std::size_t option_count() const;

  /// The files that apply() has read.
  std::vector<std::string> files_read() const;

  const std::vector<ArgumentGroup>& groups() const { return groups_; }
  /// Long names, without dashes, of the options that were given.
  std::vector<std::string> given() const;
  /// All long names, without dashes.
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
  std::deque<FileOption> file_options_;  // a deque, for stable addresses of the paths
  std::vector<ArgumentGroup> groups_;
  std::deque<OptionGroup> option_groups_;  // a deque, for stable addresses of the fields
  std::vector<Bound> bound_;
  std::vector<Declared> declared_;
  std::vector<std::string> common_;
};

/// First sentence of a help text, without its full stop.
std::string first_sentence(const std::string& text);

/// Breaks text at spaces into lines of at most `width` characters.
std::string wrapped(const std::string& text, std::size_t width);

}  // namespace turnscan::cli
