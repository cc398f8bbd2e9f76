#pragma once
// Frames in memory, seen as a sequence. Not installed.

#include <memory>
#include <turnscan/core/frame.hpp>
#include <vector>

namespace turnscan {

class MemoryFrames : public FrameSequence {
 public:
  MemoryFrames(SequenceHeader header, std::vector<std::shared_ptr<const Frame>> frames)
      : header_(std::move(header)), kept_(std::move(frames)) {
    for (const auto& frame : kept_) infos_.push_back(frame->info);
  }
  const SequenceHeader& header() const override { return header_; }
  const std::vector<FrameInfo>& frames() const override { return infos_; }
  Result<Frame> read(std::size_t position) const override { return *kept_.at(position); }

 private:
  SequenceHeader header_;
  std::vector<std::shared_ptr<const Frame>> kept_;
  std::vector<FrameInfo> infos_;
};

}  // namespace turnscan
