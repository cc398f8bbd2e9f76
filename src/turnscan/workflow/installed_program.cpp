#include <turnscan/core/process/child_process.hpp>
#include <turnscan/io/text/text_fields.hpp>
#include <turnscan/workflow/installed_program.hpp>

namespace turnscan {

Result<std::string> run_installed(const std::string& program,
                                  const std::vector<std::string>& arguments,
                                  std::string_view missing, double seconds,
                                  const RunContext& context, std::string_view input) {
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  TURNSCAN_ASSIGN(process::ChildResult child,
                  process::run_child("/usr/bin/env", words, seconds, context, input));
  if (child.exit_code == 0) return std::move(child.output);
  if (child.exit_code == 127) return fail(ErrorCode::kMissingData, "{}", missing);
  const std::string why(text::trimmed(child.errors));
  return fail(ErrorCode::kLibrary, "{}: {}", program, why.empty() ? "it failed" : why);
}

}  // namespace turnscan
