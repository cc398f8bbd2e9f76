#pragma once
// A platter's rim by maximum likelihood: from what each pixel about its outline sees, and from the
// depth of its wall.

#include <array>
#include <turnscan/turntable/detection/rim_labels.hpp>

namespace turnscan::detection {

/// How a sensor's pixels change from platter to background about the outline: an ordered probit
/// (McCullagh 1980). With d the distance within the outline in pixels and F the normal
/// distribution,
///   P(platter) = F((d - shift - band / 2) / spread),  P(background) = F((shift - band / 2 - d) /
///   spread), and what is between them is mixed.
struct EdgeResponse {
  double shift_px = 0.0;  ///< of the middle of the mixed pixels into the platter
  double band_px = 0.3;   ///< how wide they are
  double spread_px = 0.7;
  double bare_px = 0.0;  ///< more of the shift beside pixels without a return

  double shift_of(const RimPixel& pixel) const { return shift_px + (pixel.bare ? bare_px : 0.0); }
};

/// Normal equations of one step (Fisher scoring). Unknowns: center x, center y, radius, thickness,
/// shift, band, more of the shift where it is bare.
struct RimEquations {
  using Matrix = Eigen::Matrix<double, 7, 7>;
  using Vector = Eigen::Matrix<double, 7, 1>;
  static constexpr std::size_t kSectors = 24;
  Matrix information = Matrix::Zero();
  Vector score = Vector::Zero();
  /// Shares of the score by the bearing of the place: what is common to neighbours shows in them.
  std::array<Vector, kSectors> sector_score;
  double log_likelihood = 0.0;
  std::size_t edge_pixels = 0, wall_pixels = 0;

  RimEquations() { sector_score.fill(Vector::Zero()); }
  double explained = 0.0;  ///< sum over the edge's pixels of the probability of what they see
};

/// Everything that the likelihood is a function of.
struct RimData {
  const RimView& rays;
  std::vector<RimPixel> pixels;
  NoiseCorrelation noise;
  double empty_share = 0.0;  ///< of the pixels that do not see the platter, those without a return
  std::optional<double> radius_m;  ///< the platter's, if known
};

RimEquations linearise(const RimData& data, const RimModel& model, const EdgeResponse& edge);

/// Comparable between models: pixels far from the outline count as well, by the side of it that
/// they are on, and the depths of the disc as those of the wall.
double log_likelihood_of_all(const RimData& data, const RimModel& model, const EdgeResponse& edge);

}  // namespace turnscan::detection
