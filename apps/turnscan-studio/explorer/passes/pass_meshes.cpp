#include "explorer/passes/pass_meshes.hpp"

#include <algorithm>
#include <turnscan/core/angles.hpp>
#include <turnscan/workflow/passes/pass_places.hpp>

namespace turnscan::studio {

std::vector<PassesPtr> passes_of_meshes(const ModelDataPtr& recording, const Reconstruction& made,
                                        std::optional<std::uint32_t> only) {
  std::vector<PassesPtr> out(made.objects.size());
  const auto passes = list_passes({{"", recording->recording.get(), {}}}, {});
  if (!passes || passes->size() < 2) return out;
  for (std::size_t object = 0; object < out.size(); ++object) {
    auto of = std::make_shared<PassesOfMesh>();
    of->recording = recording;
    if (only) of->T_mesh_table[*only] = Pose::Identity();
    for (const FusedPass& fused : made.passes)
      for (const PassOfMany& pass : *passes)
        if (pass.name == fused.name && (fused.object < 0 || std::size_t(fused.object) == object))
          of->T_mesh_table[pass.number] = fused.T_object_table;
    if (!of->T_mesh_table.empty()) out[object] = of;
  }
  return out;
}

bool can_be_joined(const PassesOfMesh& one, const PassesOfMesh& other) {
  return one.recording->source == other.recording->source &&
         std::none_of(one.T_mesh_table.begin(), one.T_mesh_table.end(),
                      [&](const auto& pass) { return other.T_mesh_table.count(pass.first) > 0; });
}

Result<std::vector<PassPose>> poses_of_passes(const PassesOfMesh& fixed, const PassesOfMesh& moved,
                                              const Pose& T_fixed_moved) {
  std::map<std::uint32_t, Pose> T_fixed_table = fixed.T_mesh_table;
  for (const auto& [pass, T_moved_table] : moved.T_mesh_table)
    T_fixed_table[pass] = T_fixed_moved * T_moved_table;
  const std::uint32_t first = passes_of(*fixed.recording->recording).front();
  if (T_fixed_table.count(first) == 0)
    return fail(ErrorCode::kMissingData,
                "neither mesh has pass {}, by which all others are placed; choose the one that has",
                first);
  const Pose T_first_fixed = T_fixed_table[first].inverse();
  std::vector<PassPose> out;
  for (const auto& [pass, T] : T_fixed_table)
    if (pass != first) out.push_back({pass, T_first_fixed * T, true});
  return out;
}

std::string pass_pose_text(const PassPose& pose) {
  const Vec3d turns = pose.T_first_table.linear().eulerAngles(2, 1, 0) * kDegreesPerRadian;
  const Vec3d shift = pose.T_first_table.translation() * 1e3;
  return fmt::format("{}={:.4f}deg,{:.4f}deg,{:.4f}deg,{:.4f}mm,{:.4f}mm,{:.4f}mm", pose.pass,
                     turns.z(), turns.y(), turns.x(), shift.x(), shift.y(), shift.z());
}

}  // namespace turnscan::studio
