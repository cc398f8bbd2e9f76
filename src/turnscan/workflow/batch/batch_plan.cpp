#include <turnscan/workflow/batch/batch_plan.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <system_error>
#include <turnscan/workflow/batch/batch_folder.hpp>
#include <turnscan/workflow/batch/batch_table.hpp>
#include <turnscan/workflow/batch/find_recordings.hpp>
#include <turnscan/workflow/batch/task_size.hpp>

namespace turnscan {

using namespace batch;

namespace {

namespace fs = std::filesystem;

std::string safe_name(const std::string& text) {
  std::string name;
  for (const char c : text) name += check_task_name(std::string("a") + c) ? c : '_';
  while (!name.empty() && (name.front() == '.' || name.front() == '-')) name.erase(0, 1);
  return name.empty() ? "task" : name;
}

/// Merges options; those of `over` replace those of the same name.
BatchOptions merged(const BatchOptions& under, const BatchOptions& over) {
  BatchOptions all;
  for (const auto& option : under) {
    const bool replaced = std::any_of(
        over.begin(), over.end(), [&](const auto& other) { return other.first == option.first; });
    if (!replaced) all.push_back(option);
  }
  all.insert(all.end(), over.begin(), over.end());
  return all;
}

BatchOptions with_absolute_paths(BatchOptions options, const std::string& folder) {
  for (auto& [name, value] : options) value = with_absolute_path(name, value, folder);
  return options;
}

/// As an absolute path, unless it is not a path.
std::string absolute_input(const std::string& input, const fs::path& folder) {
  if (input.starts_with("builtin:")) return input;
  std::error_code error;
  const fs::path full = fs::weakly_canonical(folder / input, error);
  return error ? (folder / input).string() : full.string();
}

std::string name_from(const std::string& input) {
  if (input.starts_with("builtin:")) return input.substr(input.find(':') + 1);
  const fs::path path(input);
  return path.has_extension() && fs::is_regular_file(path) ? path.stem().string()
                                                           : path.filename().string();
}

/// Suffix of a task's name for one combination of swept values, and the options to set.
struct SweepPoint {
  std::string name;
  BatchOptions options;
};

std::vector<SweepPoint> sweep_points(const std::vector<SweepAxis>& axes) {
  std::vector<SweepPoint> points{{}};
  for (const auto& [name, values] : axes) {
    std::vector<SweepPoint> next;
    for (const SweepPoint& point : points)
      for (const std::string& value : values) {
        SweepPoint more = point;
        more.name += "_" + name + "=" + value;
        more.options.emplace_back(name, value);
        next.push_back(std::move(more));
      }
    points = std::move(next);
  }
  return points;
}

class Planner {
 public:
  explicit Planner(const BatchSource& source) : source_(source) {}

  Result<std::vector<BatchTask>> plan() {
    TURNSCAN_TRY(read_arguments());
    if (source_.inputs.size() == 1 && is_table(source_.inputs.front())) {
      TURNSCAN_TRY(add_table(source_.inputs.front()));
    } else {
      for (const std::string& input : source_.inputs) TURNSCAN_TRY(add_input(input));
    }
    if (tasks_.empty())
      return fail(ErrorCode::kMissingData, "{}: nothing to do; name recordings or a table of them",
                  source_.inputs.empty() ? "INPUT" : source_.inputs.front());
    return std::move(tasks_);
  }

 private:
  Result<> read_arguments() {
    std::error_code error;
    const std::string here = fs::current_path(error).string();
    for (const std::string& text : source_.set) {
      auto setting = parse_setting(text);
      if (!setting) return fail(ErrorCode::kInvalidOption, "--set {}", setting.error().message);
      set_.push_back(std::move(*setting));
    }
    set_ = with_absolute_paths(std::move(set_), here);
    for (const std::string& text : source_.sweep) {
      auto axis = parse_sweep(text);
      if (!axis) return fail(ErrorCode::kInvalidOption, "--sweep {}", axis.error().message);
      for (std::string& value : axis->second) value = with_absolute_path(axis->first, value, here);
      axes_.push_back(std::move(*axis));
    }
    command_ = source_.command.empty() ? "reconstruct" : source_.command;
    return {};
  }

  Result<> add_table(const std::string& path) {
    TURNSCAN_ASSIGN(const BatchTable table, read_batch_table(path));
    if (source_.command.empty() && !table.command.empty()) command_ = table.command;
    std::error_code error;
    const fs::path folder = fs::absolute(path, error).parent_path();
    for (SweepAxis axis : table.sweep) {
      const bool given = std::any_of(axes_.begin(), axes_.end(),
                                     [&](const SweepAxis& a) { return a.first == axis.first; });
      for (std::string& value : axis.second)
        value = with_absolute_path(axis.first, value, folder.string());
      if (!given) axes_.push_back(std::move(axis));
    }
    for (const TableRow& row : table.rows) TURNSCAN_TRY(add_row(row, table.options, folder));
    return {};
  }

  Result<> add_row(const TableRow& row, const BatchOptions& general, const fs::path& folder) {
    if (row.inputs.empty())
      return fail(ErrorCode::kInvalidOption, "{}: there is no recording (or object); name one",
                  row.where);
    std::vector<std::string> inputs;
    for (const std::string& input : row.inputs) inputs.push_back(absolute_input(input, folder));
    const BatchOptions options = with_absolute_paths(merged(general, row.options), folder.string());
    if (row.name.empty()) return add(name_from(inputs.front()), inputs, options);
    if (const auto fine = check_task_name(row.name); !fine)
      return fail(ErrorCode::kInvalidOption, "{}: {}", row.where, fine.error().message);
    if (!given_names_.insert(row.name).second)
      return fail(ErrorCode::kInvalidOption, "{}: two tasks are named '{}'; name one otherwise",
                  row.where, row.name);
    return add(row.name, inputs, options);
  }

  Result<> add_input(const std::string& input) {
    std::error_code error;
    const std::string full = absolute_input(input, fs::current_path(error));
    if (command_ == "simulate") return add(name_from(full), {full}, {});
    TURNSCAN_ASSIGN(const std::vector<FoundRecording> found, find_recordings(full));
    for (const FoundRecording& recording : found)
      TURNSCAN_TRY(add(recording.name, {recording.path}, {}));
    return {};
  }

  /// Adds a task for each point of the sweep.
  Result<> add(const std::string& name, const std::vector<std::string>& inputs,
               const BatchOptions& options) {
    for (const SweepPoint& point : sweep_points(axes_)) {
      BatchTask task;
      task.name = unused(safe_name(name + point.name));
      task.command = command_;
      task.inputs = inputs;
      task.options = merged(merged(options, set_), point.options);
      TURNSCAN_TRY(check_task_name(task.name));
      TURNSCAN_TRY(check_task(task));
      measure_task(task);
      tasks_.push_back(std::move(task));
    }
    return {};
  }

  std::string unused(const std::string& name) {
    std::string tried = name;
    while (!names_.insert(tried).second) tried = fmt::format("{}-{}", name, ++counts_[name] + 1);
    return tried;
  }

  const BatchSource& source_;
  std::string command_;
  BatchOptions set_;
  std::vector<SweepAxis> axes_;
  std::vector<BatchTask> tasks_;
  std::set<std::string> names_, given_names_;
  std::map<std::string, int> counts_;
};

}  // namespace

Result<std::vector<BatchTask>> plan_batch(const BatchSource& source) {
  return Planner(source).plan();
}

}  // namespace turnscan
