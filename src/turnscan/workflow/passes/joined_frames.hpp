#pragma once
// Presents passes of one or more recordings as one sequence, which reconstruct() fuses.

#include <turnscan/reconstruction/pass_placement.hpp>
#include <vector>

namespace turnscan {

/// One pass of a sequence, which must outlive it.
struct SequencePass {
  const FrameSequence* frames = nullptr;  ///< posed on their table
  std::uint32_t pass = 0;                 ///< value of FrameInfo::pass in the sequence
  std::optional<double> speed_rad_s;      ///< stated; see frame_poses()
};

/// The passes from which the sequence has frames that were not dropped, ascending.
std::vector<std::uint32_t> passes_of(const FrameSequence& sequence);

/// Concatenates passes: passes are renumbered from 0, and so are frames if they come from several
/// sequences; each frame keeps its pose of the original sequence. The header lists the sensors of
/// all sequences.
class JoinedFrames : public FrameSequence {
 public:
  /// Fails as frame_poses() does.
  static Result<JoinedFrames> create(const std::vector<SequencePass>& passes);

  const SequenceHeader& header() const override { return header_; }
  const std::vector<FrameInfo>& frames() const override { return infos_; }
  Result<Frame> read(std::size_t position) const override;

 private:
  struct Source {
    const FrameSequence* frames;
    std::size_t position;
  };
  Result<> add_sequence(const SequencePass& pass);
  void add_pass(const SequencePass& pass, std::uint32_t number);

  struct Sequence {
    const FrameSequence* frames;
    std::vector<Pose> T_table_sensor;
    std::uint32_t first_sensor;
  };
  std::vector<Sequence> sequences_;
  SequenceHeader header_;
  std::vector<FrameInfo> infos_;
  std::vector<Source> sources_;
};

}  // namespace turnscan
