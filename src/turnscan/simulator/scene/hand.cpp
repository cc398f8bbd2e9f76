#include <algorithm>
#include <array>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/rotation_between.hpp>
#include <turnscan/simulator/scene/hand.hpp>

namespace turnscan {

namespace {

constexpr Rgb kSkinColor{206, 160, 132};
constexpr Rgb kSleeveColor{58, 74, 110};
constexpr double kReach_m = 1.2;        // from outside the view to above the platter
constexpr double kRise_m = 0.15;        // on the way out
constexpr double kSway_m = 0.015;       // to each side
constexpr double kShareOfWay = 0.3;     // of the time, in each direction
constexpr double kDefaultHeight = 0.1;  // above the platter, without an object

/// A capsule from a to b whose radius changes from ra to rb.
void add_capsule(TriangleMesh& mesh, const Vec3d& a, const Vec3d& b, double ra, double rb,
                 Rgb color) {
  constexpr std::uint32_t kRings = 6, kAround = 24;  // of each cap
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const Eigen::Quaterniond R = rotation_between(Vec3d::UnitZ(), b - a);
  for (std::uint32_t ring = 0; ring <= 2 * kRings + 1; ++ring) {
    const bool at_a = ring <= kRings;
    const double polar = 0.25 * kTurn * (at_a ? ring : ring - 1) / kRings;
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const double around = kTurn * k / kAround;
      const Vec3d out(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around),
                      -std::cos(polar));
      mesh.vertices.push_back(((at_a ? a : b) + (at_a ? ra : rb) * (R * out)).cast<float>());
      mesh.colors.push_back(color);
    }
  }
  for (std::uint32_t ring = 0; ring < 2 * kRings + 1; ++ring) {
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const std::uint32_t p = first + ring * kAround + k;
      const std::uint32_t q = first + ring * kAround + (k + 1) % kAround;
      mesh.triangles.push_back({p, p + kAround, q});
      mesh.triangles.push_back({q, p + kAround, q + kAround});
    }
  }
}

double smooth(double x) { return x * x * (3.0 - 2.0 * x); }

/// Its distance relative to its reach, at a fraction of its time.
double away(double share) {
  return smooth(std::clamp(std::max(kShareOfWay - share, share - (1.0 - kShareOfWay)) / kShareOfWay,
                           0.0, 1.0));
}

}  // namespace

OptionTable describe(HandOptions& o) {
  OptionTable table;
  table
      .number("hand-at", o.at_s, Quantity::kTime, {0.0, 1e5},
              "When a hand starts to reach over the object, if hand is given.")
      .number("hand", o.duration_s, Quantity::kTime, {0.0, 1e5},
              "How long it takes until the hand is gone again; it does not turn with the platter.")
      .number("hand-direction", o.direction_rad, Quantity::kAngle, {-2.0 * kTurn, 2.0 * kTurn},
              "From where it comes, around the table as the azimuth of a scanner.")
      .number("hand-height", o.height_m, Quantity::kLength, {0.0, 10.0},
              "Height of the palm above the platter; auto: 40 mm above the object.");
  return table;
}

TriangleMesh make_hand() {
  TriangleMesh mesh;
  mesh.name = "hand";
  for (const double x : {-0.033, -0.011, 0.011, 0.033}) {
    const double length = std::abs(x) < 0.02 ? 0.12 : 0.105;
    add_capsule(mesh, {x, 0.0, -0.04}, {0.8 * x, 0.0, 0.05}, 0.013, 0.015, kSkinColor);
    add_capsule(mesh, {x, 0.0, -0.04}, {1.2 * x, -0.012, -length}, 0.01, 0.008, kSkinColor);
  }
  add_capsule(mesh, {-0.04, -0.005, 0.03}, {-0.075, -0.02, -0.035}, 0.012, 0.01, kSkinColor);
  const Vec3d wrist(0.0, 0.005, 0.06), elbow(0.0, 0.06, 0.32), shoulder(0.05, 0.28, 0.62);
  add_capsule(mesh, wrist, elbow, 0.027, 0.042, kSkinColor);
  add_capsule(mesh, elbow, shoulder, 0.045, 0.055, kSleeveColor);
  return mesh;
}

std::optional<Pose> hand_pose(const HandOptions& hand, const Vec3d& centre, double time_s) {
  const double share = (time_s - hand.at_s) / hand.duration_s;
  if (!hand.happens() || share < 0.0 || share >= 1.0) return std::nullopt;
  // Azimuth 0 is -Z, and the arm is on the side of +Z.
  Pose T = rotation_about_y(hand.direction_rad + 0.5 * kTurn);
  const double out = away(share);
  T.translation() =
      centre + T.linear() * Vec3d(kSway_m * std::sin(kTurn * share),
                                  hand.height_m.value_or(kDefaultHeight) + kRise_m * out,
                                  kReach_m * out);
  return T;
}

}  // namespace turnscan
