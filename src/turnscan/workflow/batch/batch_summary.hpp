#pragma once
// Status of a batch, with one row for each task.

#include <cstdint>
#include <filesystem>
#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/workflow/batch/batch_folder.hpp>
#include <vector>

namespace turnscan::batch {

/// Facts from the report of a result.
struct ResultFacts {
  std::string verdict;                 ///< the worst of all objects: green, amber, red; or empty
  std::vector<std::string> sentences;  ///< of the verdict, only those that are not good
  std::uint64_t objects = 0, triangles = 0, frames = 0;
  bool watertight = false;  ///< whether all objects are
};

struct SummaryRow {
  const BatchTask* task = nullptr;
  TaskRecord record;
  ResultFacts facts;      ///< of done tasks
  std::string thumbnail;  ///< relative to the batch's folder; empty: none
};

struct BatchSummary {
  std::vector<SummaryRow> rows;  ///< they refer to the tasks
  std::size_t count(TaskState state) const;
};

/// Reads states and reports; does not check the inputs.
BatchSummary summarize(const BatchFolder& folder, const std::vector<BatchTask>& tasks);

std::string summary_csv(const BatchSummary& summary);
std::string summary_json(const BatchSummary& summary);
std::string summary_page(const BatchSummary& summary, const std::string& title);

/// Writes summary.csv, .json and .html into the batch's folder; returns their names.
Result<std::vector<std::string>> write_summary(const BatchSummary& summary,
                                               const BatchFolder& batch);

}  // namespace turnscan::batch
