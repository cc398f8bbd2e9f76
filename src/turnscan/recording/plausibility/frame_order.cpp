#include <cmath>
#include <map>
#include <turnscan/core/angles.hpp>
#include <turnscan/recording/plausibility/finders.hpp>

namespace turnscan::plausibility {

namespace {

/// A table may be turned back once or twice on purpose; angles of other frames go back and forth.
constexpr double kMaxBackShare = 0.1;

using Stretch = std::vector<const FrameInfo*>;

/// Frames of one pass and sensor, in order.
std::map<std::pair<std::uint32_t, std::uint32_t>, Stretch> stretches_of(
    const FrameSequence& sequence) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, Stretch> out;
  for (const FrameInfo& frame : sequence.frames())
    if (frame.status != FrameStatus::kDropped) out[{frame.pass, frame.sensor}].push_back(&frame);
  return out;
}

void look_at_times(const Stretch& frames, Findings& out) {
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const double before = frames[i - 1]->time_s, time = frames[i]->time_s;
    if (!(time < before)) continue;
    out.push_back({Plausibility::kImplausible,
                   fmt::format("times go back at frame {}, from {:.3f} s to {:.3f} s: the frames "
                               "are not in the order in which they were taken, or their times are "
                               "of several clocks",
                               frames[i]->index, before, time),
                   ""});
    return;
  }
}

void look_at_angles(const Stretch& frames, Findings& out) {
  std::size_t forth = 0, back = 0;
  const FrameInfo *first_forth = nullptr, *first_back = nullptr;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const auto &a = frames[i - 1]->angle_rad, &b = frames[i]->angle_rad;
    if (!a || !b) continue;
    const double step = std::remainder(*b - *a, kTurn);
    const bool positive = step > 0.0;
    if (step == 0.0) continue;
    ++(positive ? forth : back);
    const FrameInfo*& first = positive ? first_forth : first_back;
    if (first == nullptr) first = frames[i];
  }
  const std::size_t fewer = std::min(forth, back);
  if (fewer == 0) return;
  const FrameInfo* turned = forth < back ? first_forth : first_back;
  const bool often = double(fewer) > kMaxBackShare * double(forth + back);
  out.push_back({often ? Plausibility::kImplausible : Plausibility::kDoubtful,
                 fmt::format("angles go back {} times among {} frames, first at frame {}: {}",
                             fewer, frames.size(), turned->index,
                             often ? "they may be those of other frames"
                                   : "the table was turned back there, or the angle is wrong"),
                 ""});
}

}  // namespace

void look_at_order(const FrameSequence& sequence, Findings& out) {
  for (const auto& [of, frames] : stretches_of(sequence)) {
    look_at_times(frames, out);
    look_at_angles(frames, out);
  }
}

}  // namespace turnscan::plausibility
