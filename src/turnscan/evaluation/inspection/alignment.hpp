#pragma once
// A model moved rigidly onto a reference.

#include <span>
#include <string>
#include <turnscan/core/point_cloud.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/geometry/registration/registration.hpp>

namespace turnscan {

struct Alignment {
  IcpResult icp;  ///< rms point to plane, share of the points with a partner
  /// Of all sampled points to the reference, before and after, without any left out.
  double rms_before_m = 0.0, rms_after_m = 0.0;
  double turned_rad = 0.0, moved_m = 0.0;  ///< moved: of the middle of the points
};

/// Iterative closest points from where the model lies now (geometry/registration, point to plane).
/// Pairs are sought within 5 % of the size of the reference. Fails as icp(), and with kLibrary when
/// the points would then lie farther from the reference than before.
Result<Alignment> align_to(std::span<const Vec3f> points, const TriangleMesh& reference,
                           const RunContext& context);

/// "moved 1.23 mm, turned 4.5°; rms 0.123 mm, before 1.234 mm; ..."
std::string alignment_text(const Alignment& alignment);

/// Moves places and normals.
PointCloud moved(PointCloud cloud, const Pose& pose);

}  // namespace turnscan
