#pragma once
// Passes of one or more recordings as one sequence, which reconstruct() fuses.

#include <turnscan/reconstruction/pass_placement.hpp>
#include <vector>

namespace turnscan {

/// One pass of a sequence, which must outlive it.
struct SequencePass {
  const FrameSequence* frames = nullptr;  ///< placed on their table
  std::uint32_t pass = 0;                 ///< FrameInfo::pass there
  std::optional<double> speed_rad_s;      ///< stated; see frame_poses()
};

/// The passes of which a sequence has frames that were not dropped, ascending.
std::vector<std::uint32_t> passes_of(const FrameSequence& sequence);

/// Pass after pass: frames are numbered anew if they come from several sequences, passes in any
/// case, from 0 on; each frame has the pose that it has in its own sequence. The header has the
/// sensors of all.
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
