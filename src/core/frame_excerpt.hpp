#pragma once
// Some frames of another sequence.

#include <turnscan/core/frame.hpp>
#include <utility>
#include <vector>

namespace turnscan {

/// Frames at `positions` of a sequence that outlives it, in that order.
class FrameExcerpt : public FrameSequence {
 public:
  FrameExcerpt(const FrameSequence& sequence, std::vector<std::size_t> positions)
      : sequence_(sequence), positions_(std::move(positions)) {
    for (const std::size_t i : positions_) frames_.push_back(sequence.frames().at(i));
  }
  const SequenceHeader& header() const override { return sequence_.header(); }
  const std::vector<FrameInfo>& frames() const override { return frames_; }
  Result<Frame> read(std::size_t position) const override {
    return sequence_.read(positions_.at(position));
  }

 private:
  const FrameSequence& sequence_;
  std::vector<std::size_t> positions_;
  std::vector<FrameInfo> frames_;
};

}  // namespace turnscan
