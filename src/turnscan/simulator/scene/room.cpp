#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/simulator/scene/room.hpp>

namespace turnscan {

namespace {

constexpr int kSegments = 96;
constexpr Rgb kDeskColor{150, 111, 72};
constexpr Rgb kWallColor{214, 208, 196};
constexpr Rgb kFootColor{52, 54, 58};
constexpr Rgb kPlatterSideColor{120, 122, 126};
constexpr std::array<Rgb, 6> kThingColors{
    {{186, 58, 48}, {64, 104, 168}, {224, 182, 70}, {92, 142, 84}, {205, 205, 205}, {96, 80, 120}}};
constexpr double kDeskThickness_m = 0.03;
constexpr double kDeskReach_m = 0.7;  // beside and in front of the platter's centre
constexpr double kWallGap_m = 0.25;   // behind the rearmost element
constexpr double kWallHalfWidth_m = 2.5;
constexpr double kWallHeight_m = 2.0;
constexpr std::uint64_t kThingSalt = 0x726f6f6dULL;

void add_quad(TriangleMesh& mesh, const std::array<Vec3d, 4>& corners, Rgb color) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vec3d& p : corners) {
    mesh.vertices.push_back(p.cast<float>());
    mesh.colors.push_back(color);
  }
  // At a pole two corners coincide.
  if (corners[0] != corners[1]) mesh.triangles.push_back({first, first + 1, first + 2});
  if (corners[2] != corners[3]) mesh.triangles.push_back({first, first + 2, first + 3});
}

/// A box whose corners are T * (+-half).
void add_box(TriangleMesh& mesh, const Pose& T, const Vec3d& half, Rgb color) {
  for (int axis = 0; axis < 3; ++axis) {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    for (const double side : {-1.0, 1.0}) {
      std::array<Vec3d, 4> corners;
      for (int k = 0; k < 4; ++k) {
        const double s = k == 1 || k == 2 ? 1.0 : -1.0, t = k >= 2 ? 1.0 : -1.0;
        Vec3d p = Vec3d::Zero();
        p[axis] = side * half[axis];
        p[a] = (side > 0.0 ? s : t) * half[a];
        p[b] = (side > 0.0 ? t : s) * half[b];
        corners[static_cast<std::size_t>(k)] = T * p;
      }
      add_quad(mesh, corners, color);
    }
  }
}

/// A surface between two radii at two heights about the y axis; a ring or a disc if both heights
/// are equal.
void add_band(TriangleMesh& mesh, const Vec3d& base, double r0, double y0, double r1, double y1,
              Rgb color) {
  const auto at = [&](double r, double y, int i) {
    const double angle = kTurn * i / kSegments;
    return Vec3d(base + Vec3d(r * std::sin(angle), y, r * std::cos(angle)));
  };
  for (int i = 0; i < kSegments; ++i)
    add_quad(mesh, {at(r0, y0, i), at(r0, y0, i + 1), at(r1, y1, i + 1), at(r1, y1, i)}, color);
}

void add_cylinder(TriangleMesh& mesh, const Vec3d& base, double radius, double height, Rgb color) {
  add_band(mesh, base, 0.0, 0.0, radius, 0.0, color);
  add_band(mesh, base, radius, 0.0, radius, height, color);
  add_band(mesh, base, radius, height, 0.0, height, color);
}

void add_ball(TriangleMesh& mesh, const Vec3d& centre, double radius, Rgb color) {
  constexpr int kRings = 24;
  for (int i = 0; i < kRings; ++i) {
    const double a = std::numbers::pi * i / kRings, b = std::numbers::pi * (i + 1) / kRings;
    add_band(mesh, centre, radius * std::sin(a), -radius * std::cos(a), radius * std::sin(b),
             -radius * std::cos(b), color);
  }
}

Pose at_place(const Vec3d& p, double yaw) {
  Pose T = rotation_about_y(yaw);
  T.translation() = p;
  return T;
}

/// Azimuth of p about the centre: 0 on -Z.
double azimuth_of(const Vec3d& p) { return std::atan2(-p.x(), -p.z()); }

/// The room in a frame whose origin is the platter's centre and whose +Z points to the wall.
class RoomBuilder {
 public:
  RoomBuilder(const RoomOptions& options, double radius, double thickness,
              std::vector<Vec3d> scanners, std::uint64_t seed)
      : options_(options),
        radius_(radius),
        desk_y_(-thickness - options.foot_m),
        foot_y_(-thickness),
        scanners_(std::move(scanners)),
        seed_(seed) {
    wall_z_ = desk_reach();
    for (const Vec3d& p : scanners_) wall_z_ = std::max(wall_z_, p.z());
    wall_z_ += kWallGap_m;
  }

  TriangleMesh build() {
    add_desk();
    if (options_.kind >= RoomKind::kWall) add_wall();
    if (options_.kind >= RoomKind::kClutter)
      for (int i = 0; i < options_.clutter; ++i) add_thing(static_cast<std::uint64_t>(i));
    mesh_.name = "room";
    return std::move(mesh_);
  }

 private:
  double desk_reach() const { return std::max(kDeskReach_m, 2.0 * radius_); }

  void add_desk() {
    const double reach = desk_reach();
    const Vec3d half(1.3 * reach, 0.5 * kDeskThickness_m, reach);
    add_box(mesh_, at_place({0.0, desk_y_ - half.y(), 0.0}, 0.0), half, kDeskColor);
    if (options_.foot_m > 0.0)
      add_cylinder(mesh_, {0.0, desk_y_, 0.0}, 0.3 * radius_, foot_y_ - desk_y_, kFootColor);
  }

  void add_wall() {
    const double low = desk_y_ - 0.75, high = desk_y_ + kWallHeight_m;
    add_quad(mesh_,
             {Vec3d(kWallHalfWidth_m, low, wall_z_), Vec3d(-kWallHalfWidth_m, low, wall_z_),
              Vec3d(-kWallHalfWidth_m, high, wall_z_), Vec3d(kWallHalfWidth_m, high, wall_z_)},
             kWallColor);
  }

  /// Whether an object there could come between a scanner and the platter.
  bool in_view(const Vec3d& place, double size) const {
    return std::any_of(scanners_.begin(), scanners_.end(), [&](const Vec3d& p) {
      const Vec3d way = Vec3d(p.x(), 0.0, p.z()).normalized();
      const double aside = std::abs(place.z() * way.x() - place.x() * way.z());
      return place.dot(way) > 0.0 && aside < 1.1 * radius_ + 2.0 * size;
    });
  }

  double draw(std::uint64_t thing, std::uint64_t what) const {
    return uniform01(hash_key(seed_ ^ kThingSalt, thing, what));
  }

  /// A free place on the desk; nullopt after many tries: scanners all around, or a small desk.
  std::optional<Vec3d> free_place(std::uint64_t thing, double size) const {
    const double near = 1.1 * radius_ + 1.8 * size, far = desk_reach() - size;
    for (std::uint64_t attempt = 0; attempt < 64; ++attempt) {
      const double azimuth = kTurn * draw(thing, 16 + 2 * attempt);
      const double away = near + (far - near) * draw(thing, 17 + 2 * attempt);
      const Vec3d place(-away * std::sin(azimuth), desk_y_, -away * std::cos(azimuth));
      if (away >= near && !in_view(place, size)) return place;
    }
    return std::nullopt;
  }

  void add_thing(std::uint64_t thing) {
    const double size = 0.02 + 0.04 * draw(thing, 0);  // half its width
    const auto free = free_place(thing, size);
    if (!free) return;
    const Vec3d& place = *free;
    const Rgb color = kThingColors[thing % kThingColors.size()];
    const double height = size * (0.5 + 2.5 * draw(thing, 2));
    const auto shape = static_cast<int>(3.0 * draw(thing, 3));
    if (shape == 0) {
      const Vec3d half(size, 0.5 * height, size * (0.4 + 0.6 * draw(thing, 4)));
      add_box(mesh_, at_place(place + Vec3d(0, half.y(), 0), kTurn * draw(thing, 5)), half, color);
    } else if (shape == 1) {
      add_cylinder(mesh_, place, 0.8 * size, height, color);
    } else {
      add_ball(mesh_, place + Vec3d(0, size, 0), size, color);
    }
  }

  RoomOptions options_;
  double radius_, desk_y_, foot_y_;
  double wall_z_ = 0.0;
  std::vector<Vec3d> scanners_;
  std::uint64_t seed_;
  TriangleMesh mesh_;
};

}  // namespace

OptionTable describe(RoomOptions& o) {
  OptionTable table;
  table
      .choice("room", o.kind, {"none", "desk", "wall", "clutter"},
              "What stands around the turntable and does not turn: nothing, a desk under it, a "
              "wall behind it, too, or things lying about on the desk as well.")
      .number("foot", o.foot_m, Quantity::kLength, {0.0, 10.0},
              "From the underside of the platter to the desk.")
      .number("clutter", o.clutter, {0, 1000}, "How many things lie on the desk.");
  return table;
}

TriangleMesh make_room(const RoomOptions& options, const Vec3d& centre, double platter_radius_m,
                       double platter_thickness_m, std::span<const Vec3d> scanners,
                       std::uint64_t seed) {
  if (options.kind == RoomKind::kNone) return {};
  // The first scanner is in front of the wall, whatever its azimuth.
  const double yaw = scanners.empty() ? 0.0 : azimuth_of(scanners[0] - centre);
  const Pose T_world_room = at_place(centre, yaw);
  std::vector<Vec3d> placed;
  for (const Vec3d& p : scanners) placed.push_back(T_world_room.inverse() * p);
  TriangleMesh mesh =
      RoomBuilder(options, platter_radius_m, platter_thickness_m, std::move(placed), seed).build();
  for (Vec3f& p : mesh.vertices) p = (T_world_room * p.cast<double>()).cast<float>();
  return mesh;
}

TriangleMesh platter_body(double radius_m, double thickness_m) {
  TriangleMesh mesh;
  if (thickness_m <= 0.0) return mesh;
  mesh.name = "platter";
  add_band(mesh, Vec3d::Zero(), radius_m, -thickness_m, radius_m, 0.0, kPlatterSideColor);
  add_band(mesh, Vec3d::Zero(), 0.0, -thickness_m, radius_m, -thickness_m, kPlatterSideColor);
  return mesh;
}

}  // namespace turnscan
