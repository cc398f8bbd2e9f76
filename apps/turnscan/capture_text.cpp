#include "capture_text.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

namespace turnscan::cli {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr std::uint64_t kSteps = 1000;

std::uint64_t lost(const CaptureResult& result) {
  return result.source.dropped() + result.recorder.dropped_by_disk;
}

}  // namespace

std::string progress_text(const CaptureProgress& p) {
  std::string text = fmt::format("{} frames, {:.1f} s", p.frames, p.seconds);
  if (p.turned_rad) text += fmt::format(", {:.2f} turns", *p.turned_rad / kTurn);
  return text + fmt::format(", {} dropped, {:.1f} GB free", p.dropped, double(p.free_bytes) * 1e-9);
}

std::function<void(const CaptureProgress&)> progress_in(Session& session) {
  return [&session, done = std::uint64_t(0)](const CaptureProgress& progress) mutable {
    session.status().set(progress_text(progress));
    const auto steps = static_cast<std::uint64_t>(progress.fraction * double(kSteps));
    if (steps > done) session.context().advance(steps - done);
    done = std::max(done, steps);
  };
}

std::string capture_text(const CaptureResult& result, const std::string& folder) {
  const RecorderStatistics& r = result.recorder;
  std::string text =
      fmt::format("Recorded {} frames in {:.2f} s of the sensor's time", r.written, result.seconds);
  if (result.turned_rad)
    text += fmt::format(", {:.3f} turns by {}", *result.turned_rad / kTurn, result.turns_found);
  text += fmt::format(
      "\n{} frames dropped: {} by the sensor, {} in the queue, {} refused, {} because "
      "the disk was too slow\n",
      lost(result), result.source.dropped_by_sensor, result.source.dropped_by_queue,
      result.source.refused, r.dropped_by_disk);
  const double frames = std::max(1.0, double(r.written));
  text += fmt::format(
      "At most {} frames waited, {:.2f} s; {:.2f} ms of processor time a frame, of it "
      "{:.2f} ms to encode; {:.1f} MB\n",
      r.most_waiting, r.most_wait_s, 1e3 * result.cpu_s / frames, 1e3 * r.encode_cpu_s / frames,
      double(r.bytes) * 1e-6);
  if (result.longest_gap_s > 1.0)
    text += fmt::format("Note: once no frame came for {:.1f} s\n", result.longest_gap_s);
  return text + fmt::format("Wrote {}\n", folder);
}

nlohmann::ordered_json capture_json(const CaptureResult& result, const SourceInfo& source) {
  const RecorderStatistics& r = result.recorder;
  nlohmann::ordered_json out;
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

}  // namespace turnscan::cli
