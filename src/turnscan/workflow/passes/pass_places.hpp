#pragma once
// Lists the passes and determines their poses, as stated by the user or from their surfaces.

#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/options.hpp>
#include <turnscan/workflow/passes/joined_frames.hpp>
#include <turnscan/workflow/passes/pass_pose.hpp>

namespace turnscan {

/// One of several recordings, calibrated; frames must outlive the results made from it.
struct RecordingFrames {
  std::string name;  ///< human-readable
  const FrameSequence* frames = nullptr;
  std::optional<double> speed_rad_s;  ///< stated
};

/// One pass of one of the recordings.
struct PassOfMany {
  SequencePass frames;
  std::uint32_t number = 0;          ///< the number shown to the user
  std::string name;                  ///< "pass 1", with the recording's name if there are several
  std::optional<Pose> T_first_pass;  ///< stated
  bool refine = false;               ///< the stated pose is approximate; see PassPose
};

/// Lists all passes. Passes of a single recording keep their numbers, passes of several are
/// numbered from 0. Fails with kInvalidOption if a stated pass does not exist, or is stated twice.
Result<std::vector<PassOfMany>> list_passes(const std::vector<RecordingFrames>& recordings,
                                            const std::vector<PassPose>& stated);

/// An object and its pose in each of the passes that show it.
struct ObjectPlaces {
  std::vector<std::optional<PassPlacement>> of_pass;  ///< one per pass; nullopt: not joined
};

struct PassPlaces {
  std::vector<ObjectPlaces> objects;  ///< those found in two or more passes
  /// Per pass: why it, or which of several objects in it and why, was not joined with any other
  /// pass.
  std::vector<std::string> reasons;
  /// Per pass with a reason: the part of its table that was not joined; nullopt: all of it.
  std::vector<std::optional<ObjectPartition>> left;
  std::vector<std::string> notes;  ///< human-readable
};

/// Reconstructs the surfaces of the objects in all passes and registers them
/// (reconstruction/passes). An object's frame is that of the table in the first pass that shows it.
/// Stated poses are used, with a note if the surfaces contradict them; approximate poses are
/// refined by registration, and not joined if they do not fit. options: of the reconstruction.
/// Fails with kCancelled, as reconstruct() does for the first pass unless all poses are stated, and
/// with kUnsupported if one of the passes has several objects and only some passes have stated
/// poses, or one of them is approximate.
Result<PassPlaces> place_passes(const std::vector<PassOfMany>& passes,
                                const ReconstructOptions& options, const RunContext& context);

}  // namespace turnscan
