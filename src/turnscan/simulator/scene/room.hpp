#pragma once
// Static surroundings of the turntable.

#include <cstdint>
#include <span>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan {

enum class RoomKind {
  kNone,    ///< the table is in empty space
  kDesk,    ///< a foot under the platter, on a desk
  kWall,    ///< also a wall behind
  kClutter  ///< also objects on the desk
};

struct RoomOptions {
  RoomKind kind = RoomKind::kNone;
  double foot_m = 0.03;  ///< from the underside of the platter to the desk
  int clutter = 12;      ///< number of objects on the desk
};

OptionTable describe(RoomOptions& options);

/// The room around a platter whose centre (on its surface) is at `centre` (world frame, +Y up),
/// with vertex colours, each face with vertices of its own. The wall is behind the platter as seen
/// from the first scanner, and behind every scanner. Objects stay clear of the platter and of the
/// space between it and the scanners; their kinds and positions follow from the seed.
TriangleMesh make_room(const RoomOptions& options, const Vec3d& centre, double platter_radius_m,
                       double platter_thickness_m, std::span<const Vec3d> scanners,
                       std::uint64_t seed);

/// The side and the underside of a platter, table frame; empty without thickness. Its upper face is
/// the scene's own disc.
TriangleMesh platter_body(double radius_m, double thickness_m);

}  // namespace turnscan
