#pragma once
// Normals finer than the mesh's, from the variation of a lamp's light as they turn.

#include <turnscan/reconstruction/texture/lamp.hpp>

namespace turnscan::texture {

/// Corrections of the mesh's normals, smooth over each chart. Refers to the blocks.
class NormalTilts {
 public:
  /// Squares with one tilt each: half a block.
  static constexpr int kSquare_px = kBlock_px / 2;
  static constexpr int kSquares = kBlockTexels / (kSquare_px * kSquare_px);  ///< of a block
  using OfBlock = std::array<Vec3f, kSquares>;  ///< row by row, object's frame

  NormalTilts(const TexelBlocks& blocks, std::vector<OfBlock> tilts)
      : blocks_(&blocks), tilts_(std::move(tilts)) {}

  /// Interpolated between the centres of the squares around a texel of a block.
  Vec3f at(std::size_t block, int texel) const;

 private:
  const TexelBlocks* blocks_;
  std::vector<OfBlock> tilts_;
};

/// Photometric stereo (Woodham 1980) about the mesh's normals: the views of each texel under a
/// known light are made to agree on its albedo; squares of texels share a tilt with their
/// surroundings, whose prior deviation is about 0.1. gains: per view; to_lamp: per view, object's
/// frame; samples: marked by mark_shadows(). The result does not depend on the number of threads.
NormalTilts shading_normals(const TexelBlocks& blocks, const ChosenViews& chosen,
                            const TexelSamples& samples, const std::vector<Vec3f>& gains,
                            const FixedLight& light, const std::vector<Vec3f>& to_lamp,
                            double texels_per_m);

}  // namespace turnscan::texture
