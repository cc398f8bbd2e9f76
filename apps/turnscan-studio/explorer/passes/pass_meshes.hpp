#pragma once
// The passes that a mesh was made from, and the pass poses that follow from aligning two meshes.

#include <turnscan/reconstruction/result.hpp>
#include <turnscan/workflow/passes/pass_pose.hpp>
#include <vector>

#include "explorer/models.hpp"

namespace turnscan::studio {

using PassesPtr = std::shared_ptr<const PassesOfMesh>;

/// For each object of a run on all passes of a recording, or only on pass `only`. Empty if the
/// recording has a single pass.
std::vector<PassesPtr> passes_of_meshes(const ModelDataPtr& recording, const Reconstruction& made,
                                        std::optional<std::uint32_t> only);

/// Whether both are from one recording, and have no pass in common.
bool can_be_joined(const PassesOfMesh& one, const PassesOfMesh& other);

/// Approximate poses of the passes of both on the first pass's table, if this transformation aligns
/// one with the other. Fails with kMissingData if neither contains the recording's first pass.
Result<std::vector<PassPose>> poses_of_passes(const PassesOfMesh& fixed, const PassesOfMesh& moved,
                                              const Pose& T_fixed_moved);

/// The syntax of `--pass-pose`: "PASS=RX,RY,RZ,TX,TY,TZ" in degrees and millimetres, to 0.0001 of
/// both.
std::string pass_pose_text(const PassPose& pose);

}  // namespace turnscan::studio
