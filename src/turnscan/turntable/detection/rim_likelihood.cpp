#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <turnscan/core/angles.hpp>
#include <turnscan/turntable/detection/rim_likelihood.hpp>

namespace turnscan::detection {

namespace {

using Unknowns = RimEquations::Vector;

constexpr double kEdgeReach_px = 3.5;  // pixels beyond it are independent of the rim
constexpr double kOutliers = 0.02;     // share of pixels with random labels
constexpr double kWallHuber = 2.0;
constexpr double kPixelSigma_px = 0.1;  // of a pixel's viewing direction
constexpr double kRadiusSigma_m = 0.0005;
// Priors: hardly any for the thickness; for the mixed pixels, that the edge is among them.
constexpr double kThickness_m = 0.012, kThicknessSigma_m = 0.03;
// A filter extends the platter, which is nearer and brighter, into the background, and farther if
// that is so dark or distant that their mixture has no return.
constexpr double kFilterShift_px = -0.3, kFilterBare_px = -0.3;
constexpr double kFilterBareSigma_px = 0.4, kBareSigma_px = 0.06;
constexpr double kBand_px = 0.5, kBandSigma_px = 1.0, kBandLeast_px = 0.05;
constexpr double kShiftPerBand = 0.35, kShiftPerBlur = 0.25, kShiftLeast_px = 0.06;

double normal_cdf(double x) { return 0.5 * std::erfc(-x * std::numbers::sqrt2 / 2.0); }
double normal_pdf(double x) { return std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi); }

/// Probabilities of the three labels and their derivatives by the distance and the band's width.
struct LabelChances {
  std::array<double, 3> chance, by_distance, by_band;
};

LabelChances chances(const EdgeResponse& edge, double shift_px, double distance_px) {
  const double inner = (distance_px - shift_px - 0.5 * edge.band_px) / edge.spread_px;
  const double outer = (shift_px - 0.5 * edge.band_px - distance_px) / edge.spread_px;
  const double in = normal_cdf(inner), out = normal_cdf(outer);
  const double by_in = normal_pdf(inner) / edge.spread_px;
  const double by_out = normal_pdf(outer) / edge.spread_px;
  LabelChances c;
  c.chance = {out, std::max(0.0, 1.0 - in - out), in};
  c.by_distance = {-by_out, by_out - by_in, by_in};
  c.by_band = {-0.5 * by_out, 0.5 * (by_out + by_in), -0.5 * by_in};
  for (std::size_t k = 0; k < 3; ++k) {
    c.chance[k] = (1.0 - kOutliers) * c.chance[k] + kOutliers / 3.0;
    c.by_distance[k] *= 1.0 - kOutliers;
    c.by_band[k] *= 1.0 - kOutliers;
  }
  return c;
}

/// An empty pixel may be mixed or beyond: it is only known not to be the platter.
LabelChances without_mixed(LabelChances c) {
  c.chance[0] += c.chance[1];
  c.by_distance[0] += c.by_distance[1];
  c.by_band[0] += c.by_band[1];
  c.chance[1] = c.by_distance[1] = c.by_band[1] = 0.0;
  return c;
}

void add_score(const OutlineDistance& place, const Unknowns& score, RimEquations& out) {
  const double turn = place.bearing_rad / kTurn + 0.5;
  const auto sector = static_cast<std::size_t>(turn * double(RimEquations::kSectors));
  out.sector_score[std::min(sector, RimEquations::kSectors - 1)] += score;
  out.score += score;
}

void add_edge(const OutlineDistance& distance, const RimPixel& pixel, const EdgeResponse& edge,
              double weight, RimEquations& out) {
  const RimLabel label = pixel.label;
  LabelChances c = chances(edge, edge.shift_of(pixel), distance.px);
  if (label == RimLabel::kEmpty) c = without_mixed(c);
  const auto seen = label == RimLabel::kEmpty ? std::size_t{0} : static_cast<std::size_t>(label);
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(c.chance[k] > 0.0)) continue;
    Unknowns row;
    row << c.by_distance[k] * distance.gradient, -c.by_distance[k], c.by_band[k],
        pixel.bare ? -c.by_distance[k] : 0.0;
    out.information += weight * row * row.transpose() / c.chance[k];
    if (k == seen) add_score(distance, weight * row / c.chance[k], out);
  }
  out.log_likelihood += weight * std::log(c.chance[seen]);
  out.explained += c.chance[seen];
  ++out.edge_pixels;
}

/// Depth after the sensor's filter over the surfaces about a pixel, and its derivatives; nullopt if
/// one of them ends there.
std::optional<SurfaceDepth> filtered(const RimData& data, const RimModel& model,
                                     const RimPixel& pixel) {
  const int reach = data.noise.blur_px;
  SurfaceDepth sum;
  double weights = 0.0;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const auto s = data.rays.surface(model, pixel.column + dx, pixel.row + dy);
      if (!s) return std::nullopt;
      // Surface that faces the sensor reflects more light.
      sum.z_m += s->facing * s->z_m;
      sum.gradient += s->facing * s->gradient;
      sum.per_pixel_m += s->facing * s->per_pixel_m;
      sum.wall = sum.wall || s->wall;
      weights += s->facing;
    }
  }
  if (!(weights > 0.0)) return std::nullopt;
  sum.z_m /= weights;
  sum.gradient /= weights;
  sum.per_pixel_m /= weights;
  return sum;
}

double depth_sigma(const RimData& data, const SurfaceDepth& depth) {
  return std::hypot(data.noise.sigma_m, kPixelSigma_px * depth.per_pixel_m);
}
double huber(double size) {
  return size > kWallHuber ? kWallHuber * (size - 0.5 * kWallHuber) : 0.5 * size * size;
}

void add_wall(const RimData& data, const RimModel& model, const RimPixel& pixel,
              const OutlineDistance& place, RimEquations& out) {
  const auto depth = filtered(data, model, pixel);
  if (!depth || !depth->wall) return;
  const double sigma = depth_sigma(data, *depth);
  const double error = (pixel.z_m - depth->z_m) / sigma, size = std::abs(error);
  const double weight =
      (size > kWallHuber ? kWallHuber / size : 1.0) / data.noise.pixels_per_sample;
  Unknowns row = Unknowns::Zero();
  row.head<4>() = depth->gradient / sigma;
  out.information += weight * row * row.transpose();
  add_score(place, weight * error * row, out);
  out.log_likelihood -= huber(size) / data.noise.pixels_per_sample;
  ++out.wall_pixels;
}

void add_prior(RimEquations& out, int unknown, double value, double expected, double sigma) {
  const double off = (value - expected) / sigma;
  out.information(unknown, unknown) += 1.0 / (sigma * sigma);
  out.score[unknown] -= off / sigma;
  out.log_likelihood -= 0.5 * off * off;
}

void add_priors(const RimData& data, const RimModel& model, const EdgeResponse& edge,
                RimEquations& out) {
  if (data.radius_m) add_prior(out, 2, model.radius_m, *data.radius_m, kRadiusSigma_m);
  add_prior(out, 3, model.thickness_m, kThickness_m, kThicknessSigma_m);
  const double shift =
      std::hypot(kShiftPerBand * edge.band_px, kShiftPerBlur * data.noise.blur_px, kShiftLeast_px);
  // Without a background, only the inner end of the band is observed.
  const double behind = 1.0 - data.empty_share;
  const bool filter = data.noise.blur_px > 0;
  add_prior(out, 4, edge.shift_px, filter ? kFilterShift_px : 0.0, shift);
  add_prior(out, 6, edge.bare_px, filter ? kFilterBare_px : 0.0,
            filter ? kFilterBareSigma_px : kBareSigma_px);
  add_prior(out, 5, edge.band_px, kBand_px * behind, kBandSigma_px * behind + kBandLeast_px);
}

/// Pixels inside the outline by this much are not mixed with the background.
double inner_margin(const RimData& data) { return 0.5 + 2.0 * data.noise.blur_px; }

/// A filter reduces as many pixels as it averages to one.
double edge_weight(const RimData& data) {
  const double joined = 2.0 * data.noise.blur_px + 1.0;
  return 1.0 / (joined * joined);
}

}  // namespace

RimEquations linearise(const RimData& data, const RimModel& model, const EdgeResponse& edge) {
  RimEquations out;
  const double margin = inner_margin(data), weight = edge_weight(data);
  for (const RimPixel& pixel : data.pixels) {
    const auto distance = data.rays.outline(model, pixel.column, pixel.row);
    if (!distance) continue;
    if (std::abs(distance->px) < kEdgeReach_px) add_edge(*distance, pixel, edge, weight, out);
    if (pixel.label == RimLabel::kPlatter && distance->px > margin)
      add_wall(data, model, pixel, *distance, out);
  }
  add_priors(data, model, edge, out);
  return out;
}

double log_likelihood_of_all(const RimData& data, const RimModel& model, const EdgeResponse& edge) {
  double sum = 0.0;
  for (const RimPixel& pixel : data.pixels) {
    const auto distance = data.rays.outline(model, pixel.column, pixel.row);
    if (!distance) continue;
    LabelChances c = chances(edge, edge.shift_of(pixel), distance->px);
    if (pixel.label == RimLabel::kEmpty) c = without_mixed(c);
    const bool empty = pixel.label == RimLabel::kEmpty;
    sum += edge_weight(data) *
           std::log(c.chance[empty ? std::size_t{0} : static_cast<std::size_t>(pixel.label)]);
    if (pixel.label != RimLabel::kPlatter || !(distance->px > inner_margin(data))) continue;
    if (const auto depth = filtered(data, model, pixel))
      sum -= huber(std::abs(pixel.z_m - depth->z_m) / depth_sigma(data, *depth)) /
             data.noise.pixels_per_sample;
  }
  RimEquations priors;
  add_priors(data, model, edge, priors);
  return sum + priors.log_likelihood;
}

}  // namespace turnscan::detection
