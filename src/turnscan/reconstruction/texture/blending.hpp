#pragma once
// Blends the colours of several views into one per texel.

#include <turnscan/reconstruction/texture/highlight.hpp>
#include <turnscan/reconstruction/texture/seam_levels.hpp>
#include <turnscan/reconstruction/texture/shading_normals.hpp>

namespace turnscan::texture {

/// A lamp whose shading is removed from samples that mark_shadows() has marked.
struct LampCorrection {
  FixedLight light;
  std::vector<Vec3f> to_lamp;  ///< per view, object's frame
  NormalTilts tilts;           ///< of the surface that the lamp illuminates
};

/// Corrections of the views' linear light before they are compared.
struct Correction {
  std::vector<Vec3f> gains;  ///< per view
  BlockLevels levels;        ///< in addition to the gains; empty: all 1
  std::optional<LampCorrection> lamp;
  std::optional<SeenHighlight> highlight;
};

struct Blended {
  std::vector<Rgb> colors;          ///< per block and texel
  std::vector<std::uint8_t> known;  ///< whether a view shows it
  /// Per block: the view with the largest weight in its colours; kNoView (texel_samples.hpp) if
  /// there is none.
  std::vector<std::uint16_t> main_view;
  double one_view_share = 0.0;   ///< share of the blocks with several views of which one was taken
  double disagreement_px = 0.0;  ///< median shift of a view relative to the best one
};

/// In each block and those around it, views whose pattern is displaced by more than a pixel from
/// that of the best one are excluded; the colours of the others are averaged, weighted by
/// resolution, incidence and sharpness, and the less, the farther they are from the colour that
/// most views agree on. The result does not depend on the number of threads. Fails with kCancelled.
Result<Blended> blend(const TexelBlocks& blocks, const ChosenViews& chosen,
                      const TexelSamples& samples, const Correction& correction,
                      double texels_per_m, const RunContext& context);

}  // namespace turnscan::texture
