#include "scanner/live_session.hpp"

#include <algorithm>
#include <cmath>
#include <turnscan/capture/session/device_calibration.hpp>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/stopwatch.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/turntable/crop/crop.hpp>
#include <turnscan/turntable/table_frame.hpp>
#include <turnscan/workflow/scan/capture_outcome.hpp>
#include <turnscan/workflow/scan/capture_setup.hpp>

#include "scanner/live_picture.hpp"

namespace turnscan::studio {

namespace {

constexpr double kPictureEvery_s = 0.06, kSeenEvery_s = 0.25, kSilence_s = 2.0;
constexpr std::size_t kSeenPerFrame = 12000;
constexpr double kCropMargin_m = 0.006;
// The live picture, in the same colours, is drawn in front of it.
constexpr double kBehind_m = 0.003;
// A surface is drawn in front of the live picture and its noise.
constexpr double kBefore_m = 0.006;

/// Crop to the object on the platter; nullopt if that is not known.
std::optional<SensorCrop> object_crop(const SequenceHeader& header, std::size_t sensor) {
  if (!header.turntable) return std::nullopt;
  const auto pose = sensor_pose(header, sensor);
  if (!pose) return std::nullopt;
  const double reach = header.turntable->reach_m.value_or(1e9);
  const double radius = header.turntable->radius_m.value_or(reach);
  return SensorCrop(Cylinder{kCropMargin_m, 2.0, radius}, *pose);
}

/// About twice the spacing of neighbouring pixels at the table.
double cell_size(const SequenceHeader& header) {
  const SensorInfo& sensor = header.sensors.front();
  if (sensor.kind != SensorKind::kDepthCamera || !header.turntable) return 0.004;
  const double pitch = header.turntable->center_m.norm() / std::max(1.0, sensor.intrinsics.fx);
  return std::clamp(2.5 * pitch, 0.002, 0.02);
}

std::string lost_text(const CaptureResult& result) {
  const std::uint64_t lost = result.source.dropped() + result.recorder.dropped_by_disk;
  std::string text = fmt::format("{} frames in {:.1f} s", result.recorder.written, result.seconds);
  if (result.turned_rad) text += fmt::format(", {:.2f} turns", *result.turned_rad / kTurn);
  if (lost == 0) return text + ", none dropped";
  return text + fmt::format(", {} dropped ({} by the sensor, {} because the disk was too slow)",
                            lost, lost - result.recorder.dropped_by_disk,
                            result.recorder.dropped_by_disk);
}

}  // namespace

LiveFeed::Session::Session(LiveFeed& feed, FrameSource& source) : feed_(feed), source_(source) {
  for (const SensorInfo& sensor : source.info().header.sensors)
    rays_.emplace_back(sensor.intrinsics);
}

std::shared_ptr<const Calibration> LiveFeed::Session::calibration() {
  const std::lock_guard lock(feed_.mutex_);
  return feed_.calibration_;
}

SequenceHeader LiveFeed::Session::header_with_table() {
  SequenceHeader header = source_.info().header;
  header.source = source_.info().uri;
  if (const auto known = calibration()) {
    header.turntable = known->table;
    // A calibration for another mode of the sensor is not applied.
    (void)correct_sensors(*known, header.sensors);
    // A calibration contains only the first sensor's pose.
    header.sensors[0].T_table_sensor.reset();
  }
  return header;
}

void LiveFeed::Session::record(const RecordingRequest& request, const RunContext& context) {
  {
    const std::lock_guard lock(feed_.mutex_);
    feed_.state_.recording = true;
    feed_.state_.progress = {};
    feed_.state_.seen.reset();
  }
  const auto result = capture_now(request, context);
  take_surface();
  const DrawablePtr last = mesh_.empty() ? nullptr : make_drawable(mesh_);
  surface_.reset();
  seen_.reset();
  motion_.reset();
  const std::lock_guard lock(feed_.mutex_);
  LiveState& state = feed_.state_;
  state.recording = false;
  if (!result) {
    if (result.error().code != ErrorCode::kCancelled) state.record_error = result.error().text();
    return;
  }
  const bool stopped = result->error && result->error->code == ErrorCode::kCancelled;
  if (const auto good = capture_outcome(*result, request.folder); !good && !stopped)
    state.record_error = good.error().text();
  if (!result->recorded) return;
  state.outcome = lost_text(*result);
  state.surface = last;
  state.finished = request.folder;
}

Result<CaptureResult> LiveFeed::Session::capture_now(const RecordingRequest& request,
                                                     const RunContext& context) {
  CaptureOptions options = request.options;
  header_ = header_with_table();
  CaptureSettings settings = settings_of(source_.info());
  std::optional<Motor> motor;
  if (!request.motor_port.empty()) {
    TURNSCAN_ASSIGN(motor, open_motor(request.motor_port, request.motor, settings, context));
  }
  settle_speed(motor.has_value(), options, header_);
  if (const auto known = calibration()) note_calibration_date(known->made_at, settings);
  begin_seen(options);
  CaptureHooks hooks;
  hooks.motor = motor ? &*motor : nullptr;
  hooks.frame = [this](const Frame& frame) -> Result<> {
    see(frame);
    take(frame);
    return {};
  };
  hooks.progress = [this](const CaptureProgress& progress) {
    take_motion(progress.motion);
    const std::lock_guard lock(feed_.mutex_);
    feed_.state_.progress = progress;
  };
  // header_ is updated with the motion found meanwhile.
  const SequenceHeader header = header_;
  auto result = capture(source_, request.folder, header, settings, options, hooks, context);
  // Stored for the next use of this device. Failing to store it is not an error.
  const auto& identities = source_.info().identities;
  if (const auto known = calibration(); result && result->recorded && known && !identities.empty())
    (void)keep_calibration(identities.front(), *known);
  return result;
}

void LiveFeed::Session::begin_seen(const CaptureOptions& options) {
  motion_.reset();
  seen_.reset();
  mesh_ = {};
  surfaces_ = 0;
  finder_.emplace(header_, options.speed_rad_s);
  T_turned_sensor_.assign(header_.sensors.size(), std::nullopt);
  surface_ = std::make_unique<LiveSurface>(header_);
}

void LiveFeed::Session::take_motion(const std::shared_ptr<const Calibration>& shown) {
  if (const auto motion = finder_->take(shown)) place_by(*motion);
}

void LiveFeed::Session::place_by(const LiveMotion& motion) {
  motion_ = motion;
  header_.turntable = motion.table;
  seen_.emplace(cell_size(header_));
  for (const auto& frame : surface_->frames())
    if (const auto turned = motion.turned_rad(frame->info)) count_seen(*frame, *turned);
  surface_->set_motion(motion);
}

void LiveFeed::Session::see(const Frame& frame) {
  if (!surface_ || frame.info.status != FrameStatus::kOk) return;
  if (const auto motion = finder_->take(frame.info)) place_by(*motion);
  surface_->add(frame);
  if (!motion_) return;
  const std::optional<double> turned = motion_->turned_rad(frame.info);
  if (!turned) return;
  count_seen(frame, *turned);
  if (frame.info.sensor == 0 && seconds_since(last_seen_) > kSeenEvery_s) show_seen(*turned);
}

void LiveFeed::Session::count_seen(const Frame& frame, double turned_rad) {
  const std::size_t s = frame.info.sensor;
  const auto crop = object_crop(header_, s);
  const auto points = points_of(frame, header_.sensors.at(s), rays_.at(s));
  if (!crop || !points) return;
  const Pose back = Pose(Eigen::AngleAxisd(-turned_rad, Vec3d::UnitY())) * *sensor_pose(header_, s);
  T_turned_sensor_.at(s) = back;
  const auto& all = points->cloud.points;
  const std::size_t step = all.size() / kSeenPerFrame + 1;
  std::vector<Vec3f> kept;
  // A different subset of the pixels each time, so that all of them are used in turn.
  for (std::size_t i = frame.info.index % step; i < all.size(); i += step)
    if (crop->keeps(all[i])) kept.push_back((back * all[i].cast<double>()).cast<float>());
  seen_->add(kept, turned_rad);
}

void LiveFeed::Session::take_surface() {
  auto update = surface_ ? surface_->take() : std::nullopt;
  if (!update) return;
  mesh_ = std::move(update->mesh);
  // Once per surface: otherwise drawing would search for creases each time.
  if (mesh_.normals.empty()) mesh_.normals = vertex_normals(mesh_);
  ++surfaces_;
}

void LiveFeed::Session::show_seen(double turned_rad) {
  last_seen_ = Clock::now();
  CoverageSummary summary;
  summary.area_m2 = seen_->area_m2();
  summary.share_well = seen_->share_well();
  summary.sides = seen_->sides();
  take_surface();
  summary.surfaces = surfaces_;
  const Pose T_sensor_table =
      sensor_pose(header_, 0)->inverse() * Pose(Eigen::AngleAxisd(turned_rad, Vec3d::UnitY()));
  summary.is_surface = !mesh_.empty();
  if (summary.is_surface) {
    double missing = 0.0;
    summary.picture = draw_surface(mesh_, T_sensor_table, missing);
    summary.share_missing = missing;
  } else {
    summary.picture = draw_cells(T_sensor_table);
  }
  const std::lock_guard lock(feed_.mutex_);
  feed_.state_.seen = std::move(summary);
}

/// Coloured by the number of sides from which each point was seen; color_of_sides(0) where no frame
/// has seen it.
DrawablePtr LiveFeed::Session::draw_surface(const TriangleMesh& mesh, const Pose& T_sensor_table,
                                            double& share_missing) const {
  TriangleMesh shown = mesh;
  std::vector<char> missing(mesh.vertices.size(), 0);
  shown.colors.resize(mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const auto color = seen_->color_near(mesh.vertices[v]);
    missing[v] = color ? 0 : 1;
    shown.colors[v] = color.value_or(color_of_sides(0));
    const Vec3d at = T_sensor_table * mesh.vertices[v].cast<double>();
    shown.vertices[v] = (at - kBefore_m * at.normalized()).cast<float>();
  }
  for (Vec3f& normal : shown.normals)
    normal = (T_sensor_table.linear() * normal.cast<double>()).cast<float>();
  double all_m2 = 0.0, missing_m2 = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3f& p = mesh.vertices[a];
    const double area = 0.5 * double((mesh.vertices[b] - p).cross(mesh.vertices[c] - p).norm());
    all_m2 += area;
    if (missing[a] != 0 && missing[b] != 0 && missing[c] != 0) missing_m2 += area;
  }
  share_missing = all_m2 > 0.0 ? missing_m2 / all_m2 : 0.0;
  return make_drawable(shown);
}

DrawablePtr LiveFeed::Session::draw_cells(const Pose& T_sensor_table) const {
  PointCloud cloud = seen_->cloud();
  for (Vec3f& p : cloud.points) {
    const Vec3d at = T_sensor_table * p.cast<double>();
    p = (at + kBehind_m * at.normalized()).cast<float>();
  }
  return make_drawable(cloud, seen_->cell_m());
}

void LiveFeed::Session::note_silence() {
  if (seconds_since(last_frame_) < kSilence_s) return;
  const std::lock_guard lock(feed_.mutex_);
  feed_.state_.fps = 0.0;
}

void LiveFeed::Session::take(const Frame& frame) {
  last_frame_ = Clock::now();
  if (frame.info.status != FrameStatus::kOk) return;
  show(frame);
  // During a recording, the processor is reserved for it; its own frames are checked afterwards.
  if (!surface_) rig_watch_.take(frame, source_.info().header, calibration());
  const std::lock_guard lock(feed_.mutex_);
  feed_.state_.rig = rig_watch_.found();
  feed_.state_.platter = rig_watch_.platter();
  feed_.state_.no_platter = rig_watch_.no_platter();
  if (feed_.collected_.size() < feed_.wanted_) feed_.collected_.push_back(frame);
  feed_.state_.averaged = feed_.collected_.size();
}

void LiveFeed::Session::show(const Frame& frame) {
  const double waited = seconds_since(last_rate_);
  const SourceStatistics statistics = source_.statistics();
  if (waited > 0.5) {
    fps_ = double(statistics.delivered - frames_at_rate_) / waited;
    frames_at_rate_ = statistics.delivered;
    last_rate_ = Clock::now();
  }
  DrawablePtr picture;
  std::size_t count = 0;
  if (seconds_since(last_picture_) > kPictureEvery_s) {
    picture = draw(frame, count);
    last_picture_ = Clock::now();
  }
  const std::lock_guard lock(feed_.mutex_);
  feed_.state_.frames = statistics.delivered;
  feed_.state_.dropped = statistics.dropped();
  feed_.state_.fps = fps_;
  feed_.state_.table_known = feed_.calibration_ || source_.info().header.turntable;
  if (!picture) return;
  feed_.state_.picture = std::move(picture);
  feed_.state_.points = count;
}

DrawablePtr LiveFeed::Session::draw(const Frame& frame, std::size_t& count) {
  const std::size_t s = frame.info.sensor;
  const SequenceHeader header = header_with_table();
  const auto points = points_of(frame, header.sensors.at(s), rays_.at(s));
  if (!points) return nullptr;
  std::optional<SensorCrop> crop;
  if (feed_.filter_) crop = object_crop(header, s);
  const LivePicture shown = live_picture(*points, crop, feed_.most_points_, tint_of(s));
  count = shown.points;
  const double fx = header.sensors[s].intrinsics.fx;
  return make_drawable(shown, points->width > 0 && fx > 0.0 ? 1.0 / fx : 0.0);
}

/// During a recording: shows the coverage so far on the live picture.
Tint LiveFeed::Session::tint_of(std::size_t sensor) const {
  if (!seen_ || !T_turned_sensor_.at(sensor)) return {};
  const auto crop = object_crop(header_, sensor);
  if (!crop) return {};
  return [this, crop, pose = *T_turned_sensor_[sensor]](const Vec3f& p) -> std::optional<Rgb> {
    if (!crop->keeps(p)) return std::nullopt;
    return seen_->color_at((pose * p.cast<double>()).cast<float>());
  };
}

}  // namespace turnscan::studio
