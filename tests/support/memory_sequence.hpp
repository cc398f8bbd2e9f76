#pragma once
// A sequence of frames held in memory, for tests.

#include <turnscan/core/frame.hpp>
#include <utility>

namespace turnscan::testing {

class MemorySequence : public FrameSequence {
 public:
  SequenceHeader header_value;
  std::vector<FrameInfo> infos;
  std::vector<Frame> data;

  void add(Frame frame) {
    infos.push_back(frame.info);
    data.push_back(std::move(frame));
  }
  const SequenceHeader& header() const override { return header_value; }
  const std::vector<FrameInfo>& frames() const override { return infos; }
  Result<Frame> read(std::size_t position) const override { return data.at(position); }
};

}  // namespace turnscan::testing
