#pragma once
// What stands around the turntable and does not turn.

#include <cstdint>
#include <span>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan {

enum class RoomKind {
  kNone,    ///< the table hangs in empty space
  kDesk,    ///< a foot under the platter, on a desk
  kWall,    ///< and a wall behind
  kClutter  ///< and things that lie about on the desk
};

struct RoomOptions {
  RoomKind kind = RoomKind::kNone;
  double foot_m = 0.03;  ///< from the underside of the platter to the desk
  int clutter = 12;      ///< things on the desk
};

OptionTable describe(RoomOptions& options);

/// The room about a platter whose centre (on its surface) is at `centre` (world frame, +Y up), with
/// vertex colours, each face with vertices of its own. The wall is behind the platter as the first
/// scanner sees it, and behind every scanner's back. Things keep out of the way between the
/// scanners and the platter, and clear of the platter; where and what they are follows from the
/// seed.
TriangleMesh make_room(const RoomOptions& options, const Vec3d& centre, double platter_radius_m,
                       double platter_thickness_m, std::span<const Vec3d> scanners,
                       std::uint64_t seed);

/// The side and the underside of a platter, table frame; empty without thickness. Its face is the
/// scene's own disc.
TriangleMesh platter_body(double radius_m, double thickness_m);

}  // namespace turnscan
