#pragma once
// The platter in point clouds, by what turns.

#include <optional>
#include <span>
#include <turnscan/turntable/motion_input/frame_data.hpp>

namespace turnscan::motion {

struct TurningDisc {
  double height_m = 0.0;  ///< of its surface along the axis, from the axis' centre
  double radius_m = 0.0;
  double height_sigma_m = 0.0, radius_sigma_m = 0.0;
  double rim_share = 0.0;  ///< share of the bearings at which it is seen to reach its rim
};

/// The level surface that most of the upward samples lie on, if it is a disc about the axis with
/// nothing below it: scans of clouds show no platter in an image. axis: unit, upward, through
/// axis.center_m; angles_rad: of data.frames.
std::optional<TurningDisc> find_turning_disc(const MotionData& data, const TurntableInfo& axis,
                                             std::span<const double> angles_rad);

}  // namespace turnscan::motion
