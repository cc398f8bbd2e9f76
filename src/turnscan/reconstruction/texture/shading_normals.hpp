#pragma once
// Normals that are finer than the mesh's, from how a lamp's light changes on them as they turn.

#include <turnscan/reconstruction/texture/lamp.hpp>

namespace turnscan::texture {

/// What is to be added to the mesh's normals, smooth over each chart. Refers to the blocks.
class NormalTilts {
 public:
  /// Squares that have a tilt each: half a block.
  static constexpr int kSquare_px = kBlock_px / 2;
  static constexpr int kSquares = kBlockTexels / (kSquare_px * kSquare_px);  ///< of a block
  using OfBlock = std::array<Vec3f, kSquares>;  ///< row by row, object's frame

  NormalTilts(const TexelBlocks& blocks, std::vector<OfBlock> tilts)
      : blocks_(&blocks), tilts_(std::move(tilts)) {}

  /// Between the middles of the squares about a texel of a block.
  Vec3f at(std::size_t block, int texel) const;

 private:
  const TexelBlocks* blocks_;
  std::vector<OfBlock> tilts_;
};

/// Photometric stereo (Woodham 1980) about the mesh's normals: of each texel the views under a
/// known light are to agree about its albedo; squares of texels, with those about them, share a
/// tilt, which is taken for some 0.1 where the views do not tell. gains: per view; to_lamp: per
/// view, object's frame; samples: marked by mark_shadows(). The same for any number of threads.
NormalTilts shading_normals(const TexelBlocks& blocks, const ChosenViews& chosen,
                            const TexelSamples& samples, const std::vector<Vec3f>& gains,
                            const FixedLight& light, const std::vector<Vec3f>& to_lamp,
                            double texels_per_m);

}  // namespace turnscan::texture
