#pragma once
// Signed distances of a surface to a reference, and their colours beside a tolerance.

#include <span>
#include <string>
#include <turnscan/core/image.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

/// Exact distance of each point to the reference, metres, negative inside it; NaN for points that
/// are not finite. The sign is that of PseudoNormals, right for a closed reference whose triangles
/// face outward. Fails with kFormat as validate_mesh(), kTooFewPoints (no triangle in the
/// reference), kCancelled.
Result<std::vector<float>> deviations_from(const TriangleMesh& reference,
                                           std::span<const Vec3f> points,
                                           const RunContext& context);

/// Light grey within the tolerance; outside it (too much material) from light orange to dark red at
/// range_m, inside it from light blue to dark blue at -range_m: hues that people with any common
/// form of colour blindness tell apart. Values that are not finite are mid grey.
Rgb deviation_color(double deviation_m, double tolerance_m, double range_m);

/// One line a point, in millimetres: x_mm,y_mm,z_mm,deviation_mm. Both have the same length.
std::string deviations_csv(std::span<const Vec3f> points, std::span<const float> deviations_m);

}  // namespace turnscan
