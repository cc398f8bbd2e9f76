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

/// What a person wants of the finished meshes, whatever the method.
struct FinishOptions {
  Holes holes = Holes::kSmooth;  ///< what becomes of surface that nothing measured
  double hole_size_m = 0.005;    ///< longest side; smaller ones are closed smoothly in any case
  double smooth_m = 0.0;         ///< half of the height of waves of this length stays; 0: off
  double smallest_part_m = 0.0;  ///< parts whose longest side is shorter are dropped
  std::optional<int> object;     ///< the only one that is kept, counted from 1 by size
  /// "X0,Y0,Z0,X1,Y1,Z1", table frame: what lies outside is cut away; an empty entry does not
  /// limit. Empty: nothing is.
  std::string keep_box;
  /// "X,Y,Z,NX,NY,NZ": a place on a plane, table frame, and the direction in which all is cut away.
  std::string cut_plane;
  /// "auto": as many as the surface is worth, "all", or at most so many an object.
  std::string triangles = "auto";
  /// Fewer triangles where the surface stays within this of the full one.
  std::optional<double> max_error_m;
};
OptionTable describe(FinishOptions& options);

inline constexpr std::size_t kAllTriangles = std::numeric_limits<std::size_t>::max();
/// At most so many triangles an object, or kAllTriangles; nullopt: as many as the surface is worth.
/// Fails with kInvalidOption when the text says none of these.
Result<std::optional<std::size_t>> triangles_wanted(std::string_view text);

/// What the box and the plane leave. Fails with kInvalidOption when a text has not that form, the
/// box is empty or the direction is zero.
Result<std::vector<HalfSpace>> kept_half_spaces(const FinishOptions& options);

}  // namespace turnscan
