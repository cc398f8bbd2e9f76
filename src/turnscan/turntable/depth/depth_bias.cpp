#include <turnscan/core/figure_text.hpp>
#include <turnscan/turntable/depth/depth_bias.hpp>

namespace turnscan {

namespace {

constexpr double kApart_m = 0.05;  // minimum difference of distances for estimating a scale

}  // namespace

AveragedScan shifted(AveragedScan scan, double offset_m) {
  for (float& z : scan.depth_m.pixels) {
    if (z > 0.0f) z = std::max(0.0f, float(z + offset_m));
  }
  return scan;
}

Result<DepthGauge> gauge_depth(const AveragedScan& scan, double radius_m, double recorded_m,
                               const DetectOptions& options, const RunContext& context) {
  if (!(radius_m >= 0.01 && radius_m <= 10.0))
    return fail(ErrorCode::kInvalidOption, "depth bias: the radius {} m is not within 0.01 to 10 m",
                radius_m);
  DetectOptions free = options;
  free.radius_m.reset();
  free.min_radius_m = 0.8 * radius_m;
  free.max_radius_m = 1.25 * radius_m;
  double offset = 0.0;
  DetectedPlatter platter;
  for (int i = 0; i < 4; ++i) {
    TURNSCAN_ASSIGN(platter, detect_platter(shifted(scan, offset), free, context));
    if (std::abs(platter.radius_m / radius_m - 1.0) > 0.2)
      return fail(ErrorCode::kMissingData,
                  "depth bias: the platter looks {} large, not {}; check --platter-radius",
                  length_text(platter.radius_m), format_quantity(radius_m, Quantity::kLength));
    const double step = platter.center_m.z() * (radius_m / platter.radius_m - 1.0);
    offset += step;
    if (std::abs(step) < 2e-5) break;
  }
  DepthGauge out;
  out.offset_m = recorded_m + offset;
  out.depth_m = platter.center_m.z() - out.offset_m;
  out.sigma_m = platter.center_m.z() * platter.radius_sigma_m / radius_m;
  return out;
}

Result<DepthCorrection> fit_depth(std::span<const DepthGauge> gauges) {
  double least = 1e9, most = -1e9, weights = 0.0, z = 0.0, y = 0.0;
  for (const DepthGauge& g : gauges) {
    least = std::min(least, g.depth_m), most = std::max(most, g.depth_m);
    const double w = 1.0 / std::max(g.sigma_m * g.sigma_m, 1e-12);
    weights += w, z += w * g.depth_m, y += w * g.offset_m;
  }
  if (gauges.size() < 2 || !(most - least >= kApart_m))
    return fail(ErrorCode::kTooFewPoints,
                "depth scale: it needs the platter at two distances or more that lie {:.0f} mm "
                "apart; move the sensor nearer or away for another recording",
                kApart_m * 1e3);
  z /= weights, y /= weights;
  double zz = 0.0, zy = 0.0;
  for (const DepthGauge& g : gauges) {
    const double w = 1.0 / std::max(g.sigma_m * g.sigma_m, 1e-12);
    zz += w * (g.depth_m - z) * (g.depth_m - z);
    zy += w * (g.depth_m - z) * (g.offset_m - y);
  }
  DepthCorrection out;
  const double slope = zy / zz;
  out.scale = 1.0 + slope;
  out.bias_m = y - slope * z;
  out.scale_sigma = std::sqrt(1.0 / zz);
  out.bias_sigma_m = std::sqrt(1.0 / weights + z * z / zz);
  out.found = fmt::format("the platter's rim at {} distances", gauges.size());
  return out;
}

}  // namespace turnscan
