#include <algorithm>
#include <cmath>
#include <iterator>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/figure_text.hpp>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/geometry/search/knn.hpp>
#include <turnscan/reconstruction/estimation/object_extent.hpp>
#include <turnscan/reconstruction/estimation/platter_rim.hpp>
#include <turnscan/reconstruction/estimation/scan_estimate.hpp>
#include <turnscan/reconstruction/estimation/scan_statistics.hpp>

namespace turnscan::estimation {

namespace {

constexpr std::size_t kSampledFrames = 12;
constexpr std::size_t kMinPoints = 10;  // of a frame on the object
/// Number of points of a frame sufficient to locate the platter and the object's extent; of more,
/// every n-th is used.
constexpr std::size_t kMaxUncropped = 500'000;
/// Cell size for the connectivity of the object's points, in distances between the points of a
/// frame.
constexpr double kCellSpacings = 3.0;
/// A crop ends this many spreads above the excluded surface.
constexpr double kClearNoises = 4.0;
/// Required share of the observed directions in which a platter's rim is seen.
constexpr double kRoundShare = 0.6;
/// Deviation from y = 0 of a plane whose tilt is the error of a calibration from motion.
constexpr double kTilt_m = 0.0005;
/// Thin parts are hardly seen to turn: a crop leaves room beyond the observed extent.
constexpr double kBeyondReach = 1.25, kBeyondReach_m = 0.015;

/// Input of the estimate.
struct PosedScan {
  std::span<const Frame> frames;
  std::span<const Pose> poses;
  const SequenceHeader& header;
  const std::vector<RayTable>& rays;
  const std::vector<std::optional<views::LightSheet>>& sheets;
  const CropOptions& crop;
};

bool is_cropped(const SequenceHeader& header, const CropOptions& crop) {
  return crop.enabled && (header.turntable || crop.radius_m);
}

std::optional<double> known_radius(const SequenceHeader& header, const CropOptions& crop) {
  return crop.radius_m || !header.turntable ? crop.radius_m : header.turntable->radius_m;
}

/// Crop radius as far as the calibration determines it; it contains an extent if it saw no platter.
std::optional<double> calibrated_radius(const SequenceHeader& header, const CropOptions& crop) {
  const auto known = known_radius(header, crop);
  if (known || !header.turntable || !header.turntable->reach_m) return known;
  return kBeyondReach * *header.turntable->reach_m + kBeyondReach_m;
}

/// Approximate cylinder of the object and its noise, without the platter.
Cylinder rough_cylinder(const SequenceHeader& header, const CropOptions& crop) {
  Cylinder rough;
  rough.margin_m = crop.margin_m.value_or(0.003);
  rough.radius_m = calibrated_radius(header, crop).value_or(1e3);
  rough.height_m = crop.height_m;
  return rough;
}

/// Enlarges the cylinder, since an object may be wider than its platter.
void take_in_all_of_object(const std::vector<Vec3f>& sample, Cylinder& cylinder,
                           ScanEstimate& estimate) {
  const auto reach = reach_beyond(sample, cylinder, kCellSpacings * estimate.spacing_m);
  if (!reach) return;
  const double platter = cylinder.radius_m;
  cylinder.radius_m = kBeyondReach * *reach + kBeyondReach_m;
  for (ResolvedParameter& choice : estimate.choices)
    if (choice.option == "crop-radius")
      choice = {"crop-radius", length_text(cylinder.radius_m),
                fmt::format("the object reaches {} from the axis, beyond the platter's {}; 25 % "
                            "and 15mm more",
                            length_text(*reach), length_text(platter))};
}

/// The returns of a platter of known radius, if they are as wide and as round as it, rather than
/// only an object's feet and walls.
std::optional<PlatterReturns> platter_with_rim(const PlatterReturns& returns, double most_sigma_m,
                                               const std::vector<Vec3f>& sample, double radius_m,
                                               const PlatterRim& looks) {
  std::vector<Vec3f> rim;
  const double inner = PlatterRim::kInnerShare * radius_m;
  std::copy_if(sample.begin(), sample.end(), std::back_inserter(rim), [&](const Vec3f& p) {
    const double r = std::hypot(double(p.x()), double(p.z()));
    return std::abs(double(p.y())) < PlatterReturns::kReach_m && r > inner && r < radius_m;
  });
  const PlatterReturns at_rim = measure_platter(rim, radius_m);
  if (!at_rim.plane(most_sigma_m) || looks.share_seen() < kRoundShare) return std::nullopt;
  return returns.plane(most_sigma_m) ? returns : at_rim;
}

/// The platter's returns among those at its height, if one is seen. known_m: its radius, from the
/// recording or the user; calibrated: minimum radius at which something turns.
std::optional<PlatterReturns> platter_in(const PlatterReturns& returns,
                                         const std::vector<Vec3f>& sample,
                                         const std::optional<double>& known_m,
                                         const PlatterRim& rim, bool calibrated, double noise_m) {
  const double most_sigma_m = std::max(PlatterReturns::kMaxSigma_m, 2.0 * noise_m);
  if (known_m) return platter_with_rim(returns, most_sigma_m, sample, *known_m, rim);
  // A calibration without a radius has searched for a platter without success: only returns as thin
  // as the noise prove the opposite.
  const bool plane = returns.plane(calibrated ? noise_m + kTilt_m : most_sigma_m);
  return plane ? std::optional(returns) : std::nullopt;
}

/// Whether frames may lack an existing platter: cropped to the object while recording, or scans of
/// it alone.
bool may_be_cut(std::span<const Frame> frames) {
  return std::any_of(frames.begin(), frames.end(), [](const Frame& frame) {
    const auto& pixels = frame.depth.pixels;
    return pixels.empty() || std::find(pixels.begin(), pixels.end(), kOutsideCrop) != pixels.end();
  });
}

/// Lowest height that is kept, and the reason. stands: on a platter, whether it is seen or not, or
/// at the height where a calibration saw that it ends.
std::pair<double, std::string> choose_margin(const PlatterReturns& returns,
                                             const std::optional<PlatterReturns>& platter,
                                             bool stands, double noise_m) {
  const double clear = kClearNoises * noise_m;
  if (platter)
    return {std::max(0.001, platter->height_m + kClearNoises * platter->sigma_m),
            fmt::format("the platter's returns lie at {} with a spread of {}; 4 spreads above",
                        length_text(platter->height_m), length_text(platter->sigma_m))};
  if (stands)
    return {std::max(0.002, clear),
            fmt::format("4 times the sensor's noise of {}", length_text(noise_m))};
  const double below = -std::max(0.005, clear);
  if (returns.height_m < below && returns.lie_flat(PlatterReturns::kMaxSigma_m))
    return {
        std::clamp(returns.height_m + kClearNoises * returns.sigma_m, below, 0.0),
        fmt::format("no platter is seen, but a plane {} below it", length_text(-returns.height_m))};
  return {below,
          "no platter is seen, so that nothing is cropped below; --keep-box \",2mm,,,,\" cuts off "
          "what lies below 2 mm"};
}

/// Observations by depth cameras at the position of a platter's rim.
PlatterRim looks_at_rim(const PosedScan& scan, double radius_m) {
  PlatterRim rim(radius_m);
  for (const std::size_t i : evenly_spread(scan.frames.size(), kSampledFrames)) {
    const Frame& frame = scan.frames[i];
    if (!frame.depth.pixels.empty())
      rim.add(frame, scan.header.sensors[frame.info.sensor], scan.poses[i]);
  }
  return rim;
}

void choose_crop(const std::vector<Vec3f>& sample, const PosedScan& scan, ScanEstimate& estimate) {
  const SequenceHeader& header = scan.header;
  const CropOptions& crop = scan.crop;
  Cylinder cylinder;
  cylinder.height_m = crop.height_m;
  const std::optional<double> known = known_radius(header, crop);
  const std::optional<double> calibrated = calibrated_radius(header, crop);
  const PlatterReturns returns = measure_platter(sample, std::min(calibrated.value_or(0.5), 0.5));
  const auto found = calibrated ? calibrated : find_platter_radius(sample, returns);
  if (found) {
    estimate.choices.push_back({"crop-radius", length_text(*found),
                                crop.radius_m ? "given"
                                : known       ? "the platter's radius"
                                : calibrated  ? "25 % and 15mm beyond what was seen to turn"
                                              : "where the returns of the platter end"});
  } else {
    estimate.notes.emplace_back(
        "no platter was found and no radius is given, so that nothing is cropped sideways; "
        "--crop-radius limits what is kept");
  }
  cylinder.radius_m = found.value_or(1e3);
  const PlatterRim rim = looks_at_rim(scan, known.value_or(0.0));
  auto platter = platter_in(returns, sample, known, rim, calibrated.has_value(), estimate.noise_m);
  // In frames that lack the platter, the remaining returns at its height represent it.
  if (known && returns.count > 0 && may_be_cut(scan.frames)) platter = returns;
  auto [margin, reason] = choose_margin(returns, platter, calibrated.has_value(), estimate.noise_m);
  cylinder.margin_m = crop.margin_m.value_or(margin);
  estimate.choices.push_back(
      {"crop-margin", length_text(cylinder.margin_m), crop.margin_m ? "given" : std::move(reason)});
  if (known && !crop.radius_m) take_in_all_of_object(sample, cylinder, estimate);
  estimate.cylinder = cylinder;
}

/// A frame's points on the object, in the order of their sheet if they are in one.
Result<FramePoints> object_points(const Frame& frame, const Pose& pose,
                                  const SequenceHeader& header, const RayTable& rays,
                                  const std::optional<views::LightSheet>& sheet,
                                  const CropOptions& crop_options, std::vector<Vec3f>* all) {
  TURNSCAN_ASSIGN(FramePoints points, points_of(frame, header.sensors[frame.info.sensor], rays));
  if (all != nullptr) {
    const Eigen::Affine3f T_table_sensor = pose.cast<float>();
    const std::size_t step = 1 + points.cloud.size() / kMaxUncropped;
    for (std::size_t i = 0; i < points.cloud.size(); i += step)
      all->push_back(T_table_sensor * points.cloud.points[i]);
  }
  if (sheet) points = in_sheet_order(points, *sheet);
  if (is_cropped(header, crop_options))
    points = crop(points, SensorCrop(rough_cylinder(header, crop_options), pose));
  return points;
}

/// Distance of the next profile: median over the profile's points.
double profile_distance(const FramePoints& own, const Pose& own_pose, const FramePoints& next,
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

/// Statistics of single frames.
class FrameSamples {
 public:
  explicit FrameSamples(const PosedScan& scan) : scan_(scan) {}

  /// Adds these frames.
  Result<> add(const std::vector<std::size_t>& frames) {
    std::vector<Sample> samples(frames.size());
    TURNSCAN_TRY(parallel_for(frames.size(), 1, RunContext(), [&](std::size_t k) -> Result<> {
      TURNSCAN_ASSIGN(samples[k], sample(frames[k]));
      return {};
    }));
    for (const Sample& one : samples) {
      points_.insert(points_.end(), one.uncropped.begin(), one.uncropped.end());
      if (!one.statistics) continue;
      spacing_.push_back(one.statistics->spacing_m);
      even_.push_back(one.statistics->even_spacing_m);
      noise_.push_back(one.statistics->noise_m);
      if (one.across_m) across_.push_back(*one.across_m);
    }
    return {};
  }

  Result<> summarise(ScanEstimate& estimate) {
    if (spacing_.empty())
      return fail(ErrorCode::kTooFewPoints,
                  "none of the frames looked at has 10 points on the object; check the turntable's "
                  "pose and --crop-margin, --crop-radius");
    std::sort(spacing_.begin(), spacing_.end());
    std::sort(noise_.begin(), noise_.end());
    estimate.noise_m = noise_[noise_.size() / 2];
    estimate.profiles = across_.size() == spacing_.size();
    estimate.spacing_m = std::max(spacing_[spacing_.size() / 2], median(across_));
    estimate.even_spacing_m = std::max(median(even_), median(across_));
    return {};
  }

  /// Points of all frames, uncropped, table frame.
  const std::vector<Vec3f>& points() const { return points_; }

 private:
  /// Results of one frame.
  struct Sample {
    std::vector<Vec3f> uncropped;               ///< table frame
    std::optional<FrameStatistics> statistics;  ///< if it has enough points on the object
    std::optional<double> across_m;             ///< to the next profile
  };

  Result<Sample> sample(std::size_t i) const {
    Sample out;
    const std::optional<views::LightSheet>& sheet = scan_.sheets.at(scan_.frames[i].info.sensor);
    TURNSCAN_ASSIGN(const FramePoints points, points_on_object(i, &out.uncropped));
    if (points.cloud.size() < kMinPoints) return out;
    out.statistics = frame_statistics(points);
    const auto next = sheet ? next_of_sensor(scan_.frames, i) : std::nullopt;
    if (!next) return out;
    TURNSCAN_ASSIGN(const FramePoints neighbour, points_on_object(*next, nullptr));
    if (neighbour.cloud.size() >= kMinPoints)
      out.across_m = profile_distance(points, scan_.poses[i], neighbour, scan_.poses[*next]);
    return out;
  }

  Result<FramePoints> points_on_object(std::size_t i, std::vector<Vec3f>* all) const {
    const std::size_t s = scan_.frames[i].info.sensor;
    return object_points(scan_.frames[i], scan_.poses[i], scan_.header, scan_.rays.at(s),
                         scan_.sheets.at(s), scan_.crop, all);
  }

  PosedScan scan_;
  std::vector<double> spacing_, even_, noise_;
  std::vector<double> across_;  ///< between neighbouring profiles
  std::vector<Vec3f> points_;
};

}  // namespace

Result<std::vector<std::optional<views::LightSheet>>> find_sheets(
    std::span<const Frame> frames, const SequenceHeader& header,
    const std::vector<RayTable>& rays) {
  std::vector<std::optional<views::LightSheet>> sheets(header.sensors.size());
  std::vector<std::size_t> lines(sheets.size(), 0), some(sheets.size(), 0);
  for (const Frame& frame : frames) {
    const std::size_t s = frame.info.sensor;
    if (header.sensors.at(s).kind != SensorKind::kPointScanner) continue;
    TURNSCAN_ASSIGN(const FramePoints points, points_of(frame, header.sensors[s], rays.at(s)));
    if (points.cloud.size() < kMinPoints) continue;
    ++some[s];
    const auto sheet = views::find_sheet(points);
    if (!sheet) continue;
    ++lines[s];
    if (!sheets[s]) sheets[s] = sheet;
  }
  for (std::size_t s = 0; s < sheets.size(); ++s) {
    if (lines[s] < 2 || 10 * lines[s] < 8 * some[s]) sheets[s].reset();
  }
  return sheets;
}

std::size_t frames_for_estimate(const SequenceHeader& header, const CropOptions& crop) {
  return !is_cropped(header, crop) || known_radius(header, crop) ? 32 : 128;
}

Result<ScanEstimate> estimate_scan(std::span<const Frame> frames, std::span<const Pose> poses,
                                   const SequenceHeader& header, const std::vector<RayTable>& rays,
                                   const CropOptions& crop_options) {
  ScanEstimate estimate;
  TURNSCAN_ASSIGN(estimate.sheets, find_sheets(frames, header, rays));
  const PosedScan scan{frames, poses, header, rays, estimate.sheets, crop_options};
  FrameSamples samples(scan);
  TURNSCAN_TRY(samples.add(evenly_spread(frames.size(), kSampledFrames)));
  TURNSCAN_TRY(samples.summarise(estimate));
  // Rounding to the sensor's unit spreads depth by at least unit / sqrt(12).
  for (const SensorInfo& sensor : header.sensors) {
    if (sensor.kind == SensorKind::kDepthCamera)
      estimate.noise_m = std::max(estimate.noise_m, sensor.depth_unit_m / std::sqrt(12.0));
  }
  if (is_cropped(header, crop_options)) choose_crop(samples.points(), scan, estimate);
  return estimate;
}

}  // namespace turnscan::estimation
