#pragma once
// A turning platter before a virtual depth camera, with things made by formula: what the volumetric
// method's tests reconstruct.

#include <gtest/gtest.h>

#include <functional>
#include <tests/support/memory_sequence.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan::testing {

/// Distance along a ray (from the table frame's origin o, direction d) to what stands there, or 0.
using Trace = std::function<double(const Vec3d& o, const Vec3d& d)>;

double to_ball(const Vec3d& o, const Vec3d& d, const Vec3d& center, double radius);
double to_box(const Vec3d& o, const Vec3d& d, const Vec3d& low, const Vec3d& high);

/// Of two hits.
double nearer(double a, double b);

struct Rig {
  int frames = 24;
  double noise_m = 0.0005;
  double flying = 0.0;  ///< share of silhouette pixels that are moved back by up to 80 mm
  double dropped = 0.0;
  std::uint64_t seed = 1;
  bool platter = true;
};

/// Depth images, 160 x 120, of things on a turning platter, from 0.6 m away and 25 degrees up.
MemorySequence scan(const Trace& things, const Rig& rig);

/// Profiles of a line scanner whose upright sheet of light holds the axis: one every 3 degrees,
/// their points in no order.
MemorySequence line_scan(const Trace& things);

/// What a sequence of scan() saw above the platter.
std::vector<views::DepthView> views_of(const MemorySequence& sequence);

inline const Vec3d kCenter(0.01, 0.05, -0.005);
inline constexpr double kRadius = 0.03;
/// A ball on a stand, so that it is closed below by what is seen.
double ball(const Vec3d& o, const Vec3d& d);
/// Median distance of the vertices of its upper half from it.
double median_error_to_ball(const TriangleMesh& mesh);

/// Closed, 2-manifold and of positive volume, told from the triangles alone: every edge runs once
/// each way, and the triangles around every vertex are one ring.
::testing::AssertionResult is_solid(const TriangleMesh& mesh);

/// Options of the method.
ReconstructOptions volumetric();

}  // namespace turnscan::testing
