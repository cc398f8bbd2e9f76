#include <turnscan/workflow/text/capture_text.hpp>

#include <algorithm>
#include <turnscan/core/angles.hpp>

namespace turnscan {

namespace {

std::uint64_t frames_lost(const CaptureResult& result) {
  return result.source.dropped() + result.recorder.dropped_by_disk;
}

}  // namespace

std::string progress_text(const CaptureProgress& p) {
  std::string text = fmt::format("{} frames, {:.1f} s", p.frames, p.seconds);
  if (p.turned_rad) text += fmt::format(", {:.2f} turns", *p.turned_rad / kTurn);
  return text + fmt::format(", {} dropped, {:.1f} GB free", p.dropped, double(p.free_bytes) * 1e-9);
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
      frames_lost(result), result.source.dropped_by_sensor, result.source.dropped_by_queue,
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

}  // namespace turnscan
