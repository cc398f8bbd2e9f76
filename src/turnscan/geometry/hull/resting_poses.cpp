#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <turnscan/core/angles.hpp>
#include <turnscan/geometry/hull/convex_hull.hpp>
#include <turnscan/geometry/hull/resting_poses.hpp>
#include <turnscan/geometry/mesh/mesh_measure.hpp>

namespace turnscan {

namespace {

constexpr std::size_t kWays = 120;  // directions on a ring
constexpr std::array<double, 4> kRings_deg{2.0, 4.0, 8.0, 15.0};
constexpr double kFinest_rad = 0.002;
constexpr std::size_t kMaxCandidates = 400;  // the lowest ones, for round bodies

/// The corners of the hull relative to the centre of mass.
class HullBody {
 public:
  HullBody(const TriangleMesh& mesh, const std::vector<std::array<std::uint32_t, 3>>& faces,
           const Vec3d& center) {
    std::vector<std::uint32_t> corners;
    for (const auto& face : faces) corners.insert(corners.end(), face.begin(), face.end());
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    for (const std::uint32_t v : corners)
      corners_.push_back(mesh.vertices[v].cast<double>() - center);
  }

  /// Height of the centre of mass above the plane that the body touches in this direction.
  double height(const Vec3d& down) const {
    double most = 0.0;
    for (const Vec3d& p : corners_) most = std::max(most, down.dot(p));
    return most;
  }

  /// To roll away, the body has to cross each ring of tilts about a pose at its lowest point: along
  /// a valley in one direction for rolling bodies. 0 if all rings have a point that takes less than
  /// `enough`.
  double lift(const Vec3d& down, double enough) const {
    double most = 0.0;
    for (const double deg : kRings_deg)
      most = std::max(most, least_on_ring(down, deg * kRadiansPerDegree, enough));
    return most;
  }

 private:
  double least_on_ring(const Vec3d& down, double tilt_rad, double enough) const {
    constexpr double kStep = kTurn / kWays;
    const double height_m = height(down);
    const Vec3d across = down.unitOrthogonal(), beside = down.cross(across);
    const auto lifted = [&](double angle) {
      const Vec3d towards = std::cos(angle) * across + std::sin(angle) * beside;
      return height(std::cos(tilt_rad) * down + std::sin(tilt_rad) * towards) - height_m;
    };
    std::array<double, kWays> at{};
    for (std::size_t way = 0; way < kWays; ++way) {
      at[way] = lifted(double(way) * kStep);
      if (at[way] < enough) return 0.0;
    }
    double least = *std::min_element(at.begin(), at.end());
    for (std::size_t way = 0; way < kWays && least >= enough; ++way) {
      const bool valley =
          at[way] <= at[(way + 1) % kWays] && at[way] <= at[(way + kWays - 1) % kWays];
      if (valley)
        least = std::min(least, valley_floor(lifted, double(way) * kStep, kStep, at[way]));
    }
    return least < enough ? 0.0 : least;
  }

  template <class Lifted>
  static double valley_floor(const Lifted& lifted, double angle, double step, double least) {
    for (step *= 0.5; step > kFinest_rad; step *= 0.5) {
      const double middle = angle;
      for (const double beside : {middle - step, middle + step}) {
        const double there = lifted(beside);
        if (there < least) least = there, angle = beside;
      }
    }
    return least;
  }

  std::vector<Vec3d> corners_;
};

/// Whether the foot of the perpendicular from the origin is in the triangle, including its border,
/// since flat faces consist of several triangles.
bool holds_foot(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& normal) {
  const double tolerance = -1e-9;
  return normal.dot(a.cross(b)) >= tolerance * a.norm() * b.norm() &&
         normal.dot(b.cross(c)) >= tolerance * b.norm() * c.norm() &&
         normal.dot(c.cross(a)) >= tolerance * c.norm() * a.norm();
}

}  // namespace

Vec3d center_of_mass(const TriangleMesh& mesh) {
  const Vec3d middle = bounds(mesh.vertices).center();
  Vec3d moment = Vec3d::Zero();
  double volume = 0.0;  // times six
  for (const auto& t : mesh.triangles) {
    const Vec3d a = mesh.vertices[t[0]].cast<double>() - middle,
                b = mesh.vertices[t[1]].cast<double>() - middle,
                c = mesh.vertices[t[2]].cast<double>() - middle;
    const double part = a.dot(b.cross(c));
    volume += part;
    moment += part * (a + b + c) / 4.0;
  }
  return volume > 0.0 ? Vec3d(middle + moment / volume) : middle;
}

std::optional<Vec3d> tipping_direction(const Vec3d& center_of_mass, std::span<const Vec3f> contacts,
                                       double tolerance_m) {
  std::vector<double> angles;
  for (const Vec3f& contact : contacts) {
    const double x = contact.x() - center_of_mass.x(), z = contact.z() - center_of_mass.z();
    if (std::hypot(x, z) <= tolerance_m) return std::nullopt;
    angles.push_back(std::atan2(z, x));
  }
  std::sort(angles.begin(), angles.end());
  double widest = 0.0, middle = 0.0;
  for (std::size_t n = 0; n < angles.size(); ++n) {
    const bool last = n + 1 == angles.size();
    const double gap = (last ? angles[0] + 2.0 * std::numbers::pi : angles[n + 1]) - angles[n];
    if (gap > widest) widest = gap, middle = angles[n] + 0.5 * gap;
  }
  if (!angles.empty() && widest < std::numbers::pi) return std::nullopt;
  return Vec3d(std::cos(middle), 0.0, std::sin(middle));
}

std::vector<RestingPose> resting_poses(const TriangleMesh& mesh, const RestingOptions& options) {
  const auto faces = convex_hull(mesh.vertices);
  if (faces.empty() || !(signed_volume(mesh) > 0.0)) return {};
  const Vec3d center = center_of_mass(mesh);
  const HullBody body(mesh, faces, center);
  std::vector<RestingPose> found;
  for (const auto& face : faces) {
    const Vec3d a = mesh.vertices[face[0]].cast<double>() - center,
                b = mesh.vertices[face[1]].cast<double>() - center,
                c = mesh.vertices[face[2]].cast<double>() - center;
    const Vec3d normal = (b - a).cross(c - a).normalized();
    if (normal.dot(a) > 0.0 && holds_foot(a, b, c, normal))
      found.push_back({normal, body.height(normal), 0.0});
  }
  std::sort(found.begin(), found.end(), [](const RestingPose& one, const RestingPose& other) {
    return one.center_height_m < other.center_height_m;
  });
  if (found.size() > kMaxCandidates) found.resize(kMaxCandidates);
  std::vector<RestingPose> out;
  const double least_cosine = std::cos(options.least_apart_rad);
  for (RestingPose& pose : found) {
    const bool known = std::any_of(out.begin(), out.end(), [&](const RestingPose& other) {
      return pose.down.dot(other.down) > least_cosine;
    });
    if (known) continue;
    pose.lift_m = body.lift(pose.down, options.min_lift_m);
    if (pose.lift_m >= options.min_lift_m) out.push_back(pose);
  }
  return out;
}

}  // namespace turnscan
