#include <algorithm>
#include <turnscan/core/median.hpp>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/turntable/motion_joining/relative_yaw.hpp>
#include <turnscan/turntable/table_frame.hpp>

namespace turnscan::motion {

namespace {

constexpr std::size_t kModelSamples = 24000;
constexpr double kTransferredAngleSigma_rad = 2e-4;  // of angles taken from another sensor

TurntableInfo table_of(const Pose& T_table_sensor) {
  TurntableInfo table;
  table.axis = T_table_sensor.linear().transpose() * Vec3d::UnitY();
  table.center_m = T_table_sensor.inverse() * Vec3d::Zero();
  return table;
}

/// The frames of one sensor as a recording of its own.
SequenceView frames_of_sensor(const FrameSequence& sequence, std::uint32_t sensor) {
  SequenceHeader header = sequence.header();
  const SensorInfo info = header.sensors[sensor];
  header.sensors = {info};
  if (sensor != 0) {
    header.turntable.reset();
    if (info.T_table_sensor) header.turntable = table_of(*info.T_table_sensor);
    if (header.turntable && sequence.header().turntable) {
      header.turntable->radius_m = sequence.header().turntable->radius_m;
      header.turntable->speed_rad_s = sequence.header().turntable->speed_rad_s;
    }
  }
  std::vector<std::size_t> positions;
  std::vector<FrameInfo> frames;
  for (std::size_t i = 0; i < sequence.frames().size(); ++i) {
    if (sequence.frames()[i].sensor != sensor) continue;
    positions.push_back(i);
    frames.push_back(sequence.frames()[i]);
    frames.back().sensor = 0;
  }
  SequenceView out(sequence, std::move(positions));
  out.set_header(std::move(header));
  out.set_frames(std::move(frames));
  return out;
}

/// Common parameter of the angles of different sensors' frames: their times, or else the recorded
/// angles.
std::optional<double> moment_of(const FrameInfo& frame, bool timed) {
  if (timed) return frame.time_s;
  return frame.angle_rad;
}

/// Angles as a function of moments.
struct AngleCurve {
  std::vector<double> moment, angle;  ///< moments increase

  double at(double m) const {
    const auto next = std::upper_bound(moment.begin(), moment.end(), m);
    const auto b =
        std::clamp<std::ptrdiff_t>(next - moment.begin(), 1, std::ptrdiff_t(moment.size()) - 1);
    const auto j = std::size_t(b), i = j - 1;
    const double share = (m - moment[i]) / std::max(moment[j] - moment[i], 1e-12);
    return angle[i] + share * (angle[j] - angle[i]);
  }
  bool covers(double m) const { return m >= moment.front() && m <= moment.back(); }
};

bool determines(const Calibration& c, const char* what) {
  return std::find(c.undetermined.begin(), c.undetermined.end(), what) == c.undetermined.end();
}

class SensorMerger {
 public:
  SensorMerger(const FrameSequence& sequence, const FromMotionOptions& options,
               const DetectOptions& detect, const RunContext& context)
      : sequence_(sequence), options_(options), detect_(detect), context_(context) {
    for (std::uint32_t k = 0; k < sequence.header().sensors.size(); ++k)
      views_.push_back(frames_of_sensor(sequence, k));
    timed_ = std::all_of(sequence.frames().begin(), sequence.frames().end(),
                         [](const FrameInfo& f) { return std::isfinite(f.time_s); });
  }

  Result<Calibration> run() {
    TURNSCAN_TRY(check_moments());
    TURNSCAN_TRY(calibrate_each());
    Calibration out = found_[0]->calibration;
    for (TableSlip& slip : out.slips) slip.first_frame = views_[0].positions()[slip.first_frame];
    out.angles_rad.assign(sequence_.frames().size(), 0.0);
    out.angle_sigma_rad.assign(sequence_.frames().size(), std::nan(""));
    put_angles(0, 0.0, out);
    const AngleCurve curve = curve_of(0);
    for (std::size_t k = 1; k < views_.size(); ++k) {
      align_direction(k);
      const double zero = zero_of(k, curve);
      put_angles(k, zero, out);
      TURNSCAN_TRY(put_place(k, zero, out));
    }
    take_best_speed(out);
    return out;
  }

 private:
  Result<> check_moments() const {
    if (timed_) return {};
    for (const FrameInfo& frame : sequence_.frames()) {
      if (!frame.angle_rad)
        return fail(ErrorCode::kMissingData,
                    "motion of several sensors: frame {} has neither time nor angle, which tell "
                    "what the sensors saw together",
                    frame.index);
    }
    return {};
  }

  tl::unexpected<Error> of_sensor(std::size_t k, Error error) const {
    if (error.code != ErrorCode::kCancelled)
      error.message = fmt::format("sensor {}: {}", k, error.message);
    return tl::unexpected<Error>(std::move(error));
  }

  /// Calibrates each sensor separately; those that do not observe the rotation get the angles of
  /// one that does.
  Result<> calibrate_each() {
    std::vector<std::optional<Error>> errors(views_.size());
    found_.resize(views_.size());
    for (std::size_t k = 0; k < views_.size(); ++k) {
      auto one = calibrate_sensor(views_[k], options_, detect_, kModelSamples, context_);
      if (one) {
        found_[k] = std::move(*one);
      } else if (one.error().code == ErrorCode::kCancelled) {
        return tl::unexpected<Error>(one.error());
      } else {
        errors[k] = one.error();
      }
    }
    const auto seer = std::find_if(found_.begin(), found_.end(), [](const auto& f) {
      return f && determines(f->calibration, "angles");
    });
    for (std::size_t k = 0; k < views_.size(); ++k) {
      if (found_[k] && determines(found_[k]->calibration, "angles")) continue;
      if (seer == found_.end()) {
        if (errors[k]) return of_sensor(k, *errors[k]);
        continue;
      }
      const AngleCurve curve = curve_of(std::size_t(seer - found_.begin()));
      auto again = with_angles_of(curve, k);
      if (!again) return of_sensor(k, again.error());
      found_[k] = std::move(*again);
    }
    return {};
  }

  Result<SensorMotion> with_angles_of(const AngleCurve& curve, std::size_t k) {
    std::vector<FrameInfo> frames = views_[k].frames();
    const double zero = curve.at(*moment_of(frames[0], timed_));
    for (FrameInfo& frame : frames) frame.angle_rad = curve.at(*moment_of(frame, timed_)) - zero;
    views_[k].set_frames(std::move(frames));
    FromMotionOptions options = options_;
    options.use_angles = true;
    options.angle_sigma_rad = kTransferredAngleSigma_rad;
    return calibrate_sensor(views_[k], options, detect_, kModelSamples, context_);
  }

  AngleCurve curve_of(std::size_t k) const {
    AngleCurve out;
    const auto& frames = sequence_.frames();
    const auto& positions = views_[k].positions();
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const double m = *moment_of(frames[positions[i]], timed_);
      if (!out.moment.empty() && m <= out.moment.back()) continue;
      out.moment.push_back(m);
      out.angle.push_back(found_[k]->calibration.angles_rad[i]);
    }
    return out;
  }

  /// Seen from below, a table turns in the opposite direction.
  void align_direction(std::size_t k) {
    auto& own = *found_[k];
    const double first = found_[0]->calibration.angles_rad.back(),
                 second = own.calibration.angles_rad.back();
    if (first * second >= 0.0) return;
    own.calibration.table.axis *= -1.0;
    for (double& a : own.calibration.angles_rad) a = -a;
    // The table's frame of the opposite axis: half a turn about Z.
    for (SurfaceSample& s : own.model) {
      s.p = Vec3f(-s.p.x(), -s.p.y(), s.p.z());
      s.n = Vec3f(-s.n.x(), -s.n.y(), s.n.z());
    }
    own.platter = false;
  }

  /// The first sensor's angle at this one's angle 0: the median over its frames.
  double zero_of(std::size_t k, const AngleCurve& curve) const {
    const auto& positions = views_[k].positions();
    std::vector<double> all, inside;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const double m = *moment_of(sequence_.frames()[positions[i]], timed_);
      const double off = curve.at(m) - found_[k]->calibration.angles_rad[i];
      all.push_back(off);
      if (curve.covers(m)) inside.push_back(off);
    }
    return inside.empty() ? median(all) : median(inside);
  }

  void put_angles(std::size_t k, double zero, Calibration& out) const {
    const auto& positions = views_[k].positions();
    const Calibration& own = found_[k]->calibration;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      out.angles_rad[positions[i]] = own.angles_rad[i] + zero;
      out.angle_sigma_rad[positions[i]] = own.angle_sigma_rad[i];
    }
  }

  Result<> put_place(std::size_t k, double zero, Calibration& out) {
    SensorMotion& own = *found_[k];
    // At the first sensor's angle 0.
    const Pose back = rotation_about_y(-zero);
    for (SurfaceSample& s : own.model) {
      s.p = (back * s.p.cast<double>()).cast<float>();
      s.n = (back.linear() * s.n.cast<double>()).cast<float>();
    }
    auto heading = find_relative_yaw(*found_[0], own, context_);
    if (!heading) return of_sensor(k, heading.error());
    TURNSCAN_ASSIGN(const Pose T_own, table_from_sensor(own.calibration.table));
    SensorPlace place;
    place.T_table_sensor = heading->pose() * back * T_own;
    place.heading_sigma_rad = heading->determined ? heading->turn_sigma_rad : std::nan("");
    place.shift_sigma_m = std::hypot(heading->height_sigma_m, own.calibration.center_sigma_m);
    place.found = fmt::format("the object that both sensors see, {:.2f} mm RMS between them",
                              heading->rms_m * 1e3);
    if (!heading->determined) {
      const std::string name = fmt::format("heading of sensor {}", k);
      out.undetermined.push_back(name);
      out.notes.push_back(name + ": the object looks the same from several sides");
    }
    for (const std::string& note : own.calibration.notes)
      out.notes.push_back(fmt::format("sensor {}: {}", k, note));
    out.others.push_back(std::move(place));
    return {};
  }

  void take_best_speed(Calibration& out) const {
    for (const auto& one : found_) {
      const Calibration& c = one->calibration;
      if (!c.table.speed_rad_s || !determines(c, "speed")) continue;
      if (c.speed_sigma_rad_s < out.speed_sigma_rad_s || !std::isfinite(out.speed_sigma_rad_s)) {
        out.table.speed_rad_s = c.table.speed_rad_s;
        out.speed_sigma_rad_s = c.speed_sigma_rad_s;
      }
    }
  }

  const FrameSequence& sequence_;
  const FromMotionOptions& options_;
  const DetectOptions& detect_;
  const RunContext& context_;
  std::vector<SequenceView> views_;
  bool timed_ = true;
  std::vector<std::optional<SensorMotion>> found_;
};

}  // namespace

Result<Calibration> calibrate_sensors(const FrameSequence& sequence,
                                      const FromMotionOptions& options, const DetectOptions& detect,
                                      const RunContext& context) {
  return SensorMerger(sequence, options, detect, context).run();
}

}  // namespace turnscan::motion
