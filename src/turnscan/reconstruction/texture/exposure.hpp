#pragma once
// Exposure and white balance of each view, and the shading of a lamp that does not turn.

#include <turnscan/reconstruction/texture/texel_samples.hpp>

namespace turnscan::texture {

/// Mean colour (linear light) of each slot of each block; negative where it does not show the whole
/// block.
using BlockMeans = std::vector<std::array<Vec3f, kSlots>>;
BlockMeans block_means(const TexelBlocks& blocks, const ChosenViews& chosen,
                       const TexelSamples& samples);

/// Whether it is neither so dark nor so bright that its ratio to another one says nothing.
bool tells_of_exposure(const Vec3f& mean);

/// By what the red, green and blue (linear light) of each view are multiplied so that views agree
/// where they show the same: least squares of logarithms over all pairs of views, outliers weighed
/// down. The more the pairs contradict each other, the nearer gains stay to 1. Views that share
/// nothing with others stay as they are.
std::vector<Vec3f> solve_gains(const ChosenViews& chosen, const BlockMeans& means,
                               std::size_t views);

/// Light that does not turn with the object: from all sides alike, and from one lamp far away.
/// Lambert: I = albedo * (ambient + lamp * max(0, n . direction)).
struct FixedLight {
  Vec3f direction = Vec3f::UnitY();  ///< to the lamp, rig's frame
  float ambient = 1.0f, lamp = 0.0f;
  float on(const Vec3f& normal_rig) const {
    return ambient + lamp * std::max(0.0f, normal_rig.dot(direction));
  }
};

/// The light under which the many views of each block agree best about its albedo. rotation: per
/// view, from the object's frame to the rig's. normals: per block. The mean over the surface that
/// was seen is 1.
FixedLight solve_light(const ChosenViews& chosen, const BlockMeans& means,
                       const std::vector<Vec3f>& gains, const std::vector<Vec3f>& normals,
                       const std::vector<Eigen::Matrix3f>& rotation);

}  // namespace turnscan::texture
