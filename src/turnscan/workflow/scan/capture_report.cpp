#include <turnscan/workflow/scan/capture_report.hpp>

#include <nlohmann/json.hpp>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/version.hpp>

#include <turnscan/workflow/scan/capture_json.hpp>

namespace turnscan {

nlohmann::ordered_json workflow::capture_json(const CaptureResult& result,
                                              const SourceInfo& source) {
  const RecorderStatistics& r = result.recorder;
  auto out = nlohmann::ordered_json::object();
  out["device"] = source.uri;
  out["live"] = source.live;
  out["ended"] = result.ended;
  if (result.error) out["error"] = result.error->text();
  out["frames"] = r.written;
  out["seconds"] = result.seconds;
  if (result.turned_rad) out["turns"] = *result.turned_rad / kTurn;
  if (!result.turns_found.empty()) out["turns_counted_by"] = result.turns_found;
  if (result.speed_rad_s) out["speed_rad_s"] = *result.speed_rad_s;
  out["dropped"] = {{"sensor", result.source.dropped_by_sensor},
                    {"queue", result.source.dropped_by_queue},
                    {"refused", result.source.refused},
                    {"disk", r.dropped_by_disk}};
  out["longest_gap_s"] = result.longest_gap_s;
  out["recorder"] = {{"bytes", r.bytes},
                     {"most_waiting_frames", r.most_waiting},
                     {"most_wait_s", r.most_wait_s},
                     {"encode_cpu_s", r.encode_cpu_s},
                     {"free_bytes", r.free_bytes}};
  out["source_most_waiting_frames"] = result.source.most_waiting;
  out["cpu_s"] = result.cpu_s;
  return out;
}

std::string capture_report(const CaptureResult& result, const SourceInfo& source,
                           const std::string& folder) {
  auto out = nlohmann::ordered_json::object();
  out["software"] = std::string("turnscan ") + version();
  out["recording"] = folder;
  out.update(workflow::capture_json(result, source));
  return out.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace turnscan
