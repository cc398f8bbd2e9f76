#pragma once
// Signed distances of a surface to a reference, and their colours relative to a tolerance.

#include <memory>
#include <span>
#include <string>
#include <turnscan/core/image.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

/// Repeated distance queries to one reference, from many threads.
class SignedDistance {
 public:
  /// Copies what it needs. Fails with kFormat as validate_mesh(), kTooFewPoints (no triangle),
  /// kCancelled.
  static Result<SignedDistance> to(const TriangleMesh& reference, const RunContext& context);
  SignedDistance(SignedDistance&&) noexcept;
  SignedDistance& operator=(SignedDistance&&) noexcept;
  ~SignedDistance();

  /// As deviations_from().
  double at(const Vec3d& point) const;

 private:
  struct Impl;
  explicit SignedDistance(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Exact distance of each point to the reference, metres, negative inside it; NaN for points that
/// are not finite. The sign is that of PseudoNormals, correct for a closed reference whose
/// triangles face outward. Fails with kFormat as validate_mesh(), kTooFewPoints (no triangle in the
/// reference), kCancelled.
Result<std::vector<float>> deviations_from(const TriangleMesh& reference,
                                           std::span<const Vec3f> points,
                                           const RunContext& context);

/// The same for repeated use of a reference.
Result<std::vector<float>> deviations_from(const SignedDistance& reference,
                                           std::span<const Vec3f> points,
                                           const RunContext& context);

/// Statistics of the finite deviations.
struct DeviationFigures {
  std::size_t count = 0;
  double mean_m = 0.0, rms_m = 0.0, lowest_m = 0.0, highest_m = 0.0;
  double within = 0.0, above = 0.0, below = 0.0;  ///< shares within, over and under the tolerance
};
/// Each deviation is weighted (see surface_shares()); without weights all count equally. The number
/// of weights must match, or be 0 (std::invalid_argument). Without a finite deviation with weight:
/// zeros.
DeviationFigures deviation_figures(std::span<const float> deviations_m,
                                   std::span<const float> weights, double tolerance_m);
/// Shares by weight in `bins` bins of equal width from -range_m to range_m; values beyond count in
/// the outermost bins.
std::vector<double> deviation_histogram(std::span<const float> deviations_m,
                                        std::span<const float> weights, double range_m,
                                        std::size_t bins);
/// The surface area of each vertex: a third of the triangles around it. Square metres.
std::vector<float> surface_shares(const TriangleMesh& mesh);

/// Light grey within the tolerance; outside it (too much material) from light orange to dark red at
/// range_m, inside it from light blue to dark blue at -range_m: hues that are distinguishable with
/// any common form of colour blindness. Values that are not finite are mid grey.
Rgb deviation_color(double deviation_m, double tolerance_m, double range_m);

/// One line per point, in millimetres: x_mm,y_mm,z_mm,deviation_mm. Both spans have the same
/// length.
std::string deviations_csv(std::span<const Vec3f> points, std::span<const float> deviations_m);

}  // namespace turnscan
