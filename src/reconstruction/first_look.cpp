#include <algorithm>
#include <turnscan/core/median.hpp>
#include <turnscan/geometry/knn.hpp>
#include <turnscan/reconstruction/first_look.hpp>
#include <turnscan/reconstruction/length_text.hpp>
#include <turnscan/reconstruction/scan_statistics.hpp>

namespace turnscan {

namespace {

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

/// A frame's points on the object, in the order of their sheet if they lie in one.
Result<FramePoints> object_points(const Frame& frame, const Pose& pose,
                                  const SequenceHeader& header, const RayTable& rays,
                                  const std::optional<LightSheet>& sheet, const CropOptions& how,
                                  std::vector<Vec3f>* all) {
  TURNSCAN_ASSIGN(FramePoints points, points_of(frame, header.sensors[frame.info.sensor], rays));
  for (const Vec3f& p : points.cloud.points) {
    if (all != nullptr) all->push_back(pose.cast<float>() * p);
  }
  if (sheet) points = in_sheet_order(points, *sheet);
  if (cropped(header, how)) points = crop(points, SensorCrop(rough_cylinder(header, how), pose));
  return points;
}

/// How far the next profile lies from one: median of the distances of its points.
double apart(const FramePoints& own, const Pose& own_pose, const FramePoints& next,
             const Pose& next_pose) {
  std::vector<Vec3f> others;
  for (const Vec3f& p : next.cloud.points) others.push_back(next_pose.cast<float>() * p);
  const KdTree tree(others);
  std::vector<double> distances;
  const std::size_t step = std::max<std::size_t>(1, own.cloud.size() / 200);
  for (std::size_t i = 0; i < own.cloud.size(); i += step) {
    std::uint32_t index = 0;
    float squared = 0.0f;
    if (tree.knn(own_pose.cast<float>() * own.cloud.points[i], 1, &index, &squared) == 1)
      distances.push_back(std::sqrt(squared));
  }
  return median(distances);
}

std::optional<std::size_t> next_of_sensor(std::span<const Frame> frames, std::size_t i) {
  for (std::size_t k = i + 1; k < frames.size(); ++k) {
    if (frames[k].info.sensor == frames[i].info.sensor) return k;
  }
  return std::nullopt;
}

}  // namespace

Result<std::vector<std::optional<LightSheet>>> find_sheets(std::span<const Frame> frames,
                                                           const SequenceHeader& header,
                                                           const std::vector<RayTable>& rays) {
  std::vector<std::optional<LightSheet>> sheets(header.sensors.size());
  std::vector<std::size_t> lines(sheets.size(), 0), some(sheets.size(), 0);
  for (const Frame& frame : frames) {
    const std::size_t s = frame.info.sensor;
    if (header.sensors.at(s).kind != SensorKind::kPointScanner) continue;
    TURNSCAN_ASSIGN(const FramePoints points, points_of(frame, header.sensors[s], rays.at(s)));
    if (points.cloud.size() < 10) continue;
    ++some[s];
    const auto sheet = find_sheet(points);
    if (!sheet) continue;
    ++lines[s];
    if (!sheets[s]) sheets[s] = sheet;
  }
  for (std::size_t s = 0; s < sheets.size(); ++s) {
    if (lines[s] < 2 || 10 * lines[s] < 8 * some[s]) sheets[s].reset();
  }
  return sheets;
}

std::size_t frames_of_first_look(const SequenceHeader& header, const CropOptions& crop) {
  return !cropped(header, crop) || known_radius(header, crop) ? 32 : 128;
}

Result<FirstLook> look_at(std::span<const Frame> frames, std::span<const Pose> poses,
                          const SequenceHeader& header, const std::vector<RayTable>& rays,
                          const CropOptions& crop_options) {
  constexpr std::size_t kLooks = 12;
  const std::size_t looks = std::min(kLooks, frames.size());
  std::vector<double> spacing, even, noise, across;
  std::vector<Vec3f> sample;
  FirstLook look;
  TURNSCAN_ASSIGN(look.sheets, find_sheets(frames, header, rays));
  for (std::size_t k = 0; k < looks; ++k) {
    const std::size_t i = k * frames.size() / looks;
    const std::size_t s = frames[i].info.sensor;
    TURNSCAN_ASSIGN(const FramePoints points,
                    object_points(frames[i], poses[i], header, rays.at(s), look.sheets.at(s),
                                  crop_options, &sample));
    if (points.cloud.size() < 10) continue;
    const FrameStatistics statistics = frame_statistics(points);
    spacing.push_back(statistics.spacing_m);
    even.push_back(statistics.even_spacing_m);
    noise.push_back(statistics.noise_m);
    const auto next = look.sheets[s] ? next_of_sensor(frames, i) : std::nullopt;
    if (!next) continue;
    TURNSCAN_ASSIGN(const FramePoints neighbour,
                    object_points(frames[*next], poses[*next], header, rays.at(s), look.sheets[s],
                                  crop_options, nullptr));
    if (neighbour.cloud.size() >= 10)
      across.push_back(apart(points, poses[i], neighbour, poses[*next]));
  }
  if (spacing.empty())
    return fail(ErrorCode::kTooFewPoints,
                "none of the frames looked at has 10 points on the object; check the turntable's "
                "place and --crop-margin, --crop-radius");
  std::sort(spacing.begin(), spacing.end());
  std::sort(noise.begin(), noise.end());
  look.spacing_m = spacing[spacing.size() / 2];
  look.noise_m = noise[noise.size() / 2];
  look.profiles = across.size() == spacing.size();
  look.spacing_m = std::max(look.spacing_m, median(across));
  look.even_spacing_m = std::max(median(even), median(across));
  // Rounding to the sensor's unit spreads depth by unit / sqrt(12) at least.
  for (const SensorInfo& sensor : header.sensors) {
    if (sensor.kind == SensorKind::kDepthCamera)
      look.noise_m = std::max(look.noise_m, sensor.depth_unit_m / std::sqrt(12.0));
  }
  if (cropped(header, crop_options)) choose_crop(sample, header, crop_options, look);
  return look;
}

}  // namespace turnscan
