#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <turnscan/core/option_table.hpp>
#include <turnscan/geometry/mesh/clip.hpp>
#include <vector>

namespace turnscan {

enum class Holes { kSmooth, kFlat, kOpen };

/// Requested post-processing of the meshes, for any method.
struct FinishOptions {
  Holes holes = Holes::kSmooth;  ///< how unmeasured surface is treated
  double hole_size_m = 0.005;    ///< longest side; smaller holes are always closed smoothly
  double smooth_m = 0.0;         ///< wavelength whose amplitude is halved; 0: off
  double smallest_part_m = 0.0;  ///< parts whose longest side is shorter are dropped
  std::optional<int> object;     ///< the only one that is kept, counted from 1 by size
  /// "X0,Y0,Z0,X1,Y1,Z1", table frame: everything outside is cut away; an empty entry is no limit.
  /// Empty: no cut.
  std::string keep_box;
  /// "X,Y,Z,NX,NY,NZ": a point on a plane, table frame, and the direction in which everything is
  /// cut away.
  std::string cut_plane;
  /// "auto": as many as the surface's accuracy warrants, "all", or a maximum per object.
  std::string triangles = "auto";
  /// Simplify as long as the surface stays within this distance of the full one.
  std::optional<double> max_error_m;
};
OptionTable describe(FinishOptions& options);

inline constexpr std::size_t kAllTriangles = std::numeric_limits<std::size_t>::max();
/// Maximum number of triangles per object, or kAllTriangles; nullopt: as many as the surface's
/// accuracy warrants. Fails with kInvalidOption if the text is none of these.
Result<std::optional<std::size_t>> triangles_wanted(std::string_view text);

/// The half spaces of the box and the plane. Fails with kInvalidOption if a text does not have that
/// form, the box is empty or the direction is zero.
Result<std::vector<HalfSpace>> kept_half_spaces(const FinishOptions& options);

}  // namespace turnscan
