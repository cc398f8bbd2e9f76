#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/command.hpp"

namespace turnscan::cli {

/// The program: its subcommands, and the exit codes for their results: 0 done, 1 failed, 2 wrong
/// usage, 130 cancelled. An error is one line on standard error.
class Program {
 public:
  Program();
  ~Program();

  /// help: one sentence; page: of the manual, with more. add_reference() adds the command that
  /// prints the reference page.
  void add(const std::string& name, const std::string& help, const std::string& page,
           std::unique_ptr<Command> command);
  void add_reference();

  int run(int argc, char** argv);

 private:
  struct Entry;

  int run_command(Entry& entry);
  /// Names of the commands that have an option with this long name.
  std::vector<std::string> commands_with(const std::string& option) const;
  /// The error of the first argument that the command does not know, if there is one.
  std::optional<std::string> unknown_argument_of(const Entry& entry) const;
  /// The command that was given; nullptr if there is none.
  Entry* chosen();
  /// Help of the program, or the common options of the chosen command.
  std::string help();
  int unknown_command(const std::string& name);
  /// markdown, man, bash, zsh or fish. Fails with kInvalidOption for another format.
  Result<std::string> reference(const std::string& format) const;

  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Runs body() and returns its exit code. Exceptions, such as lack of memory or threads, become an
/// error in one line like any other.
int run_guarded(int (*body)(int, char**), int argc, char** argv);

}  // namespace turnscan::cli
