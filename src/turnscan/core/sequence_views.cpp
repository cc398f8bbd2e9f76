#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <turnscan/core/sequence_views.hpp>
#include <utility>

namespace turnscan {

namespace {

std::vector<std::size_t> first_positions(const FrameSequence& sequence, std::size_t count) {
  std::vector<std::size_t> positions(std::min(count, sequence.frames().size()));
  std::iota(positions.begin(), positions.end(), std::size_t{0});
  return positions;
}

}  // namespace

MemoryFrames::MemoryFrames(SequenceHeader header, std::vector<std::shared_ptr<const Frame>> frames)
    : header_(std::move(header)), frames_(std::move(frames)) {
  for (const auto& frame : frames_) infos_.push_back(frame->info);
}

MemoryFrames::MemoryFrames(SequenceHeader header, std::vector<Frame> frames)
    : header_(std::move(header)) {
  for (Frame& frame : frames) add(std::move(frame));
}

void MemoryFrames::add(Frame frame) {
  infos_.push_back(frame.info);
  frames_.push_back(std::make_shared<const Frame>(std::move(frame)));
}

Result<Frame> MemoryFrames::read(std::size_t position) const {
  const FrameInfo& info = infos_.at(position);
  if (info.status == FrameStatus::kDropped)
    return fail(ErrorCode::kMissingData, "frame {} was lost", info.index);
  return *frames_[position];
}

SequenceView::SequenceView(const FrameSequence& sequence)
    : SequenceView(sequence, first_positions(sequence, sequence.frames().size())) {}

SequenceView::SequenceView(const FrameSequence& sequence, std::vector<std::size_t> positions)
    : header_(sequence.header()),
      sequences_(positions.size(), &sequence),
      positions_(std::move(positions)) {
  for (const std::size_t i : positions_) infos_.push_back(sequence.frames().at(i));
}

void SequenceView::add(const FrameSequence& sequence, std::size_t position, FrameInfo info) {
  sequences_.push_back(&sequence);
  positions_.push_back(position);
  infos_.push_back(std::move(info));
}

void SequenceView::set_frames(std::vector<FrameInfo> frames) {
  if (frames.size() != positions_.size())
    throw std::invalid_argument(
        fmt::format("sequence view: {} infos for {} frames", frames.size(), positions_.size()));
  infos_ = std::move(frames);
}

Result<Frame> SequenceView::read(std::size_t position) const {
  TURNSCAN_ASSIGN(Frame frame, sequences_.at(position)->read(positions_[position]));
  frame.info = infos_[position];
  if (map_) return map_(std::move(frame), position);
  return frame;
}

SequenceView first_frames(const FrameSequence& sequence, std::size_t count) {
  return {sequence, first_positions(sequence, count)};
}

}  // namespace turnscan
