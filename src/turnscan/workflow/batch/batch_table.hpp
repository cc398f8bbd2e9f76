#pragma once
// Task tables written by users.

#include <filesystem>
#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/workflow/batch/batch_task.hpp>
#include <utility>
#include <vector>

namespace turnscan::batch {

/// Name of an option and the values to sweep.
using SweepAxis = std::pair<std::string, std::vector<std::string>>;

struct TableRow {
  std::string where;                ///< for errors: "shelf.csv:7"
  std::string name;                 ///< empty: none given
  std::vector<std::string> inputs;  ///< as written
  BatchOptions options;
};

struct BatchTable {
  std::string command;   ///< empty: none given
  BatchOptions options;  ///< of all rows
  std::vector<SweepAxis> sweep;
  std::vector<TableRow> rows;
};

/// Whether the file name has the extension of a table: .csv or .toml.
bool is_table(const std::filesystem::path& path);

/// CSV: a line of column names, then one line per task. Every column is an option except "name" and
/// "recording" (or "object"; several recordings of an object are separated by semicolons); an empty
/// field leaves its option unset.
/// TOML: command, [options], [sweep] with lists, [[task]] with the same keys.
/// Fails with kNotFound, kIo, and with kFormat, naming file and line.
Result<BatchTable> read_batch_table(const std::filesystem::path& path);

/// Parses "NAME=VALUE". Fails with kInvalidOption.
Result<std::pair<std::string, std::string>> parse_setting(const std::string& text);
/// Parses "NAME=V1,V2,..."; if the text contains a semicolon, semicolons separate the values. Fails
/// as parse_setting().
Result<SweepAxis> parse_sweep(const std::string& text);

}  // namespace turnscan::batch
