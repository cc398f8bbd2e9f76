#include <turnscan/simulator/objects/object_makers.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <vector>

namespace turnscan::objects {

namespace {

constexpr Rgb kMattWhite{214, 214, 208};
constexpr int kArc = 144;               // segments of half a great circle
constexpr std::uint32_t kAround = 288;  // of a parallel

/// A point of a profile: how far along the axis, how far from it.
struct ProfilePoint {
  double along, radius;
};

/// Half a circle about (center, 0), from angle `begin` to `end`, 0 being the lower end of the axis.
void add_arc(std::vector<ProfilePoint>& profile, double center, double radius, double begin,
             double end) {
  const int n = std::max(1, static_cast<int>(std::lround(kArc * (end - begin) / (kTurn / 2))));
  for (int i = 0; i <= n; ++i) {
    const double angle = begin + (end - begin) * i / n;
    profile.push_back({center - radius * std::cos(angle), radius * std::sin(angle)});
  }
}

/// The closed surface of revolution of a profile about the x axis; its first and last point lie on
/// the axis.
TriangleMesh revolved(const std::vector<ProfilePoint>& profile) {
  TriangleMesh mesh;
  constexpr std::uint32_t n = kAround;
  const auto rings = static_cast<std::uint32_t>(profile.size() - 2);
  const auto ring = [](std::uint32_t r, std::uint32_t i) { return r * kAround + i % kAround; };
  for (std::uint32_t r = 0; r < rings; ++r) {
    const ProfilePoint& p = profile[r + 1];
    for (std::uint32_t i = 0; i < n; ++i) {
      const double angle = kTurn * i / n;
      mesh.vertices.push_back(
          Vec3d(p.along, p.radius * std::cos(angle), p.radius * std::sin(angle)).cast<float>());
    }
  }
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.emplace_back(float(profile.front().along), 0.0f, 0.0f);
  mesh.vertices.emplace_back(float(profile.back().along), 0.0f, 0.0f);
  for (std::uint32_t i = 0; i < n; ++i) {
    mesh.triangles.push_back({first, ring(0, i + 1), ring(0, i)});
    mesh.triangles.push_back({first + 1, ring(rings - 1, i), ring(rings - 1, i + 1)});
    for (std::uint32_t r = 0; r + 1 < rings; ++r) {
      mesh.triangles.push_back({ring(r, i), ring(r, i + 1), ring(r + 1, i + 1)});
      mesh.triangles.push_back({ring(r, i), ring(r + 1, i + 1), ring(r + 1, i)});
    }
  }
  return mesh;
}

TriangleMesh finished(TriangleMesh mesh, const char* name) {
  mesh = stand_on_platter(std::move(mesh));
  mesh.name = name;
  mesh.colors.assign(mesh.vertices.size(), kMattWhite);
  return mesh;
}

}  // namespace

TriangleMesh make_ball() {
  std::vector<ProfilePoint> profile;
  add_arc(profile, 0.0, GaugeBall::diameter_m / 2, 0.0, kTurn / 2);
  profile.front().radius = profile.back().radius = 0.0;
  return finished(revolved(profile), "ball");
}

TriangleMesh make_ball_bar() {
  using B = BallBar;
  const double radius = B::diameter_m / 2, half = B::spacing_m / 2;
  const double joint = std::asin(B::bar_diameter_m / B::diameter_m);
  std::vector<ProfilePoint> profile;
  add_arc(profile, -half, radius, 0.0, kTurn / 2 - joint);
  add_arc(profile, half, radius, joint, kTurn / 2);
  profile.front().radius = profile.back().radius = 0.0;
  return finished(revolved(profile), "ball-bar");
}

TriangleMesh make_plate() {
  using P = GaugePlate;
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(Vec3d(((i & 1) - 0.5) * P::width_m, (i >> 1 & 1) * P::height_m,
                                  ((i >> 2 & 1) - 0.5) * P::thickness_m)
                                .cast<float>());
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return finished(std::move(mesh), "plate");
}

}  // namespace turnscan::objects
