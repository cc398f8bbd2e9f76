#include <turnscan/workflow/batch/batch_table.hpp>

#include <toml++/toml.h>

#include <algorithm>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/file/file_name.hpp>
#include <turnscan/io/text/text_fields.hpp>
#include <turnscan/io/text/toml_options.hpp>

namespace turnscan::batch {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    const std::string part(text::trimmed(std::string_view(text).substr(begin, end - begin)));
    if (!part.empty()) parts.push_back(part);
    begin = end + 1;
  }
  return parts;
}

bool is_input(const std::string& key) { return key == "recording" || key == "object"; }

void set_column(TableRow& row, const std::string& column, const std::string& value) {
  if (value.empty()) return;
  if (column == "name") {
    row.name = value;
  } else if (is_input(column)) {
    row.inputs = parts_of(value, ';');
  } else {
    row.options.emplace_back(column, value);
  }
}

Result<BatchTable> parse_csv(const std::string& text, const std::string& file) {
  const auto wrong = [&](std::size_t line, const std::string& why) {
    return fail_at(file, ErrorCode::kFormat, "{}:{}: {}", file, line, why);
  };
  BatchTable table;
  text::LineReader lines(text);
  std::vector<std::string> columns;
  while (const auto line = lines.next_content()) {
    auto fields = text::csv_fields(line->text);
    if (!fields) return wrong(line->number, fields.error().message);
    if (columns.empty()) {
      columns = std::move(*fields);
      for (const std::string& column : columns)
        if (std::count(columns.begin(), columns.end(), column) > 1)
          return wrong(line->number, fmt::format("two columns are named '{}'", column));
      if (std::none_of(columns.begin(), columns.end(), is_input))
        return wrong(line->number, "there is no column 'recording' (or 'object'); add one");
      continue;
    }
    if (fields->size() != columns.size())
      return wrong(line->number, fmt::format("{} fields under {} columns; commas in a field need "
                                             "quotes around it",
                                             fields->size(), columns.size()));
    TableRow row;
    row.where = fmt::format("{}:{}", file, line->number);
    for (std::size_t i = 0; i < columns.size(); ++i) set_column(row, columns[i], (*fields)[i]);
    table.rows.push_back(std::move(row));
  }
  return table;
}

class TomlTable {
 public:
  explicit TomlTable(const fs::path& path) : path_(path) {}

  Result<BatchTable> read(const toml::table& top) {
    for (const auto& [toml_key, node] : top) {
      const std::string key(toml_key.str());
      if (key == "command" && node.is_string()) {
        table_.command = node.as_string()->get();
      } else if (key == "options" && node.is_table()) {
        TURNSCAN_TRY(read_options(*node.as_table(), table_.options));
      } else if (key == "sweep" && node.is_table()) {
        TURNSCAN_TRY(read_sweep(*node.as_table()));
      } else if (key == "task" && node.is_array_of_tables()) {
        for (const toml::node& task : *node.as_array()) TURNSCAN_TRY(read_task(*task.as_table()));
      } else {
        return scene::fail_in_toml(path_, node,
                                   fmt::format("'{}' is not what a table of tasks holds; use "
                                               "command, [options], [sweep] and [[task]]",
                                               key));
      }
    }
    return std::move(table_);
  }

 private:
  Result<std::string> text_of(const toml::node& node) const {
    if (const auto* text = node.as_string()) return text->get();
    if (const auto* number = node.as_integer()) return fmt::format("{}", number->get());
    if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
    if (const auto* flag = node.as_boolean()) return std::string(flag->get() ? "true" : "false");
    return scene::fail_in_toml(path_, node, "a value is a text, a number, true or false");
  }

  Result<std::vector<std::string>> texts_of(const toml::node& node) const {
    std::vector<std::string> texts;
    if (const toml::array* list = node.as_array()) {
      for (const toml::node& entry : *list) {
        TURNSCAN_ASSIGN(std::string text, text_of(entry));
        texts.push_back(std::move(text));
      }
      return texts;
    }
    TURNSCAN_ASSIGN(std::string text, text_of(node));
    texts.push_back(std::move(text));
    return texts;
  }

  Result<> read_options(const toml::table& from, BatchOptions& options) const {
    for (const auto& [key, node] : from) {
      TURNSCAN_ASSIGN(const std::vector<std::string> values, texts_of(node));
      for (const std::string& value : values) options.emplace_back(std::string(key.str()), value);
    }
    return {};
  }

  Result<> read_sweep(const toml::table& from) {
    for (const auto& [key, node] : from) {
      TURNSCAN_ASSIGN(std::vector<std::string> values, texts_of(node));
      if (values.empty()) return scene::fail_in_toml(path_, node, "a sweep over no value");
      table_.sweep.emplace_back(std::string(key.str()), std::move(values));
    }
    return {};
  }

  Result<> read_task(const toml::table& from) {
    TableRow row;
    row.where = fmt::format("{}:{}", path_.string(), from.source().begin.line);
    for (const auto& [toml_key, node] : from) {
      const std::string key(toml_key.str());
      TURNSCAN_ASSIGN(const std::vector<std::string> values, texts_of(node));
      if (is_input(key)) {
        row.inputs = values;
      } else if (key == "name" && values.size() == 1) {
        row.name = values.front();
      } else {
        for (const std::string& value : values) row.options.emplace_back(key, value);
      }
    }
    table_.rows.push_back(std::move(row));
    return {};
  }

  const fs::path& path_;
  BatchTable table_;
};

}  // namespace

bool is_table(const fs::path& path) {
  const std::string ending = file::lower_extension(path);
  std::error_code error;
  return (ending == "csv" || ending == "toml") && !fs::is_directory(path, error);
}

Result<BatchTable> read_batch_table(const fs::path& path) {
  if (file::lower_extension(path) == "toml") {
    TURNSCAN_ASSIGN(const toml::table top, scene::read_toml(path));
    return TomlTable(path).read(top);
  }
  TURNSCAN_ASSIGN(const std::string text, read_file(path, std::uint64_t(256) << 20));
  return parse_csv(text, path.string());
}

Result<std::pair<std::string, std::string>> parse_setting(const std::string& text) {
  const auto equals = text.find('=');
  std::string name = text.substr(0, equals);
  if (name.starts_with("--")) name.erase(0, 2);
  if (equals == std::string::npos || name.empty())
    return fail(ErrorCode::kInvalidOption, "'{}' is not NAME=VALUE", text);
  return std::pair(name, text.substr(equals + 1));
}

Result<SweepAxis> parse_sweep(const std::string& text) {
  TURNSCAN_ASSIGN(auto setting, parse_setting(text));
  const char separator = setting.second.find(';') == std::string::npos ? ',' : ';';
  SweepAxis axis{std::move(setting.first), parts_of(setting.second, separator)};
  if (axis.second.empty())
    return fail(ErrorCode::kInvalidOption, "'{}' is not NAME=VALUE,VALUE,...", text);
  return axis;
}

}  // namespace turnscan::batch
