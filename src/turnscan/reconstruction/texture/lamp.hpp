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
  /// facing: cosine between normal and direction; of what the lamp does not reach only the rest.
  float on(float facing, bool reached) const {
    return reached ? ambient + lamp * std::max(0.0f, facing) : ambient;
  }
};

/// Unit, rig's frame; radians, above the horizontal and about +Y from +Z.
Vec3f rig_direction(double azimuth, double elevation);

/// Light that is divided by is at least this.
inline constexpr float kMinLight = 0.05f;

/// What a lamp is looked for in. Refers to its parts.
struct LampScene {
  const TriangleMesh& mesh;
  const TriangleMesh&
      coarse;  ///< by coarse_caster(): casts the shadows while the lamp is looked for
  const TexelBlocks& blocks;
  const ChosenViews& chosen;
  const BlockMeans& means;
  std::vector<Eigen::Matrix3f> rotation;  ///< per view, from the object's frame to the rig's
};

/// Fails as simplify().
Result<TriangleMesh> coarse_caster(const TriangleMesh& mesh);

/// How the light falls on each block in each of its views, by its middle; negative where the edge
/// of a shadow is near.
using BlockLight = std::vector<std::array<float, kSlots>>;

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
