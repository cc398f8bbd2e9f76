#include <algorithm>
#include <turnscan/reconstruction/first_look.hpp>
#include <turnscan/reconstruction/scan_statistics.hpp>

namespace turnscan {

namespace {

std::string mm(double metres) { return format_quantity(metres, Quantity::kLength); }

bool cropped(const SequenceHeader& header, const CropOptions& crop) {
  return crop.enabled && (header.turntable || crop.radius_m);
}

std::optional<double> known_radius(const SequenceHeader& header, const CropOptions& crop) {
  return crop.radius_m || !header.turntable ? crop.radius_m : header.turntable->radius_m;
}

/// Roughly the object and its noise, not the platter.
Cylinder rough_cylinder(const SequenceHeader& header, const CropOptions& crop) {
  Cylinder rough;
  rough.margin_m = crop.margin_m.value_or(0.003);
  rough.radius_m = known_radius(header, crop).value_or(1e3);
  rough.height_m = crop.height_m;
  return rough;
}

void choose_crop(const std::vector<Vec3f>& sample, const SequenceHeader& header,
                 const CropOptions& crop, FirstLook& look) {
  Cylinder cylinder;
  cylinder.height_m = crop.height_m;
  const std::optional<double> known = known_radius(header, crop);
  const PlatterReturns platter = measure_platter(sample, std::min(known.value_or(0.5), 0.5));
  const auto found = known ? known : find_platter_radius(sample, platter);
  if (found) {
    look.choices.push_back({"crop-radius", mm(*found),
                            crop.radius_m ? "given"
                            : known       ? "the platter's radius"
                                          : "where the returns of the platter end"});
  } else {
    look.notes.emplace_back(
        "the platter's radius is not known and its edge was not found: nothing is "
        "cropped sideways; give --crop-radius");
  }
  cylinder.radius_m = found.value_or(1e3);
  double margin = std::max(0.002, 4.0 * look.noise_m);
  std::string reason = fmt::format("4 times the sensor's noise of {}", mm(look.noise_m));
  if (platter.count > 0) {
    margin = std::max(0.001, platter.height_m + 4.0 * platter.sigma_m);
    reason = fmt::format("the platter's returns lie at {} with a spread of {}; 4 spreads above",
                         mm(platter.height_m), mm(platter.sigma_m));
  }
  cylinder.margin_m = crop.margin_m.value_or(margin);
  look.choices.push_back(
      {"crop-margin", mm(cylinder.margin_m), crop.margin_m ? "given" : std::move(reason)});
  look.cylinder = cylinder;
}

}  // namespace

std::size_t frames_of_first_look(const SequenceHeader& header, const CropOptions& crop) {
  return !cropped(header, crop) || known_radius(header, crop) ? 32 : 128;
}

Result<FirstLook> look_at(std::span<const Frame> frames, std::span<const Pose> poses,
                          const SequenceHeader& header, const std::vector<RayTable>& rays,
                          const CropOptions& crop_options) {
  constexpr std::size_t kLooks = 12;
  const std::size_t looks = std::min(kLooks, frames.size());
  std::vector<double> spacing, noise;
  std::vector<Vec3f> sample;
  for (std::size_t k = 0; k < looks; ++k) {
    const std::size_t i = k * frames.size() / looks;
    const std::size_t s = frames[i].info.sensor;
    TURNSCAN_ASSIGN(FramePoints points, points_of(frames[i], header.sensors.at(s), rays.at(s)));
    for (const Vec3f& p : points.cloud.points) sample.push_back(poses[i].cast<float>() * p);
    if (cropped(header, crop_options))
      points = crop(points, SensorCrop(rough_cylinder(header, crop_options), poses[i]));
    if (points.cloud.size() < 10) continue;
    const FrameStatistics statistics = frame_statistics(points);
    spacing.push_back(statistics.spacing_m);
    noise.push_back(statistics.noise_m);
  }
  if (spacing.empty())
    return fail(ErrorCode::kTooFewPoints,
                "none of the frames looked at has 10 points on the object; check the turntable's "
                "place and --crop-margin, --crop-radius");
  FirstLook look;
  std::sort(spacing.begin(), spacing.end());
  std::sort(noise.begin(), noise.end());
  look.spacing_m = spacing[spacing.size() / 2];
  look.noise_m = noise[noise.size() / 2];
  // Rounding to the sensor's unit spreads depth by unit / sqrt(12) at least.
  for (const SensorInfo& sensor : header.sensors) {
    if (sensor.kind == SensorKind::kDepthCamera)
      look.noise_m = std::max(look.noise_m, sensor.depth_unit_m / std::sqrt(12.0));
  }
  if (cropped(header, crop_options)) choose_crop(sample, header, crop_options, look);
  return look;
}

}  // namespace turnscan
