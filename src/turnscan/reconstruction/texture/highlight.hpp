#pragma once
// The highlight of a lamp that stands still while the object turns: found, so that places take
// their colours from views that do not show it there.

#include <optional>
#include <turnscan/reconstruction/texture/exposure.hpp>

namespace turnscan::texture {

/// What a glossy surface mirrors of one lamp far away (Blinn 1977): strength * (n . h)^exponent is
/// added to the linear light of each channel, h halfway between the directions to lamp and eye.
struct Highlight {
  Vec3f direction = Vec3f::UnitY();  ///< to the lamp, rig's frame
  float strength = 0.0f, exponent = 1.0f;
  /// cosine: n . h. 0 where it is less than what can be told from none.
  float on(float cosine) const;
};

/// Where views look from, and how the object had turned.
struct Viewpoints {
  std::vector<Eigen::Matrix3f> rotation;  ///< per view, from the object's frame to the rig's
  std::vector<Vec3f> eye;                 ///< per view, object's frame
};

/// A highlight as the views see it.
class SeenHighlight {
 public:
  SeenHighlight(const Highlight& highlight, const Viewpoints& viewpoints);
  const Highlight& highlight() const { return highlight_; }
  /// h of a place that a view sees, object's frame.
  Vec3f half(std::size_t view, const Vec3f& position) const {
    return (to_lamp_[view] + (eye_[view] - position).normalized()).normalized();
  }

 private:
  Highlight highlight_;
  std::vector<Vec3f> to_lamp_, eye_;  // per view, object's frame
};

/// The highlight without which the views of each place agree best; none where one explains too
/// little of what they differ by. Means are those after gain. The same for any number of threads.
/// Fails with kCancelled.
Result<std::optional<Highlight>> solve_highlight(const TexelBlocks& blocks,
                                                 const ChosenViews& chosen, const BlockMeans& means,
                                                 const Viewpoints& viewpoints,
                                                 const RunContext& context);

/// Leaves out the slots that show much of it, and takes the rest of it out of the others. gains:
/// per view, that the means were not multiplied by yet.
BlockMeans without_highlight(BlockMeans means, const TexelBlocks& blocks, const ChosenViews& chosen,
                             const SeenHighlight& seen, const std::vector<Vec3f>& gains);

}  // namespace turnscan::texture
