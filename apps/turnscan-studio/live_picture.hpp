#pragma once
// A frame as it is shown live.

#include <optional>
#include <turnscan/core/frame.hpp>
#include <turnscan/turntable/crop.hpp>

namespace turnscan::studio {

/// Points that are drawn, at most `most`: with the frame's colours, or shaded as if a lamp stood
/// beside the sensor, so that shapes are seen. crop: only what it keeps.
PointCloud live_picture(const FramePoints& points, const std::optional<SensorCrop>& crop,
                        std::size_t most);

}  // namespace turnscan::studio
