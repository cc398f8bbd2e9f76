#include <turnscan/workflow/scan/scan_report.hpp>

#include <nlohmann/json.hpp>
#include <turnscan/core/version.hpp>
#include <turnscan/reconstruction/report.hpp>

#include <turnscan/workflow/next_pass/next_pass_json.hpp>
#include <turnscan/workflow/next_pass/next_pass_text.hpp>
#include <turnscan/workflow/scan/capture_json.hpp>
#include <turnscan/workflow/text/capture_text.hpp>
#include <turnscan/workflow/text/reconstruction_text.hpp>
#include <turnscan/workflow/verdict/residuals_json.hpp>

namespace turnscan {

namespace {

nlohmann::ordered_json ahead_json(const ScanOutcome::Ahead& ahead) {
  auto out = nlohmann::ordered_json::object();
  out["frames"] = ahead.frames;
  out["kept"] = ahead.kept;
  if (ahead.closure_limit_m > 0.0) {
    out["closure_mm"] = ahead.closure_m * 1e3;
    out["closure_limit_mm"] = ahead.closure_limit_m * 1e3;
  }
  return out;
}

}  // namespace

std::string workflow::scan_report(const ScanRequest& request, const ScanOutcome& outcome,
                                  const SourceInfo& source) {
  auto out = nlohmann::ordered_json::object();
  out["software"] = std::string("turnscan ") + version();
  out["recording"] = outcome.recording;
  out["mesh"] = request.mesh;
  out["notes"] = outcome.notes;
  out["seconds_after_the_last_frame"] = outcome.after_s;
  out["processor_seconds_after_the_last_frame"] = outcome.processor_after_s;
  if (outcome.ahead) out["ahead"] = ahead_json(*outcome.ahead);
  out["capture"] = capture_json(outcome.captured.front(), source);
  auto further = nlohmann::ordered_json::array();
  for (std::size_t k = 1; k < outcome.captured.size(); ++k)
    further.push_back(capture_json(outcome.captured[k], source));
  out["further_passes"] = std::move(further);
  auto apart = nlohmann::ordered_json::array();
  for (const PassApart& pass : outcome.run.apart)
    apart.push_back({{"name", pass.name}, {"reason", pass.reason}});
  out["passes_apart"] = std::move(apart);
  out["reconstruction"] = nlohmann::ordered_json::parse(
      report_json(outcome.run.reconstruction, request.reconstruct), nullptr, false);
  put_frame_residuals(outcome.run.frame_residuals, out["reconstruction"]);
  out["next_pass"] = outcome.run.next_pass ? next_pass_json(*outcome.run.next_pass) : nullptr;
  return out.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string scan_text(const ScanOutcome& outcome) {
  std::string text;
  for (const CaptureResult& captured : outcome.captured)
    text += capture_text(captured, outcome.recording);
  text += reconstruction_text(outcome.run.reconstruction);
  for (const PassApart& pass : outcome.run.apart)
    text += fmt::format("\n{} by itself: {}", pass.name, reconstruction_text(pass.reconstruction));
  for (const std::string& note : outcome.notes) text += fmt::format("Note: {}\n", note);
  if (outcome.run.next_pass)
    text += fmt::format("Next pass: {}\n", next_pass_text(*outcome.run.next_pass));
  text += fmt::format(
      "The mesh was ready {:.1f} s after the last frame, with {:.1f} s of processor time\n",
      outcome.after_s, outcome.processor_after_s);
  for (const std::string& file : outcome.files) text += fmt::format("Wrote {}\n", file);
  return text;
}

}  // namespace turnscan
