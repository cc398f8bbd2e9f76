#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/command.hpp"

namespace turnscan::cli {

/// The program: its subcommands, and what their results mean to the caller. Exit codes: 0 done,
/// 1 failed, 2 wrong usage, 130 cancelled. An error is one line on standard error.
class Program {
 public:
  Program();
  ~Program();

  /// help: one sentence. The reference page is printed by the command that add_reference() adds.
  void add(const std::string& name, const std::string& help, std::unique_ptr<Command> command);
  void add_reference();

  int run(int argc, char** argv);

 private:
  struct Entry;

  int run_command(Entry& entry);
  /// Names of those that have an option of that long name.
  std::vector<std::string> commands_with(const std::string& option) const;
  /// Of the program, or the common options of the chosen command.
  std::string help();
  int unknown_command(const std::string& name);
  /// markdown, man, bash, zsh or fish. Fails with kInvalidOption for another format.
  Result<std::string> reference(const std::string& format) const;

  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// The exit code of body(), which may throw: too little memory or too few threads become an error
/// in one line like any other.
int run_guarded(int (*body)(int, char**), int argc, char** argv);

}  // namespace turnscan::cli
