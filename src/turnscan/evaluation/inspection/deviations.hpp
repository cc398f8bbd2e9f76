#pragma once
// Signed distances of a surface to a reference, and their colours beside a tolerance.

#include <memory>
#include <span>
#include <string>
#include <turnscan/core/image.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

/// Answers one question after the other about a reference; from many threads.
class SignedDistance {
 public:
  /// Copies what it needs. Fails with kFormat as validate_mesh(), kTooFewPoints (no triangle).
  static Result<SignedDistance> to(const TriangleMesh& reference);
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
/// are not finite. The sign is that of PseudoNormals, right for a closed reference whose triangles
/// face outward. Fails with kFormat as validate_mesh(), kTooFewPoints (no triangle in the
/// reference), kCancelled.
Result<std::vector<float>> deviations_from(const TriangleMesh& reference,
                                           std::span<const Vec3f> points,
                                           const RunContext& context);

/// The same, of a reference that is asked more than once.
Result<std::vector<float>> deviations_from(const SignedDistance& reference,
                                           std::span<const Vec3f> points,
                                           const RunContext& context);

/// Of deviations that are finite.
struct DeviationFigures {
  std::size_t count = 0;
  double mean_m = 0.0, rms_m = 0.0, lowest_m = 0.0, highest_m = 0.0;
  double within = 0.0, above = 0.0, below = 0.0;  ///< shares in, over and under the tolerance
};
/// Each deviation counts with its weight (as surface_shares() gives them); without weights all
/// count the same. Weights must be as many, or none (std::invalid_argument). No finite deviation
/// with weight: zeros.
DeviationFigures deviation_figures(std::span<const float> deviations_m,
                                   std::span<const float> weights, double tolerance_m);
/// Shares by weight in `bins` bins of the same width from -range_m to range_m; what lies beyond
/// counts in the outermost.
std::vector<double> deviation_histogram(std::span<const float> deviations_m,
                                        std::span<const float> weights, double range_m,
                                        std::size_t bins);
/// The part of the surface that belongs to each vertex: a third of the triangles around it. Square
/// metres.
std::vector<float> surface_shares(const TriangleMesh& mesh);

/// Light grey within the tolerance; outside it (too much material) from light orange to dark red at
/// range_m, inside it from light blue to dark blue at -range_m: hues that people with any common
/// form of colour blindness tell apart. Values that are not finite are mid grey.
Rgb deviation_color(double deviation_m, double tolerance_m, double range_m);

/// One line a point, in millimetres: x_mm,y_mm,z_mm,deviation_mm. Both have the same length.
std::string deviations_csv(std::span<const Vec3f> points, std::span<const float> deviations_m);

}  // namespace turnscan
