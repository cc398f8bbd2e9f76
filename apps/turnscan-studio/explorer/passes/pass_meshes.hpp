#pragma once
// Which passes a mesh is made of, and what two meshes that are brought together say of them.

#include <turnscan/reconstruction/result.hpp>
#include <turnscan/workflow/passes/pass_pose.hpp>
#include <vector>

#include "explorer/models.hpp"

namespace turnscan::studio {

using PassesPtr = std::shared_ptr<const PassesOfMesh>;

/// Of each object of a run on all passes of a recording, or on the `only` one. Nothing where it has
/// but one.
std::vector<PassesPtr> passes_of_meshes(const ModelDataPtr& recording, const Reconstruction& made,
                                        std::optional<std::uint32_t> only);

/// Whether both are of one recording, and no pass is in both.
bool can_be_joined(const PassesOfMesh& one, const PassesOfMesh& other);

/// About where the passes of both lie on the first pass's table, when this motion brings one onto
/// the other. Fails with kMissingData when neither has the recording's first pass.
Result<std::vector<PassPose>> poses_of_passes(const PassesOfMesh& fixed, const PassesOfMesh& moved,
                                              const Pose& T_fixed_moved);

/// As `--pass-pose` takes it: "PASS=RX,RY,RZ,TX,TY,TZ" in degrees and millimetres, to 0.0001 of
/// both.
std::string pass_pose_text(const PassPose& pose);

}  // namespace turnscan::studio
