#pragma once
// Sequences made from frames in memory or from another sequence.

#include <functional>
#include <memory>
#include <turnscan/core/frame.hpp>
#include <utility>
#include <vector>

namespace turnscan {

/// Frames in memory, shared with whoever else holds them. read() copies one; it fails with
/// kMissingData for a dropped frame.
class MemoryFrames : public FrameSequence {
 public:
  explicit MemoryFrames(SequenceHeader header,
                        std::vector<std::shared_ptr<const Frame>> frames = {});
  MemoryFrames(SequenceHeader header, std::vector<Frame> frames);

  void add(Frame frame);
  const SequenceHeader& header() const override { return header_; }
  const std::vector<FrameInfo>& frames() const override { return infos_; }
  Result<Frame> read(std::size_t position) const override;

 private:
  SequenceHeader header_;
  std::vector<std::shared_ptr<const Frame>> frames_;
  std::vector<FrameInfo> infos_;
};

/// Frames of one or more other sequences, which must outlive the view, with another header, other
/// infos or changes to the frames as they are read.
class SequenceView : public FrameSequence {
 public:
  /// What becomes of a frame as it is read; position counts in the view. Called from as many
  /// threads as read() is.
  using FrameMap = std::function<Result<Frame>(Frame frame, std::size_t position)>;

  /// No frames: they follow by add().
  explicit SequenceView(SequenceHeader header) : header_(std::move(header)) {}
  /// All frames.
  explicit SequenceView(const FrameSequence& sequence);
  /// The frames at `positions` of the sequence, in this order. Throws std::out_of_range where
  /// there is none.
  SequenceView(const FrameSequence& sequence, std::vector<std::size_t> positions);

  /// Appends the frame at a position of a sequence, with this info.
  void add(const FrameSequence& sequence, std::size_t position, FrameInfo info);
  void set_header(SequenceHeader header) { header_ = std::move(header); }
  /// The infos of all frames of the view; frames that are read carry them. Throws
  /// std::invalid_argument unless there is one for each.
  void set_frames(std::vector<FrameInfo> frames);
  void set_map(FrameMap map) { map_ = std::move(map); }

  const SequenceHeader& header() const override { return header_; }
  const std::vector<FrameInfo>& frames() const override { return infos_; }
  /// Where the frames stand in their sequences.
  const std::vector<std::size_t>& positions() const { return positions_; }
  Result<Frame> read(std::size_t position) const override;

 private:
  SequenceHeader header_;
  std::vector<const FrameSequence*> sequences_;  ///< one per frame, as are the others
  std::vector<std::size_t> positions_;
  std::vector<FrameInfo> infos_;
  FrameMap map_;
};

/// A view of the first frames, or of all if there are fewer.
SequenceView first_frames(const FrameSequence& sequence, std::size_t count);

}  // namespace turnscan
