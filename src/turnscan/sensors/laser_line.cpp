#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <turnscan/core/random.hpp>
#include <turnscan/sensors/laser_line.hpp>

namespace turnscan {

namespace {

constexpr double kReach = 3.0;      // sigmas of the line that are looked at
constexpr double kBlurReach = 4.0;  // sigmas of the image of a point
constexpr int kMaxPixels = 4096;    // no camera has more
constexpr double kFoot = 0.05;      // share of a peak's height where it ends
const double kHalfHeight = std::sqrt(8.0 * std::numbers::ln2);  // full width / sigma

double line_sigma_m(const NoiseModel& m) { return m.line_width_m / kHalfHeight; }

double blurred_px(const NoiseModel& m, double line_px) {
  return std::hypot(m.line_blur_px, line_px);
}

std::uint64_t cell(double value, double size) {
  const double place = std::clamp(std::floor(value / size), -9e18, 9e18);
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(place));
}

/// The pixels that the spots reach.
struct Column {
  double first = 0.0;
  std::vector<float> electrons;
};

Column empty_column(const NoiseModel& m, double focal_baseline, std::span<const LineSpot> spots) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const LineSpot& s : spots) {
    const double u = (focal_baseline - m.line_focal_px * s.beside_m) / s.z_m;
    low = std::min(low, u);
    high = std::max(high, u);
  }
  const double margin = kBlurReach * m.line_blur_px + 1.0;
  Column column;
  column.first = std::floor(low - margin);
  const double size = std::min(std::ceil(high + margin) - column.first + 1.0, double(kMaxPixels));
  column.electrons.assign(static_cast<std::size_t>(size), 0.0f);
  return column;
}

void add_spot(const NoiseModel& m, double focal_baseline, const LineSpot& spot, Column& column) {
  const double blur = m.line_blur_px;
  const double u = (focal_baseline - m.line_focal_px * spot.beside_m) / spot.z_m - column.first;
  // As much light as a pixel-filling source gives to the width that the strip has in the image.
  const double peak = spot.light * m.line_focal_px * spot.width_m / spot.z_m /
                      (blur * std::sqrt(2.0 * std::numbers::pi));
  const auto n = static_cast<double>(column.electrons.size());
  const auto begin = static_cast<std::size_t>(std::clamp(std::ceil(u - kBlurReach * blur), 0.0, n));
  const auto end = static_cast<std::size_t>(
      std::clamp(std::floor(u + kBlurReach * blur) + 1.0, double(begin), n));
  for (std::size_t i = begin; i < end; ++i) {
    const double off = (double(i) - u) / blur;
    column.electrons[i] += static_cast<float>(peak * std::exp(-0.5 * off * off));
  }
}

void expose(const NoiseModel& m, std::uint64_t key, Column& column) {
  for (std::size_t i = 0; i < column.electrons.size(); ++i) {
    const double mean = column.electrons[i];
    const double sigma = std::sqrt(mean + m.line_read_noise * m.line_read_noise);
    double n = std::max(std::round(mean + sigma * standard_normal(mix64(key ^ (i + 1)))), 0.0);
    if (m.line_full_well > 0.0) n = std::min(n, m.line_full_well);
    column.electrons[i] = static_cast<float>(n);
  }
}

/// Pixels about a top that are above foot.
struct Run {
  bool shoulder = false;  ///< has a higher pixel than the top: belongs to another one
  double light = 0.0, moment = 0.0;
};

Run run_around(std::span<const float> electrons, std::size_t top, double foot) {
  Run run;
  std::size_t begin = top, end = top + 1;
  while (begin > 0 && electrons[begin - 1] > foot) --begin;
  while (end < electrons.size() && electrons[end] > foot) ++end;
  for (std::size_t k = begin; k < end; ++k) {
    // Above the foot: a pixel that comes or goes with the noise then weighs nothing.
    const double light = electrons[k] - foot;
    run.shoulder |= electrons[k] > electrons[top];
    run.light += light;
    run.moment += double(k) * light;
  }
  return run;
}

double noise_floor(const NoiseModel& m) { return 3.0 * m.line_read_noise; }

}  // namespace

std::vector<double> line_strips_m(const NoiseModel& m) {
  const double sigma = line_sigma_m(m);
  if (!(sigma > 0.0)) return {0.0};
  const double grain = speckle_grain_m(m), span = 2.0 * kReach * sigma;
  const double wanted = grain > 0.0 ? std::ceil(span / grain) : 9.0;
  const int count = static_cast<int>(std::clamp(wanted, 9.0, 64.0));
  std::vector<double> strips;
  strips.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) strips.push_back(span * ((i + 0.5) / count - 0.5));
  return strips;
}

double line_profile(const NoiseModel& m, double beside_m) {
  const double sigma = line_sigma_m(m);
  if (!(sigma > 0.0)) return 1.0;
  const double off = beside_m / sigma;
  return std::exp(-0.5 * off * off);
}

double speckle_grain_m(const NoiseModel& m) {
  return m.line_aperture > 0.0 ? m.line_wavelength_m / (2.0 * m.line_aperture) : 0.0;
}

double speckle_factor(const NoiseModel& m, std::uint64_t seed, const Vec3d& p,
                      const Vec3d& to_camera) {
  const double grain = speckle_grain_m(m);
  if (!(grain > 0.0) || !(m.line_contrast > 0.0)) return 1.0;
  const double angle = m.line_aperture;
  const std::uint64_t place =
      hash_key(seed, cell(p.x(), grain), cell(p.y(), grain), cell(p.z(), grain));
  const std::uint64_t key = hash_key(place, cell(to_camera.x(), angle), cell(to_camera.y(), angle),
                                     cell(to_camera.z(), angle));
  // Fully developed speckle has exponential intensity (Goodman 2007).
  return 1.0 - m.line_contrast - m.line_contrast * std::log(uniform01(key));
}

std::optional<LinePeak> find_peak(std::span<const float> electrons, double threshold,
                                  double floor) {
  std::optional<LinePeak> best;
  double most = 0.0;
  const std::size_t n = electrons.size();
  for (std::size_t i = 0; i < n; ++i) {
    const float here = electrons[i];
    if (!(here > 0.0f) || here < threshold) continue;
    if ((i > 0 && electrons[i - 1] > here) || (i + 1 < n && electrons[i + 1] > here)) continue;
    const Run run = run_around(electrons, i, std::max(kFoot * here, floor));
    if (run.shoulder || !(run.light > most)) continue;
    most = run.light;
    best = LinePeak{run.moment / run.light, here};
  }
  return best;
}

std::optional<double> measure_line(const NoiseModel& m, double focal_baseline,
                                   std::span<const LineSpot> spots, std::uint64_t key) {
  if (spots.empty()) return std::nullopt;
  Column column = empty_column(m, focal_baseline, spots);
  for (const LineSpot& spot : spots) add_spot(m, focal_baseline, spot, column);
  expose(m, key, column);
  const auto peak = find_peak(column.electrons, m.line_threshold, noise_floor(m));
  if (!peak) return std::nullopt;
  const double u = column.first + peak->position_px;
  if (!(u > 0.0)) return std::nullopt;
  return focal_baseline / u;
}

double line_light(const NoiseModel& m, double z_m, double incidence_rad, double albedo) {
  // A fan of light: its line is as bright as it is near.
  return m.line_exposure * albedo * std::max(std::cos(incidence_rad), 0.0) / z_m;
}

double laser_line_sigma_m(const NoiseModel& m, double focal_baseline, double z_m,
                          double incidence_rad, double albedo) {
  const double line_px = m.line_focal_px * line_sigma_m(m) / z_m;
  const double image_px = blurred_px(m, line_px);
  const double peak = line_light(m, z_m, incidence_rad, albedo) * line_px / image_px;
  if (!(peak >= m.line_threshold) || !(focal_baseline > 0.0))
    return std::numeric_limits<double>::quiet_NaN();
  // The centre of gravity above a foot at +-half sigmas: by parts, the integral of x^2 g within
  // equals that of g above the foot.
  const double foot = std::clamp(noise_floor(m) / peak, kFoot, 0.9);
  const double half = std::sqrt(-2.0 * std::log(foot));
  const double whole = std::sqrt(2.0 * std::numbers::pi);
  const double above = whole * std::erf(half / std::numbers::sqrt2) - 2.0 * half * foot;
  const double speckle_m =
      whole / above * m.line_contrast *
      std::sqrt(speckle_grain_m(m) * line_sigma_m(m) / (4.0 * std::sqrt(std::numbers::pi)));
  const double speckle_px = m.line_focal_px * speckle_m / z_m;
  const double shot_px2 = image_px / (peak * above);
  const double read = m.line_read_noise / (peak * above);
  const double read_px2 = read * read * (2.0 / 3.0) * half * half * half * image_px;
  return z_m * z_m / focal_baseline * std::sqrt(speckle_px * speckle_px + shot_px2 + read_px2);
}

}  // namespace turnscan
