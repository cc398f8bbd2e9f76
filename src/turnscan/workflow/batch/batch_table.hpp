#pragma once
// Tables of tasks as people write them.

#include <filesystem>
#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/workflow/batch/batch_task.hpp>
#include <utility>
#include <vector>

namespace turnscan::batch {

/// A name of an option and the values that it takes one after the other.
using SweepAxis = std::pair<std::string, std::vector<std::string>>;

struct TableRow {
  std::string where;                ///< for errors: "shelf.csv:7"
  std::string name;                 ///< empty: none given
  std::vector<std::string> inputs;  ///< as they were written
  BatchOptions options;
};

struct BatchTable {
  std::string command;   ///< empty: none given
  BatchOptions options;  ///< of all rows
  std::vector<SweepAxis> sweep;
  std::vector<TableRow> rows;
};

/// Whether the name of a file says that it is a table: .csv or .toml.
bool is_table(const std::filesystem::path& path);

/// CSV: a line of column names, then a line a task. "name" and "recording" (or "object"; several
/// recordings of an object stand between semicolons) are no options, every other column is one; an
/// empty field leaves its option out.
/// TOML: command, [options], [sweep] with lists, [[task]] with the same keys.
/// Fails with kNotFound, kIo, and with kFormat, naming file and line.
Result<BatchTable> read_batch_table(const std::filesystem::path& path);

/// "NAME=VALUE". Fails with kInvalidOption.
Result<std::pair<std::string, std::string>> parse_setting(const std::string& text);
/// "NAME=V1,V2,..."; with a semicolon in it, values stand between semicolons. Fails as
/// parse_setting().
Result<SweepAxis> parse_sweep(const std::string& text);

}  // namespace turnscan::batch
