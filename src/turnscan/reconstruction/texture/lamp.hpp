#pragma once
// Estimates a lamp that stands still while the object turns, and removes its shading from the
// colours.

#include <turnscan/reconstruction/texture/exposure.hpp>
#include <turnscan/reconstruction/texture/lamp_view.hpp>

namespace turnscan::texture {

/// Illumination that does not turn with the object: ambient light, and one distant lamp. Lambert: I
/// = albedo * (ambient + lamp * max(0, n . direction)), the second term only where there is no
/// shadow.
struct FixedLight {
  Vec3f direction = Vec3f::UnitY();  ///< to the lamp, rig's frame
  float ambient = 1.0f, lamp = 0.0f;
  /// facing: cosine between normal and direction; surface that the lamp does not reach gets only
  /// ambient light.
  float on(float facing, bool reached) const {
    return reached ? ambient + lamp * std::max(0.0f, facing) : ambient;
  }
};

/// Unit, rig's frame; radians, above the horizontal and about +Y from +Z.
Vec3f rig_direction(double azimuth, double elevation);

/// Lower limit of the light by which colours are divided.
inline constexpr float kMinLight = 0.05f;

/// Input for estimating a lamp. Refers to its parts.
struct LampScene {
  const TriangleMesh& mesh;
  const TriangleMesh&
      coarse;  ///< by coarse_caster(): casts the shadows while the lamp is estimated
  const TexelBlocks& blocks;
  const ChosenViews& chosen;
  const BlockMeans& means;
  std::vector<Eigen::Matrix3f> rotation;  ///< per view, from the object's frame to the rig's
};

/// A simplified mesh for casting shadows. Fails as simplify().
Result<TriangleMesh> coarse_caster(const TriangleMesh& mesh);

/// Light on each block in each of its views, at its middle; negative if the edge of a shadow is
/// near.
using BlockLight = std::vector<std::array<float, kSlots>>;

/// The light for which the views of each point agree best on its albedo, including shadows cast by
/// the mesh. Its mean over the observed surface is 1. gains: per view. near: approximate light;
/// empty: unknown. The result does not depend on the number of threads. Fails with kCancelled.
Result<FixedLight> solve_light(const LampScene& scene, const std::vector<Vec3f>& gains,
                               const std::optional<FixedLight>& near, const RunContext& context);

/// Fails with kCancelled.
Result<BlockLight> block_light(const LampScene& scene, const FixedLight& light,
                               const RunContext& context);

/// Marks in each sample whether the lamp reaches it. Fails with kCancelled.
Result<> mark_shadows(const LampScene& scene, const FixedLight& light, TexelSamples& samples,
                      const RunContext& context);

}  // namespace turnscan::texture
