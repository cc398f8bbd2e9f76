#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <turnscan/core/angles.hpp>
#include <turnscan/turntable/motion/pair_selection.hpp>

namespace turnscan::motion {

namespace {

/// The key frames of each pass in the order of their angles.
class KeyFrameIndex {
 public:
  KeyFrameIndex(const MotionData& data, const std::vector<double>& angle) : data_(data) {
    for (std::size_t order = 0; order < data.keys.size(); ++order) {
      const std::size_t key = data.keys[order];
      passes_[data.frames[key].pass].push_back({angle[key], order});
    }
    for (auto& [pass, keys] : passes_) std::sort(keys.begin(), keys.end());
  }

  /// The key frame of the frame's pass with the angle nearest to target, less than reach from it;
  /// of equally near ones the first in the order of the keys. The frame itself if there is none.
  std::size_t nearest(std::size_t frame, double target, double reach) const {
    const auto pass = passes_.find(data_.frames[frame].pass);
    if (pass == passes_.end()) return frame;
    const auto& keys = pass->second;
    std::size_t best = frame, best_order = data_.keys.size();
    double least = reach;
    const auto visit = [&](const Key& key) {
      const auto& [angle, order] = key;
      const double off = std::abs(angle - target);
      if (off > least) return false;
      const bool nearer = off < least || order < best_order;
      if (off < reach && nearer && data_.keys[order] != frame)
        best = data_.keys[order], best_order = order, least = off;
      return true;
    };
    const auto middle = std::lower_bound(keys.begin(), keys.end(), Key{target, 0});
    for (auto key = middle; key != keys.end() && visit(*key);) ++key;
    for (auto key = middle; key != keys.begin() && visit(*(key - 1));) --key;
    return best;
  }

 private:
  using Key = std::pair<double, std::size_t>;  ///< angle and index in data.keys

  const MotionData& data_;
  std::map<std::uint32_t, std::vector<Key>> passes_;
};

class PairSelection {
 public:
  PairSelection(const MotionData& data, const std::vector<double>& angle)
      : data_(data),
        angle_(angle),
        index_(data, angle),
        is_key_(data.frames.size(), 0),
        reach_(data.keys.size() <= 24 ? 1.0 : 0.1) {
    for (const std::size_t k : data.keys) is_key_[k] = 1;
  }

  std::vector<FramePair> run(bool all_frames) {
    for (std::size_t i = 0; i < data_.frames.size(); ++i) {
      if (!is_key_[i] && !all_frames) continue;
      add_same_turn(i);
      add_other_turns(i);
    }
    add_successors();
    std::vector<FramePair> out;
    for (const auto& [from, to] : chosen_) out.push_back({from, to});
    return out;
  }

 private:
  void add_same_turn(std::size_t i) {
    // Near frames determine the rotation, distant ones the axis and the sum of the steps.
    constexpr std::array<double, 5> kApart{0.0, 0.2, 0.5, 0.95, 1.4};
    for (std::size_t k = 0; k < kApart.size(); ++k) {
      if (!is_key_[i] && k != 0 && k != 2) continue;
      add(i, index_.nearest(i, angle_[i] + kApart[k], reach_));
      if ((!is_key_[i] && k > 0) || data_.keys.size() <= 24)
        add(i, index_.nearest(i, angle_[i] - kApart[k], reach_));
    }
  }

  void add_other_turns(std::size_t i) {
    for (const double turn : {kTurn, -kTurn, 2 * kTurn}) {
      for (const double apart : {0.0, 0.25, 0.5, 0.95, -0.25, -0.5, -0.95}) {
        if (!is_key_[i] && apart != 0.0) continue;
        add(i, index_.nearest(i, angle_[i] + turn + apart, reach_));
      }
    }
  }

  /// Consecutive key frames are always connected.
  void add_successors() {
    for (std::size_t k = 0; k + 1 < data_.keys.size(); ++k) {
      if (data_.frames[data_.keys[k]].pass == data_.frames[data_.keys[k + 1]].pass)
        add(data_.keys[k], data_.keys[k + 1]);
    }
  }

  void add(std::size_t from, std::size_t to) {
    if (from == to) return;
    if (!data_.frames[from].samples.empty() && !data_.frames[to].surface.empty())
      chosen_.emplace(std::uint32_t(from), std::uint32_t(to));
    if (is_key_[from] && !data_.frames[to].samples.empty() && !data_.frames[from].surface.empty())
      chosen_.emplace(std::uint32_t(to), std::uint32_t(from));
  }

  const MotionData& data_;
  const std::vector<double>& angle_;
  KeyFrameIndex index_;
  std::vector<std::uint8_t> is_key_;
  double reach_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> chosen_;
};

}  // namespace

std::vector<FramePair> select_pairs(const MotionData& data, const std::vector<double>& angle,
                                    bool all_frames) {
  return PairSelection(data, angle).run(all_frames);
}

}  // namespace turnscan::motion
