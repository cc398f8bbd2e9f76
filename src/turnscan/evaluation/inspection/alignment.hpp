#pragma once
// Rigid alignment of a model with a reference.

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
  /// Distances of all sampled points to the reference, before and after, without exclusions.
  double rms_before_m = 0.0, rms_after_m = 0.0;
  double turned_rad = 0.0, moved_m = 0.0;  ///< moved: displacement of the points' centre
};

/// Iterative closest points starting at the model's current pose (geometry/registration, point to
/// plane). Searches for pairs within 5 % of the size of the reference. Fails as icp(), and with
/// kLibrary if the points would be farther from the reference than before.
Result<Alignment> align_to(std::span<const Vec3f> points, const TriangleMesh& reference,
                           const RunContext& context);

/// "moved 1.23 mm, turned 4.5°; rms 0.123 mm, before 1.234 mm; ..."
std::string alignment_text(const Alignment& alignment);

/// Transforms points and normals.
PointCloud moved(PointCloud cloud, const Pose& pose);

}  // namespace turnscan
