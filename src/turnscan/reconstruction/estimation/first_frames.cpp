#include <algorithm>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/estimation/first_frames.hpp>

namespace turnscan::estimation {

namespace {

/// Profiles of line scanners that an estimate needs.
constexpr std::size_t kProfilesNeeded = 256;
/// If there are more than these, the older half is discarded.
constexpr std::size_t kMaxKept = 512;

}  // namespace

FirstFrames::FirstFrames(const SequenceHeader& header, const std::vector<RayTable>& rays,
                         const CropOptions& crop, bool colored)
    : header_(header),
      rays_(rays),
      crop_(crop),
      colored_(colored),
      needed_(frames_for_estimate(header, crop)) {}

Result<std::size_t> FirstFrames::keep(std::span<const PosedFrame> posed, const FrameReader& read,
                                      const RunContext& context) {
  const std::size_t count = std::min(needed_ - frames_.size(), posed.size());
  std::vector<Frame> frames(count);
  const auto take = [&](std::size_t i) -> Result<> {
    TURNSCAN_ASSIGN(frames[i], read(posed[i].position));
    if (!colored_) frames[i].color = ColorImage();
    const std::size_t s = frames[i].info.sensor;
    TURNSCAN_TRY(points_of(frames[i], header_.sensors.at(s), rays_.at(s)));
    return {};
  };
  TURNSCAN_TRY(parallel_for(count, 1, context, take));
  for (std::size_t i = 0; i < count; ++i) {
    frames_.push_back(std::move(frames[i]));
    poses_.push_back(posed[i].T_table_sensor);
  }
  return count;
}

Result<bool> FirstFrames::enough() {
  if (frames_.size() < needed_) return false;
  if (needed_ >= kProfilesNeeded) return true;
  TURNSCAN_ASSIGN(const auto sheets, find_sheets(frames_, header_, rays_));
  const bool profiles = !sheets.empty() && std::all_of(sheets.begin(), sheets.end(),
                                                       [](const auto& s) { return s.has_value(); });
  if (profiles) needed_ = kProfilesNeeded;
  return !profiles;
}

void FirstFrames::ask_for_more() {
  if (frames_.size() < kMaxKept) {
    needed_ = 2 * frames_.size();
    return;
  }
  const auto half = std::ptrdiff_t(frames_.size() / 2);
  discarded_ += std::size_t(half);
  frames_.erase(frames_.begin(), frames_.begin() + half);
  poses_.erase(poses_.begin(), poses_.begin() + half);
}

Result<ScanEstimate> FirstFrames::estimate() const {
  return estimate_scan(frames_, poses_, header_, rays_, crop_);
}

std::vector<PosedFrame> FirstFrames::posed_frames() const {
  std::vector<PosedFrame> posed;
  for (std::size_t i = 0; i < frames_.size(); ++i) posed.push_back({i, frames_[i].info, poses_[i]});
  return posed;
}

}  // namespace turnscan::estimation
