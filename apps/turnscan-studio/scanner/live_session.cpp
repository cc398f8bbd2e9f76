#include "scanner/live_session.hpp"

#include <algorithm>
#include <cmath>
#include <turnscan/capture/session/device_calibration.hpp>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/stopwatch.hpp>
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
constexpr double kBehind_m = 0.003;  // the picture itself, in the same colours, lies before it

/// What stands on the platter; nullopt where that is not known.
std::optional<SensorCrop> object_crop(const SequenceHeader& header, std::size_t sensor) {
  if (!header.turntable) return std::nullopt;
  const auto pose = sensor_pose(header, sensor);
  if (!pose) return std::nullopt;
  const double radius = header.turntable->radius_m.value_or(1e9);
  return SensorCrop(Cylinder{kCropMargin_m, 2.0, radius}, *pose);
}

/// About twice the distance of neighbouring pixels on the table.
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
    // A calibration of another mode of the sensor corrects nothing.
    (void)correct_sensors(*known, header.sensors);
    // Of several sensors only the first one's place is in a calibration.
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
  seen_.reset();
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
  begin_seen(header_, options);
  CaptureHooks hooks;
  hooks.motor = motor ? &*motor : nullptr;
  hooks.frame = [this](const Frame& frame) -> Result<> {
    see(frame);
    take(frame);
    return {};
  };
  hooks.progress = [this](const CaptureProgress& progress) {
    const std::lock_guard lock(feed_.mutex_);
    feed_.state_.progress = progress;
  };
  auto result = capture(source_, request.folder, header_, settings, options, hooks, context);
  // For the next time that this device is used. That it cannot be kept is no reason to fail.
  const auto& identities = source_.info().identities;
  if (const auto known = calibration(); result && result->recorded && known && !identities.empty())
    (void)keep_calibration(identities.front(), *known);
  return result;
}

void LiveFeed::Session::begin_seen(const SequenceHeader& header, const CaptureOptions& options) {
  first_time_s_.reset();
  speed_rad_s_ = options.speed_rad_s;
  if (!speed_rad_s_ && header.turntable) speed_rad_s_ = header.turntable->speed_rad_s;
  seen_.reset();
  T_turned_sensor_.assign(header.sensors.size(), std::nullopt);
  if (header.turntable) seen_.emplace(cell_size(header));
}

void LiveFeed::Session::see(const Frame& frame) {
  if (!seen_ || frame.info.status != FrameStatus::kOk) return;
  std::optional<double> turned = frame.info.angle_rad;
  if (!turned && speed_rad_s_ && std::isfinite(frame.info.time_s)) {
    if (!first_time_s_) first_time_s_ = frame.info.time_s;
    turned = *speed_rad_s_ * (frame.info.time_s - *first_time_s_);
  }
  const std::size_t s = frame.info.sensor;
  const auto crop = object_crop(header_, s);
  const auto points = points_of(frame, header_.sensors.at(s), rays_.at(s));
  if (!turned || !crop || !points) return;
  const Pose pose = *sensor_pose(header_, s);
  const Pose back = Pose(Eigen::AngleAxisd(-*turned, Vec3d::UnitY())) * pose;
  T_turned_sensor_.at(s) = back;
  const auto& all = points->cloud.points;
  const std::size_t step = all.size() / kSeenPerFrame + 1;
  std::vector<Vec3f> kept;
  // Another part of the pixels each time, so that all of them come round.
  for (std::size_t i = frame.info.index % step; i < all.size(); i += step)
    if (crop->keeps(all[i])) kept.push_back((back * all[i].cast<double>()).cast<float>());
  seen_->add(kept, *turned);
  if (s == 0 && seconds_since(last_seen_) > kSeenEvery_s) show_seen(*turned, pose);
}

void LiveFeed::Session::show_seen(double turned_rad, const Pose& T_table_sensor) {
  last_seen_ = Clock::now();
  CoverageSummary summary;
  summary.area_m2 = seen_->area_m2();
  summary.share_well = seen_->share_well();
  summary.sides = seen_->sides();
  PointCloud cloud = seen_->cloud();
  const Pose now = T_table_sensor.inverse() * Pose(Eigen::AngleAxisd(turned_rad, Vec3d::UnitY()));
  for (Vec3f& p : cloud.points) {
    const Vec3d at = now * p.cast<double>();
    p = (at + kBehind_m * at.normalized()).cast<float>();
  }
  summary.picture = make_drawable(cloud, seen_->cell_m());
  const std::lock_guard lock(feed_.mutex_);
  feed_.state_.seen = std::move(summary);
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
  const std::lock_guard lock(feed_.mutex_);
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

/// While it records: what was seen of the object so far, on the picture itself.
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
