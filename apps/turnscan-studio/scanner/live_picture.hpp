#pragma once
// A frame prepared for the live view.

#include <functional>
#include <optional>
#include <turnscan/core/frame.hpp>
#include <turnscan/turntable/crop/crop.hpp>

#include "view/drawable.hpp"

namespace turnscan::studio {

/// Replacement colour of a point; nullopt: keep its own.
using Tint = std::function<std::optional<Rgb>(const Vec3f& point)>;

/// Points to draw, approximately `most` at most: with the frame's colours, or shaded as if lit from
/// next to the sensor, so that shapes are visible. crop: only points that it keeps. Of a grid,
/// every n-th row and column is taken.
struct LivePicture {
  PointCloud cloud;
  int every = 1;           ///< n
  std::size_t points = 0;  ///< total number
};
LivePicture live_picture(const FramePoints& points, const std::optional<SensorCrop>& crop,
                         std::size_t most, const Tint& tint = {});

/// Draws its points as large as their spacing. pixel_rad: angle between two pixels; 0: not known.
DrawablePtr make_drawable(const LivePicture& picture, double pixel_rad);

}  // namespace turnscan::studio
