#pragma once
// Estimates the highlight of a lamp that stands still while the object turns, so that surface
// points take their colours from views without it.

#include <optional>
#include <turnscan/reconstruction/texture/exposure.hpp>

namespace turnscan::texture {

/// Specular reflection of one distant lamp (Blinn 1977): strength * (n . h)^exponent is added to
/// the linear light of each channel, with h halfway between the directions to lamp and eye.
struct Highlight {
  Vec3f direction = Vec3f::UnitY();  ///< to the lamp, rig's frame
  float strength = 0.0f, exponent = 1.0f;
  /// cosine: n . h. Returns 0 if it is too small to be distinguished from none.
  float on(float cosine) const;
};

/// Viewpoints, and the object's rotation in each.
struct Viewpoints {
  std::vector<Eigen::Matrix3f> rotation;  ///< per view, from the object's frame to the rig's
  std::vector<Vec3f> eye;                 ///< per view, object's frame
};

/// A highlight as seen by the views.
class SeenHighlight {
 public:
  SeenHighlight(const Highlight& highlight, const Viewpoints& viewpoints);
  const Highlight& highlight() const { return highlight_; }
  /// h of a point that a view sees, object's frame.
  Vec3f half(std::size_t view, const Vec3f& position) const {
    return (to_lamp_[view] + (eye_[view] - position).normalized()).normalized();
  }

 private:
  Highlight highlight_;
  std::vector<Vec3f> to_lamp_, eye_;  // per view, object's frame
};

/// The highlight after whose removal the views of each point agree best; nullopt if none explains
/// enough of their differences. Means are those after gain. The result does not depend on the
/// number of threads. Fails with kCancelled.
Result<std::optional<Highlight>> solve_highlight(const TexelBlocks& blocks,
                                                 const ChosenViews& chosen, const BlockMeans& means,
                                                 const Viewpoints& viewpoints,
                                                 const RunContext& context);

/// Excludes the slots that show much of the highlight, and removes the rest of it from the others.
/// gains: per view, not yet applied to the means.
BlockMeans without_highlight(BlockMeans means, const TexelBlocks& blocks, const ChosenViews& chosen,
                             const SeenHighlight& seen, const std::vector<Vec3f>& gains);

}  // namespace turnscan::texture
