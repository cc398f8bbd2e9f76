#include <turnscan/workflow/scan/capture_outcome.hpp>

namespace turnscan {

Result<> capture_outcome(const CaptureResult& result, const std::string& folder) {
  if (!result.error) {
    if (result.recorded) return {};
    return fail(ErrorCode::kMissingData,
                "the source ended before its first frame; nothing was recorded");
  }
  Error error = *result.error;
  std::string what = error.code == ErrorCode::kCancelled ? "stopped" : error.text();
  error.path.clear();
  const char* joint = what.find("; ") == std::string::npos ? "; " : " - ";
  std::string left = "nothing was recorded";
  if (result.recorded)
    left = fmt::format("{} holds the {} frames until then and {}", folder, result.recorder.written,
                       result.complete ? "is complete (--resume goes on with it)"
                                       : "can be finished with 'turnscan info --repair'");
  error.message = what + joint + left;
  return tl::unexpected<Error>(std::move(error));
}

}  // namespace turnscan
