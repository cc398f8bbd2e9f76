#include <turnscan/evaluation/inspection/alignment.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/search/closest_point.hpp>

namespace turnscan {

namespace {

constexpr double kReach = 0.05;  // relative to the size of the reference

Result<double> rms_to(const MeshDistance& reference, std::span<const Vec3f> points,
                      const Pose& pose, const RunContext& context) {
  std::vector<double> squares(points.size());
  TURNSCAN_TRY(parallel_for(points.size(), 1024, context, [&](std::size_t i) {
    const double away = reference.closest(pose * points[i].cast<double>()).distance;
    squares[i] = away * away;
  }));
  double sum = 0.0;
  for (const double square : squares) sum += square;
  return std::sqrt(sum / double(std::max<std::size_t>(1, points.size())));
}

}  // namespace

Result<Alignment> align_to(std::span<const Vec3f> points, const TriangleMesh& reference,
                           const RunContext& context) {
  const double size = bounds(reference.vertices).size().norm();
  IcpOptions options;
  options.max_distance_m = std::max(1e-4, kReach * size);
  options.max_shift_m = std::max(1e-3, 0.25 * size);
  options.max_iterations = 200;
  Alignment out;
  TURNSCAN_ASSIGN(out.icp, icp(points, reference, Pose::Identity(), options, context));
  const Pose& pose = out.icp.T_target_source;
  TURNSCAN_ASSIGN(const MeshDistance distance, MeshDistance::create(reference, context));
  TURNSCAN_ASSIGN(out.rms_before_m, rms_to(distance, points, Pose::Identity(), context));
  TURNSCAN_ASSIGN(out.rms_after_m, rms_to(distance, points, pose, context));
  if (out.rms_after_m > out.rms_before_m) {
    return fail(ErrorCode::kLibrary,
                "align: the model would lie farther from the reference than now (rms {:.3f} mm, "
                "now {:.3f} mm); lay it nearer to its place first",
                1e3 * out.rms_after_m, 1e3 * out.rms_before_m);
  }
  out.turned_rad = Eigen::AngleAxisd(pose.linear()).angle();
  Vec3d middle = Vec3d::Zero();
  for (const Vec3f& p : points) middle += p.cast<double>() / double(points.size());
  out.moved_m = (pose * middle - middle).norm();
  return out;
}

std::string alignment_text(const Alignment& a) {
  std::string text = fmt::format(
      "Moved {:.3f} mm, turned {:.3f}°. Rms of all points {:.3f} mm, before {:.3f} mm; of the "
      "{:.0f} "
      "% nearest to their planes {:.3f} mm, after {} steps.",
      1e3 * a.moved_m, a.turned_rad * kDegreesPerRadian, 1e3 * a.rms_after_m, 1e3 * a.rms_before_m,
      100.0 * IcpOptions().keep * a.icp.overlap, 1e3 * a.icp.rms_m, a.icp.iterations);
  if (a.icp.held_directions > 0)
    text += fmt::format(
        " {} of 6 directions are not determined by the shape; the model stayed where it was in "
        "them.",
        a.icp.held_directions);
  return text;
}

PointCloud moved(PointCloud cloud, const Pose& pose) {
  for (Vec3f& p : cloud.points) p = (pose * p.cast<double>()).cast<float>();
  for (Vec3f& n : cloud.normals) n = (pose.linear() * n.cast<double>()).cast<float>();
  return cloud;
}

}  // namespace turnscan
