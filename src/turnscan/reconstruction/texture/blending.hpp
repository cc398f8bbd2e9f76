#pragma once
// One colour per texel out of those of several views.

#include <turnscan/reconstruction/texture/highlight.hpp>
#include <turnscan/reconstruction/texture/seam_levels.hpp>
#include <turnscan/reconstruction/texture/shading_normals.hpp>

namespace turnscan::texture {

/// A lamp that is taken out of samples that mark_shadows() has marked.
struct LampCorrection {
  FixedLight light;
  std::vector<Vec3f> to_lamp;  ///< per view, object's frame
  NormalTilts tilts;           ///< of what the lamp shines on
};

/// What the linear light of views is multiplied by before they are compared.
struct Correction {
  std::vector<Vec3f> gains;  ///< per view
  BlockLevels levels;        ///< beside the gains; empty: all 1
  std::optional<LampCorrection> lamp;
  std::optional<SeenHighlight> highlight;
};

struct Blended {
  std::vector<Rgb> colors;          ///< per block and texel
  std::vector<std::uint8_t> known;  ///< whether a view shows it
  /// Per block: the view that weighs most in its colours; kNoView (texel_samples.hpp): none does.
  std::vector<std::uint16_t> main_view;
  double one_view_share = 0.0;   ///< of the blocks with several views: one was taken
  double disagreement_px = 0.0;  ///< median shift of a view against the best one
};

/// Views whose pattern lies more than a pixel from that of the best one are left out of a block and
/// those around it; the others' colours are averaged, weighted by resolution, incidence and
/// sharpness, each the less the farther it lies from the colour that
/// most of them agree on. The same for any number
/// of threads. Fails with kCancelled.
Result<Blended> blend(const TexelBlocks& blocks, const ChosenViews& chosen,
                      const TexelSamples& samples, const Correction& correction,
                      double texels_per_m, const RunContext& context);

}  // namespace turnscan::texture
