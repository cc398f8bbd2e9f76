#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <turnscan/core/image.hpp>
#include <turnscan/core/units.hpp>
#include <turnscan/recording/plausibility/finders.hpp>
#include <turnscan/sensors/scanner_file.hpp>

namespace turnscan::plausibility {

namespace {

/// Steps of depth images in the order in which they are met: most drivers; Kinects here and the
/// D405; TUM's benchmark; the SR300 and Open3D's older recorders.
constexpr std::array<double, 4> kDepthUnits_m{1e-3, 1e-4, 2e-4, 2.5e-4};
constexpr std::array<std::pair<double, const char*>, 5> kPointUnits{
    {{1.0, "m"}, {1e-3, "mm"}, {1e-2, "cm"}, {0.0254, "in"}, {1e-6, "um"}}};
/// The presets' ranges are those of use: the Kinect v1's drivers return depth from 0.8 of the
/// nearest to 2.5 of the farthest, and the D435's smallest images begin at half of it.
constexpr double kNearer = 0.8, kFarther = 2.5, kNearest = 0.4;
constexpr double kNearTenth = 0.1;
constexpr std::size_t kPixelStep = 7;
constexpr std::size_t kMostDistances = std::size_t(1) << 20;

struct DepthRange {
  double near_m, far_m;    ///< of use
  std::string whose;       ///< for people
  bool of_sensor = false;  ///< else of all sensors
};

void extend(std::optional<DepthRange>& range, const ScannerModel& preset) {
  if (!range) range = DepthRange{preset.near_m, preset.far_m, "any sensor", false};
  range->near_m = std::min(range->near_m, preset.near_m);
  range->far_m = std::max(range->far_m, preset.far_m);
}

/// nullopt where there are no presets.
std::optional<DepthRange> range_of(const std::string& model) {
  std::optional<DepthRange> all;
  for (const std::string& name : scanner_presets()) {
    const auto preset = find_scanner(name);
    if (!preset) continue;
    const bool same = model.ends_with(name) || (model.size() > 3 && name.ends_with(model));
    if (same) return DepthRange{preset->near_m, preset->far_m, "the " + name, true};
    if (preset->sensing != Sensing::kIdeal && preset->kind == ScannerKind::kMatrix)
      extend(all, *preset);
  }
  return all;
}

/// Distances of some of the returns, in units.
std::vector<double> distances_of(const SensorInfo& sensor, const std::vector<Frame>& frames) {
  std::size_t all = 0;
  for (const Frame& frame : frames) all += frame.depth.pixels.size() + frame.points.size();
  const std::size_t step = std::max(kPixelStep, all / kMostDistances | 1);
  std::vector<double> out;
  for (const Frame& frame : frames) {
    for (std::size_t i = 0; i < frame.depth.pixels.size(); i += step) {
      const std::uint16_t raw = frame.depth.pixels[i];
      if (raw != kNoReturn && raw != kOutsideCrop) out.push_back(raw);
    }
    for (std::size_t i = 0; i < frame.points.size(); i += step)
      out.push_back((frame.points.points[i].cast<double>() - sensor.viewpoint.value).norm());
  }
  return out;
}

/// The distance that this share of the returns is nearer than; 0 if there are none.
double quantile(std::vector<double>& distances, double share) {
  if (distances.empty()) return 0.0;
  const auto at = distances.begin() + std::ptrdiff_t(share * double(distances.size()));
  std::nth_element(distances.begin(), at, distances.end());
  return *at;
}

/// The first usual unit that fits, with what it makes of the distance; empty where none does.
std::string unit_that_fits(bool camera, double distance_m, double unit_m, const DepthRange& range) {
  const auto offer = [&](double other_m, const std::string& name) -> std::string {
    const double m = distance_m * other_m / unit_m;
    if (other_m == unit_m || m < kNearest * range.near_m || m > range.far_m) return "";
    return fmt::format(" (with {} it would be {:.2f} m)", name, m);
  };
  std::string out;
  for (std::size_t i = 0; camera && out.empty() && i < kDepthUnits_m.size(); ++i)
    out = offer(kDepthUnits_m[i], format_quantity(kDepthUnits_m[i], Quantity::kLength));
  for (std::size_t i = 0; !camera && out.empty() && i < kPointUnits.size(); ++i)
    out = offer(kPointUnits[i].first, kPointUnits[i].second);
  return out;
}

/// Scans of which only the direction is known from which they were seen.
void look_at_size(std::size_t number, const std::vector<Frame>& frames, Findings& out) {
  Vec3d sum = Vec3d::Zero();
  std::vector<Vec3d> points;
  for (const Frame& frame : frames)
    for (std::size_t i = 0; i < frame.points.size(); i += kPixelStep) {
      points.push_back(frame.points.points[i].cast<double>());
      sum += points.back();
    }
  std::vector<double> from_middle;
  for (const Vec3d& p : points) from_middle.push_back((p - sum / double(points.size())).norm());
  const double size_m = 2.0 * quantile(from_middle, 1.0 - kNearTenth);
  if (!(size_m > 0.0) || (size_m >= kSmallestObject_m && size_m <= kLargestObject_m)) return;
  out.push_back(
      {Plausibility::kImplausible,
       fmt::format("nine tenths of what sensor {} sees would be {:.3g} m across, and what "
                   "stands on a turntable is {} to {}: the unit is another one; state it "
                   "when importing, --point-unit{}",
                   number, size_m, format_quantity(kSmallestObject_m, Quantity::kLength),
                   format_quantity(kLargestObject_m, Quantity::kLength),
                   unit_that_fits(false, size_m, 1.0,
                                  {kSmallestObject_m / kNearest, kLargestObject_m, ""})),
       "point-unit"});
}

/// Mean difference of neighbours that both have a return.
double roughness(const std::vector<Frame>& frames, bool swapped) {
  const auto value = [&](std::uint16_t raw) {
    return swapped ? int(std::uint16_t(raw << 8 | raw >> 8)) : int(raw);
  };
  double sum = 0.0, count = 0.0;
  for (const Frame& frame : frames) {
    const auto& pixels = frame.depth.pixels;
    for (std::size_t i = 1; i < pixels.size(); i += kPixelStep) {
      if (pixels[i] == kNoReturn || pixels[i] == kOutsideCrop) continue;
      if (pixels[i - 1] == kNoReturn || pixels[i - 1] == kOutsideCrop) continue;
      sum += std::abs(value(pixels[i]) - value(pixels[i - 1]));
      count += 1.0;
    }
  }
  return count > 0.0 ? sum / count : 0.0;
}

}  // namespace

bool look_at_bytes(std::size_t number, const std::vector<Frame>& frames, Findings& out) {
  // Swapping multiplies small differences by 256, and large ones hardly.
  constexpr double kSmoother = 16.0;
  const double now = roughness(frames, false), swapped = roughness(frames, true);
  if (!(now > kSmoother * std::max(swapped, 1.0))) return false;
  out.push_back(
      {Plausibility::kImplausible,
       fmt::format("the bytes of sensor {}'s depth are swapped: neighbouring pixels differ "
                   "by {:.0f} steps, and by {:.0f} with the bytes in the other order; "
                   "write 16-bit PNG with the high byte first",
                   number, now, swapped),
       ""});
  return true;
}

void look_at_range(std::size_t number, const SensorInfo& sensor, const std::vector<Frame>& frames,
                   Findings& out) {
  const bool camera = sensor.kind == SensorKind::kDepthCamera;
  if (!camera && sensor.viewpoint.parallel) return look_at_size(number, frames, out);
  std::vector<double> distances = distances_of(sensor, frames);
  const double distance = quantile(distances, kNearTenth);
  const auto range = range_of(camera ? sensor.model : std::string());
  if (!(distance > 0.0) || !range) return;
  const double unit_m = camera ? sensor.depth_unit_m : 1.0;
  const double m = distance * unit_m;
  const double nearer = range->of_sensor ? kNearer : 1.0,
               farther = range->of_sensor ? kFarther : 1.0;
  const bool near = m < nearer * range->near_m;
  if (!near && m <= farther * range->far_m) return;
  const bool maybe = near && range->of_sensor && m > kNearest * range->near_m;
  const std::string option = camera ? "depth-unit" : "point-unit";
  out.push_back(
      {maybe ? Plausibility::kDoubtful : Plausibility::kImplausible,
       fmt::format("the nearest tenth of what sensor {} sees would lie within {}, and {} sees from "
                   "{:.2g} m to {:.2g} m: the unit {} another one; state it when importing, "
                   "--{}{}",
                   number, format_quantity(m, Quantity::kLength), range->whose, range->near_m,
                   range->far_m, maybe ? "may be" : "is", option,
                   unit_that_fits(camera, m, unit_m, *range)),
       option});
}

void look_at_table(const SensorInfo& sensor, const TurntableInfo& table,
                   const std::vector<Frame>& frames, Findings& out) {
  const bool camera = sensor.kind == SensorKind::kDepthCamera;
  if (sensor.viewpoint.parallel) return;
  const double there_m =
      camera ? table.center_m.z() : (table.center_m - sensor.viewpoint.value).norm();
  look_at_distance(sensor, there_m, "the turntable is stated", frames, out);
}

void look_at_distance(const SensorInfo& sensor, double there_m, std::string_view what,
                      const std::vector<Frame>& frames, Findings& out) {
  constexpr double kFarOff = 2.0;
  const bool camera = sensor.kind == SensorKind::kDepthCamera;
  const double unit_m = camera ? sensor.depth_unit_m : 1.0;
  std::vector<double> distances = distances_of(sensor, frames);
  const double near_m = unit_m * quantile(distances, kNearTenth),
               far_m = unit_m * quantile(distances, 1.0 - kNearTenth);
  const bool beyond = near_m > kFarOff * there_m;
  if (!(far_m > 0.0) || (!beyond && kFarOff * far_m > there_m)) return;
  out.push_back(
      {Plausibility::kImplausible,
       fmt::format(
           "{} {} from the sensor, and nine tenths of what it "
           "sees lie {} {}: the unit is another one{}, or that place is wrong",
           what, format_quantity(there_m, Quantity::kLength), beyond ? "beyond" : "within",
           format_quantity(beyond ? near_m : far_m, Quantity::kLength),
           unit_that_fits(camera, near_m, unit_m, {there_m / kFarOff, there_m * kFarOff, ""})),
       ""});
}

}  // namespace turnscan::plausibility
