#include <unistd.h>

#include <cstdlib>
#include <sstream>
#include <turnscan/api/batch.hpp>
#include <turnscan/api/named_options.hpp>
#include <turnscan/workflow/batch/batch_plan.hpp>
#include <turnscan/workflow/batch/batch_run.hpp>

namespace turnscan {

namespace {

namespace fs = std::filesystem;

/// As a shell finds it.
Result<fs::path> find_program(const fs::path& program) {
  if (program.has_parent_path()) return fs::absolute(program);
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path candidate = fs::path(folder) / program;
    std::error_code error;
    if (fs::is_regular_file(candidate, error) && ::access(candidate.c_str(), X_OK) == 0)
      return fs::absolute(candidate);
  }
  return fail(ErrorCode::kNotFound, "there is no program {} on the PATH; name its file",
              program.string());
}

BatchSource source_of(const Batch& batch) {
  BatchSource source{batch.inputs, batch.command, {}, {}};
  for (const auto& [name, value] : batch.options)
    source.set.push_back(fmt::format("{}={}", name, value));
  for (const auto& [name, values] : batch.sweep)
    source.sweep.push_back(fmt::format("{}={}", name, fmt::join(values, ",")));
  return source;
}

}  // namespace

Result<BatchResult> run_batch(const Batch& batch, const fs::path& folder,
                              const RunContext& context) {
  BatchRequest request;
  TURNSCAN_TRY(api::set_fields(describe(request.options), batch.engine));
  TURNSCAN_ASSIGN(request.program, find_program(batch.program));
  request.folder = folder.string();
  request.on_status = [&batch, last = std::string()](const std::string& text) mutable {
    if (batch.on_status && text != last) batch.on_status(text);
    last = text;
  };
  TURNSCAN_ASSIGN(const std::vector<BatchTask> tasks, plan_batch(source_of(batch)));
  TURNSCAN_TRY(save_batch(request.folder, tasks));
  TURNSCAN_ASSIGN(BatchOutcome outcome, run_batch(request, context));
  return BatchResult{outcome.tasks, outcome.done, outcome.failed, std::move(outcome.files)};
}

std::vector<OptionDescription> batch_engine_options() {
  BatchRunOptions options;
  return api::describe_fields(describe(options));
}

}  // namespace turnscan
