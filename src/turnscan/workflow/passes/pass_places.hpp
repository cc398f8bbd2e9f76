#pragma once
// Which passes there are, and where each lies: as somebody states it, or as its surface shows.

#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/options.hpp>
#include <turnscan/workflow/passes/joined_frames.hpp>
#include <turnscan/workflow/passes/pass_pose.hpp>

namespace turnscan {

/// A recording among several, calibrated; frames must outlive what is made of it.
struct RecordingFrames {
  std::string name;  ///< for people
  const FrameSequence* frames = nullptr;
  std::optional<double> speed_rad_s;  ///< stated
};

/// One pass of one of them.
struct PassOfMany {
  SequencePass frames;
  std::uint32_t number = 0;  ///< by which people call it
  std::string name;          ///< "pass 1", with the recording's name where there are several
  std::optional<Pose> T_first_pass;  ///< stated
};

/// All passes. Those of one recording keep their numbers, those of several are counted from 0 on.
/// Fails with kInvalidOption where a pass that is stated is not there, or is stated twice.
Result<std::vector<PassOfMany>> list_passes(const std::vector<RecordingFrames>& recordings,
                                            const std::vector<PassPose>& stated);

/// One for each pass: where it lies, or why that is not known.
struct PassPlace {
  std::optional<PassPlacement> placement;
  std::string reason;
  std::string doubt;  ///< its surface contradicts what was stated; empty: it does not
};

/// In the frame of the first pass's table. The surfaces of the passes are measured and brought
/// together (reconstruction/passes); what is stated is taken all the same. options: of the
/// reconstruction. Fails with kCancelled and, unless all are stated, as reconstruct() does for the
/// first pass.
Result<std::vector<PassPlace>> place_passes(const std::vector<PassOfMany>& passes,
                                            const ReconstructOptions& options,
                                            const RunContext& context);

}  // namespace turnscan
