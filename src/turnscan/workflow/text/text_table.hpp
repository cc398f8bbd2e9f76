#pragma once

#include <string>
#include <vector>

namespace turnscan::workflow {

/// Lines with aligned columns. Columns are right-aligned except those named at construction.
class TextTable {
 public:
  /// left: columns (from 0) that are left-aligned.
  explicit TextTable(std::vector<std::size_t> left) : left_(std::move(left)) {}

  void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  bool empty() const { return rows_.empty(); }
  /// Each line begins with `indent` spaces and ends with a line break.
  std::string text(std::size_t indent = 0) const;

 private:
  std::vector<std::size_t> left_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace turnscan::workflow
