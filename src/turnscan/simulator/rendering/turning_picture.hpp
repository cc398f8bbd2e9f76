#pragma once
// Pictures of meshes on a table that turns once in front of a static camera and lamp.

#include <functional>
#include <turnscan/simulator/rendering/picture.hpp>

namespace turnscan {

struct TurnOptions {
  int frames = 120;
  double time_s = 5.0;  ///< their total duration
};

OptionTable describe(TurnOptions& options);

/// Passes the pictures to take() one after the other, counter-clockwise seen from above; the first
/// is seen from options.azimuth_rad, and all of the meshes stay in the picture. options.views must
/// be 1 (kInvalidOption). Stops if take() fails, and fails as render_picture().
Result<> render_turn(std::span<const TriangleMesh> meshes, const PictureOptions& options,
                     const TurnOptions& turn, const std::function<Result<>(ColorImage)>& take,
                     const RunContext& context = RunContext());

}  // namespace turnscan
