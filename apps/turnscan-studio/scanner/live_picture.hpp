#pragma once
// A frame as it is shown live.

#include <functional>
#include <optional>
#include <turnscan/core/frame.hpp>
#include <turnscan/turntable/crop/crop.hpp>

#include "view/drawable.hpp"

namespace turnscan::studio {

/// Colour of a point in place of its own; nullopt: none.
using Tint = std::function<std::optional<Rgb>(const Vec3f& point)>;

/// Points that are drawn, about `most` at most: with the frame's colours, or shaded as if a lamp
/// stood beside the sensor, so that shapes are seen. crop: only what it keeps. Of a grid every n-th
/// row and column is taken.
struct LivePicture {
  PointCloud cloud;
  int every = 1;           ///< n
  std::size_t points = 0;  ///< that there are
};
LivePicture live_picture(const FramePoints& points, const std::optional<SensorCrop>& crop,
                         std::size_t most, const Tint& tint = {});

/// Its points as large as they lie apart. pixel_rad: angle between two pixels; 0: not known.
DrawablePtr make_drawable(const LivePicture& picture, double pixel_rad);

}  // namespace turnscan::studio
