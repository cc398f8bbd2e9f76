#include <algorithm>
#include <optional>
#include <turnscan/core/frame_samples.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/recording/plausibility/finders.hpp>

namespace turnscan {

namespace {

constexpr std::size_t kSuccessive = 2, kSpread = 6;
/// Of larger images, which are held at once, fewer are spread over the rest.
constexpr std::size_t kLargePixels = std::size_t(1) << 22, kSpreadOfLarge = 2;

/// The first frames in succession and others spread over the rest.
Result<std::vector<Frame>> frames_to_look_at(const FrameSequence& sequence, std::uint32_t sensor,
                                             const RunContext& context) {
  const std::vector<std::size_t> all = usable_frames(sequence, {.sensor = sensor});
  const CameraIntrinsics& camera = sequence.header().sensors[sensor].intrinsics;
  const bool large = std::size_t(camera.width) * std::size_t(camera.height) > kLargePixels;
  const auto second = all.begin() + std::ptrdiff_t(std::min(kSuccessive, all.size()));
  std::vector<std::size_t> chosen(all.begin(), second);
  for (const std::size_t i : evenly_spread_to_last(std::vector<std::size_t>(second, all.end()),
                                                   large ? kSpreadOfLarge : kSpread))
    chosen.push_back(i);
  std::vector<std::optional<Frame>> read(chosen.size());
  TURNSCAN_TRY(
      read_frames(sequence, chosen, context, [&](std::size_t k, Result<Frame> frame) -> Result<> {
        if (!frame) return {};
        frame->color = ColorImage();
        frame->color_jpeg.clear();
        read[k] = std::move(*frame);
        return {};
      }));
  std::vector<Frame> out;
  for (std::optional<Frame>& frame : read)
    if (frame) out.push_back(std::move(*frame));
  return out;
}

}  // namespace

std::string_view name_of(Plausibility level) {
  return level == Plausibility::kDoubtful ? "doubtful" : "implausible";
}

Result<std::vector<PlausibilityFinding>> find_implausible(const FrameSequence& sequence,
                                                          const RunContext& context) {
  plausibility::Findings out;
  plausibility::look_at_order(sequence, out);
  const auto& sensors = sequence.header().sensors;
  for (std::uint32_t i = 0; i < sensors.size(); ++i) {
    plausibility::look_at_intrinsics(i, sensors[i], out);
    TURNSCAN_ASSIGN(const auto frames, frames_to_look_at(sequence, i, context));
    plausibility::look_at_viewpoint(i, sensors[i], frames, out);
    if (plausibility::look_at_bytes(i, frames, out)) continue;
    const std::size_t before = out.size();
    plausibility::look_at_range(i, sensors[i], frames, out);
    if (const auto& table = sequence.header().turntable; table && i == 0 && out.size() == before)
      plausibility::look_at_table(sensors[i], *table, frames, out);
    const bool posed = std::any_of(frames.begin(), frames.end(), [](const Frame& f) {
      return f.info.T_table_sensor.has_value();
    });
    const std::size_t unposed = out.size();
    if (posed) plausibility::look_at_poses(i, sensors[i], frames, out);
    if (posed && out.size() == unposed)
      plausibility::look_at_handedness(i, sensors[i], frames, out);
    if (!posed) plausibility::look_at_motion(i, frames, out);
    TURNSCAN_TRY(plausibility::look_at_succession(sequence, i, frames, context, out));
  }
  return out;
}

}  // namespace turnscan
