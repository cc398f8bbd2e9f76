#include <turnscan/turntable/depth_bias.hpp>

namespace turnscan {

AveragedScan shifted(AveragedScan scan, double offset_m) {
  for (float& z : scan.depth_m.pixels) {
    if (z > 0.0f) z = std::max(0.0f, float(z + offset_m));
  }
  return scan;
}

Result<DepthCorrection> estimate_depth_bias(const AveragedScan& scan, double radius_m,
                                            double recorded_m, const DetectOptions& options,
                                            const RunContext& context) {
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
                  format_quantity(platter.radius_m, Quantity::kLength),
                  format_quantity(radius_m, Quantity::kLength));
    const double step = platter.center_m.z() * (radius_m / platter.radius_m - 1.0);
    offset += step;
    if (std::abs(step) < 2e-5) break;
  }
  DepthCorrection out;
  out.bias_m = recorded_m + offset;
  out.bias_sigma_m = platter.center_m.z() * platter.radius_sigma_m / radius_m;
  out.found = fmt::format("the platter's rim, whose radius is {}",
                          format_quantity(radius_m, Quantity::kLength));
  return out;
}

}  // namespace turnscan
