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
  bool refine = false;               ///< stated roughly; see PassPose
};

/// All passes. Those of one recording keep their numbers, those of several are counted from 0 on.
/// Fails with kInvalidOption where a pass that is stated is not there, or is stated twice.
Result<std::vector<PassOfMany>> list_passes(const std::vector<RecordingFrames>& recordings,
                                            const std::vector<PassPose>& stated);

/// An object, and where it lies in each of the passes that show it.
struct ObjectPlaces {
  std::vector<std::optional<PassPlacement>> of_pass;  ///< one a pass; nullopt: it is not joined
};

struct PassPlaces {
  std::vector<ObjectPlaces> objects;  ///< each of two or more passes
  /// Per pass: why it, or which of several objects in it and why, was joined with no other pass.
  std::vector<std::string> reasons;
  /// Per pass with a reason: the part of its table that was not joined; nullopt: all of it.
  std::vector<std::optional<ObjectPartition>> left;
  std::vector<std::string> notes;  ///< for people
};

/// Measures the surfaces of the objects in all passes and brings them together
/// (reconstruction/passes). An object lies in the frame of the table of the first pass that shows
/// it. What is stated is taken, and doubted where the surfaces show something else; what is stated
/// roughly is brought onto the others, and not joined where it does not fit. options: of the
/// reconstruction. Fails with kCancelled, unless all are stated as reconstruct() does for the first
/// pass, and with kUnsupported when one of the passes has several objects and the poses of some
/// passes only are stated, or one roughly.
Result<PassPlaces> place_passes(const std::vector<PassOfMany>& passes,
                                const ReconstructOptions& options, const RunContext& context);

}  // namespace turnscan
