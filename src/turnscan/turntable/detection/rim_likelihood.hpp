#pragma once
// Likelihood of a platter's rim, from what each pixel near its outline sees and from the depth of
// its wall.

#include <array>
#include <turnscan/turntable/detection/rim_labels.hpp>

namespace turnscan::detection {

/// How the labels of a sensor's pixels change from platter to background across the outline: an
/// ordered probit (McCullagh 1980). With d the distance inside the outline in pixels and F the
/// normal distribution,
///   P(platter) = F((d - shift - band / 2) / spread),
///   P(background) = F((shift - band / 2 - d) / spread),
/// and the remaining probability is that of a mixed pixel.
struct EdgeResponse {
  double shift_px = 0.0;  ///< offset of the middle of the mixed pixels into the platter
  double band_px = 0.3;   ///< width of the band of mixed pixels
  double spread_px = 0.7;
  double bare_px = 0.0;  ///< additional shift beside pixels without a return

  double shift_of(const RimPixel& pixel) const { return shift_px + (pixel.bare ? bare_px : 0.0); }
};

/// Normal equations of one step (Fisher scoring). Unknowns: center x, center y, radius, thickness,
/// shift, band, additional shift of bare pixels.
struct RimEquations {
  using Matrix = Eigen::Matrix<double, 7, 7>;
  using Vector = Eigen::Matrix<double, 7, 1>;
  static constexpr std::size_t kSectors = 24;
  Matrix information = Matrix::Zero();
  Vector score = Vector::Zero();
  /// Contributions to the score by bearing; neighbours' common errors show in them.
  std::array<Vector, kSectors> sector_score;
  double log_likelihood = 0.0;
  std::size_t edge_pixels = 0, wall_pixels = 0;

  RimEquations() { sector_score.fill(Vector::Zero()); }
  double explained = 0.0;  ///< sum over the edge's pixels of the probability of their labels
};

/// Everything on which the likelihood depends.
struct RimData {
  const RimView& rays;
  std::vector<RimPixel> pixels;
  NoiseCorrelation noise;
  double empty_share = 0.0;        ///< share of the pixels off the platter that have no return
  std::optional<double> radius_m;  ///< the platter's, if known
};

RimEquations linearise(const RimData& data, const RimModel& model, const EdgeResponse& edge);

/// Log-likelihood that is comparable between models: pixels far from the outline count as well, by
/// the side of it that they are on, and depths of the disc count like those of the wall.
double log_likelihood_of_all(const RimData& data, const RimModel& model, const EdgeResponse& edge);

}  // namespace turnscan::detection
