#pragma once
// A lamp that stands still while the object turns: found, and taken out of the colours.

#include <turnscan/reconstruction/texture/exposure.hpp>
#include <turnscan/reconstruction/texture/lamp_view.hpp>

namespace turnscan::texture {

/// Light that does not turn with the object: from all sides alike, and from one lamp far away.
/// Lambert: I = albedo * (ambient + lamp * max(0, n . direction)), the second where no shadow lies.
struct FixedLight {
  Vec3f direction = Vec3f::UnitY();  ///< to the lamp, rig's frame
  float ambient = 1.0f, lamp = 0.0f;
  float on(const Vec3f& normal_rig, bool reached = true) const {
    return reached ? ambient + lamp * std::max(0.0f, normal_rig.dot(direction)) : ambient;
  }
};

/// What a lamp is looked for in. Refers to its parts.
struct LampScene {
  const TriangleMesh& mesh;
  const TexelBlocks& blocks;
  const ChosenViews& chosen;
  const BlockMeans& means;
  std::vector<Eigen::Matrix3f> rotation;  ///< per view, from the object's frame to the rig's
};

/// How the light falls on each block in each of its views: by its middle.
struct BlockLight {
  std::vector<std::array<float, kSlots>> light;  ///< negative where the edge of a shadow is near
};

/// The light under which the views of each place agree best about its albedo, shadows that the mesh
/// casts included. The mean over the surface that was seen is 1. gains: per view. near: it is about
/// there; empty: anywhere. The same for any number of threads. Fails with kCancelled.
Result<FixedLight> solve_light(const LampScene& scene, const std::vector<Vec3f>& gains,
                               const std::optional<FixedLight>& near, const RunContext& context);

/// Fails with kCancelled.
Result<BlockLight> block_light(const LampScene& scene, const FixedLight& light,
                               const RunContext& context);

/// Notes of each sample whether the lamp reaches it. Fails with kCancelled.
Result<> mark_shadows(const LampScene& scene, const FixedLight& light, TexelSamples& samples,
                      const RunContext& context);

}  // namespace turnscan::texture
