#pragma once
// Merged clouds with known truth, for tests of the stages.

#include <numbers>
#include <turnscan/core/random.hpp>
#include <turnscan/reconstruction/voxels/merge.hpp>
#include <turnscan/reconstruction/voxels/point_sums.hpp>

namespace turnscan::testing {

/// Noisy points on the plane y = height, seen from straight above and from two slanted sensors.
/// Noise is along the ray, as in a depth camera.
inline voxels::MergedCloud noisy_plane(std::size_t n, double half_m, double sigma_m,
                                       double height_m = 0.0) {
  voxels::MergedCloud merged;
  merged.viewpoints = {
      {Vec3d(0, 1, 0), false}, {Vec3d(0.5, 0.8, 0), false}, {Vec3d(0, 0.8, 0.5), false}};
  for (std::uint64_t i = 0; i < n; ++i) {
    const Vec3d p((2 * uniform01(hash_key(1, i, 0)) - 1) * half_m, height_m,
                  (2 * uniform01(hash_key(1, i, 1)) - 1) * half_m);
    const std::uint32_t f = i % 3;
    const Vec3d along = merged.viewpoints[f].direction_from(p);
    merged.cloud.points.push_back(
        (p + sigma_m * standard_normal(hash_key(2, i)) * along).cast<float>());
    merged.cloud.frame.push_back(f);
  }
  return merged;
}

/// Noisy points on a sphere around the origin, each seen by one of 36 sensors around it.
inline voxels::MergedCloud noisy_sphere(std::size_t n, double radius_m, double sigma_m) {
  voxels::MergedCloud merged;
  for (int f = 0; f < 36; ++f) {
    const double a = f * std::numbers::pi / 6.0, e = (f / 12 - 1) * 0.9;
    merged.viewpoints.push_back(
        {Vec3d(std::cos(a) * std::cos(e), std::sin(e), std::sin(a) * std::cos(e)), false});
  }
  for (std::uint64_t i = 0; merged.cloud.size() < n; ++i) {
    const double z = 2 * uniform01(hash_key(3, i, 0)) - 1;
    const double a = 2 * std::numbers::pi * uniform01(hash_key(3, i, 1));
    const double r = std::sqrt(1 - z * z);
    const Vec3d normal(r * std::cos(a), z, r * std::sin(a));
    const std::uint32_t f = mix64(i) % 36;
    const Vec3d p = radius_m * normal;
    const Vec3d along = merged.viewpoints[f].direction_from(p);
    if (along.dot(normal) < 0.3) continue;
    merged.cloud.points.push_back(
        (p + sigma_m * standard_normal(hash_key(4, i)) * along).cast<float>());
    merged.cloud.frame.push_back(f);
  }
  return merged;
}

/// The points of a cloud, frame by frame.
struct Frames {
  std::vector<PointCloud> clouds;
  std::vector<Viewpoint> viewpoints;

  explicit Frames(const voxels::MergedCloud& merged)
      : clouds(merged.viewpoints.size()), viewpoints(merged.viewpoints) {
    for (std::size_t i = 0; i < merged.cloud.size(); ++i) {
      PointCloud& cloud = clouds[merged.cloud.frame[i]];
      cloud.points.push_back(merged.cloud.points[i]);
      if (!merged.cloud.colors.empty()) cloud.colors.push_back(merged.cloud.colors[i]);
    }
  }
  std::vector<voxels::PointsSeen> seen() const {
    std::vector<voxels::PointsSeen> out;
    for (std::size_t f = 0; f < clouds.size(); ++f)
      out.push_back({clouds[f].points, clouds[f].colors, viewpoints[f]});
    return out;
  }
};

inline voxels::MeasuredCells measured(const voxels::MergedCloud& merged, double voxel_m,
                                      const CandidateOptions& options = {}) {
  voxels::PointSums sums(voxel_m, options);
  const Frames frames(merged);
  if (!sums.add(frames.seen())) return {};
  return std::move(*sums.collect(1, RunContext()));
}

}  // namespace turnscan::testing
