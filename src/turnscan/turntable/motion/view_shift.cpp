#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <turnscan/turntable/motion/view_shift.hpp>

namespace turnscan::motion {

namespace {

constexpr double kMinSlantCosine = 0.25;  // of incidence
constexpr double kMaxNoises = 6.0;        // more is a depth step
constexpr double kSamePlace_m = 0.005;    // between a sample and the surface at its pixel
constexpr std::size_t kMinCommon = 300, kSteps = 5;
/// Height of crests above the mean, in standard deviations of the relief, and the slope, as relief
/// over the pixels' spacing, from which on they hide all of the hollows (gears of 20 to 90 teeth).
constexpr double kCrestHeight = 2.0, kHidingSlope = 0.4;

/// Depth of a frame's pixel nearest to p beside its smoothed depth; nullopt where it was not
/// smoothed or shows other surface.
std::optional<double> relief_at(const MotionData& data, const MotionFrame& frame, const Vec3d& p) {
  const auto& level = frame.surface.T_camera_level;  // of both surfaces
  const Eigen::Vector2d uv = data.camera.project(level ? *level * p : p);
  const long column = std::lround(uv.x()), row = std::lround(uv.y());
  const auto at = [&](const FrameSurface& surface) {
    const long x = column - surface.left, y = row - surface.top;
    if (x < 0 || y < 0 || x >= surface.width || y >= surface.height) return 0.0;
    return double(surface.z[std::size_t(y) * std::size_t(surface.width) + std::size_t(x)]);
  };
  const double smooth = at(frame.surface), raw = at(frame.raw_surface);
  if (!(smooth > 0.0 && raw > 0.0) || smooth == raw || std::abs(smooth - p.z()) > kSamePlace_m ||
      std::abs(raw - smooth) > kMaxNoises * data.noise_m)
    return std::nullopt;
  return raw - smooth;
}

double cosine(const Vec3d& p, const Vec3d& n) { return -n.dot(p) / p.norm(); }

}  // namespace

double view_shift_sigma_m(const MotionData& data, const MotionState& state) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t k = 0; k + 1 < data.keys.size(); ++k) {
    // At several distances: teeth may come to lie between pixels after each step alike.
    const std::size_t here = data.keys[k],
                      there = data.keys[std::min(k + 1 + k % kSteps, data.keys.size() - 1)];
    const MotionFrame &from = data.frames[here], &to = data.frames[there];
    if (from.surface.z.empty() || to.surface.z.empty()) continue;
    const double turn = state.angle[there] - state.angle[here];
    const Eigen::Matrix3d R = Eigen::AngleAxisd(turn, state.axis).toRotationMatrix();
    for (const SurfaceSample& s : from.samples) {
      const Vec3d p = s.p.cast<double>(), n = s.n.cast<double>();
      const Vec3d q = state.center + R * (p - state.center);
      const double slant = cosine(p, n), other_slant = cosine(q, R * n);
      if (std::min(slant, other_slant) < kMinSlantCosine) continue;
      const auto one = relief_at(data, from, p);
      const auto other = one ? relief_at(data, to, q) : std::nullopt;
      if (!other) continue;
      sum += slant * *one * other_slant * *other;
      ++count;
    }
  }
  if (count < kMinCommon || !(sum > 0.0)) return 0.0;
  const double relief = std::sqrt(sum / double(count));
  return kCrestHeight * relief * std::min(1.0, relief / (kHidingSlope * data.spacing_m));
}

}  // namespace turnscan::motion
