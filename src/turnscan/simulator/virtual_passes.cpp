#include <algorithm>
#include <stdexcept>
#include <turnscan/simulator/virtual_passes.hpp>

namespace turnscan {

namespace {

constexpr double kPause_s = 1.0;

}  // namespace

VirtualPasses::VirtualPasses(std::vector<VirtualScan> scans) : scans_(std::move(scans)) {
  if (scans_.empty()) throw std::invalid_argument("VirtualPasses: there is no scan");
  double start_s = 0.0;
  for (const VirtualScan& scan : scans_) {
    first_.push_back(frames_.size());
    for (FrameInfo frame : scan.frames()) {
      frame.index = static_cast<std::uint32_t>(frames_.size());
      frame.time_s += start_s;
      frames_.push_back(frame);
    }
    if (!frames_.empty()) start_s = frames_.back().time_s + kPause_s;
  }
}

const SequenceHeader& VirtualPasses::header() const { return scans_.front().header(); }
const std::vector<FrameInfo>& VirtualPasses::frames() const { return frames_; }

std::pair<std::size_t, std::size_t> VirtualPasses::place_of(std::size_t position) const {
  const auto after = std::upper_bound(first_.begin(), first_.end(), position);
  const auto scan = static_cast<std::size_t>(after - first_.begin()) - 1;
  return {scan, position - first_[scan]};
}

Result<Frame> VirtualPasses::read(std::size_t position) const {
  if (position >= frames_.size())
    return fail(ErrorCode::kNotFound, "virtual scan: there is no frame {}, only {}", position,
                frames_.size());
  const auto [scan, there] = place_of(position);
  TURNSCAN_ASSIGN(Frame frame, scans_[scan].read(there));
  frame.info = frames_[position];
  return frame;
}

std::array<std::uint64_t, 10> VirtualPasses::tally(std::size_t scanner) const {
  std::array<std::uint64_t, 10> sum{};
  for (const VirtualScan& scan : scans_) {
    const auto counts = scan.tally(scanner);
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += counts[k];
  }
  return sum;
}

}  // namespace turnscan
