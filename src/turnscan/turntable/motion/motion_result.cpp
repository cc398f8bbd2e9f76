#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/turntable/clouds/cloud_convention.hpp>
#include <turnscan/turntable/clouds/turning_disc.hpp>
#include <turnscan/turntable/motion/axis.hpp>
#include <turnscan/turntable/motion/motion_result.hpp>
#include <turnscan/turntable/motion/pair_residuals.hpp>
#include <turnscan/turntable/motion_input/object_base.hpp>
#include <turnscan/turntable/table_frame.hpp>

namespace turnscan::motion {

namespace {

/// Accuracy of the standing height from where an object's surface ends, as the larger of a length
/// and a multiple of the noise, and where it spreads into a desk (bench/first_looks, 28 rigs: rms
/// 2.0 mm, 0.9 deviations, at most 1.9).
constexpr double kBaseSigma_m = 0.0015, kBaseNoises = 1.0, kSpreadingBaseSigma_m = 0.02;
/// Additional uncertainty, relative to its extent, if nothing is seen below it: a round or hollow
/// base is occluded from above, and thin feet cannot be distinguished from mixed pixels.
constexpr double kHiddenBase = 0.03;
/// Accuracy of the platter's height that the recording states.
constexpr double kRecordedHeight_m = 0.01;
/// Shift by a sensor that filters over its pixels, relative to the distance between pixels times
/// the square of the share of pixels along outlines (bench/random_rigs, 47 rigs with a Kinect v2's
/// physics: 0.17 where that share is 0.55, 0.05 where it is 0.32).
constexpr double kFilteredShift = 0.55;
/// Minimum number of frames for a speed, minus one.
constexpr std::size_t kMinStretch = 3;
/// Minimum share of the frames outside slips and halts, which are short: else the table turns
/// unevenly.
constexpr double kMinSteady = 0.6;

class Publication {
 public:
  Publication(const MotionData& data, const RefinedMotion& motion, const FrameSequence& sequence,
              const FromMotionOptions& options)
      : data_(data),
        motion_(motion),
        solution_(motion.solution),
        state_(motion.solution.state),
        sequence_(sequence),
        options_(options) {}

  Result<Calibration> run() {
    if (mean_pair_cost(data_, state_) > 0.85 ||
        solution_.scale_m > std::max({0.003, 4.0 * data_.noise_m, 2.0 * data_.spacing_m}))
      return fail(ErrorCode::kLibrary,
                  "motion: no axis was found about which the frames fit; calibrate with --detect "
                  "or --points, or take more frames a turn");
    TURNSCAN_TRY(check_handedness(sequence_.header().sensors.front(), state_.axis, data_.middle,
                                  data_.extent_m));
    Calibration out;
    out.method = CalibrationMethod::kMotion;
    out.residual_rms_m = solution_.rms_m;
    out.notes = data_.notes;
    set_axis(out);
    TURNSCAN_TRY(set_height(out));
    set_angles(out);
    if (motion_.source == AngleSource::kTimes) set_speed(out);
    if (motion_.prior.nominal_sign < 0.0)
      out.notes.emplace_back(
          "the recorded angles count clockwise seen from above: the frames fit "
          "when their sign is changed");
    if (!data_.projective && !sequence_.header().turntable)
      out.notes.push_back(convention_text(state_.axis, data_.to_sensor));
    return out;
  }

 private:
  void set_axis(Calibration& out) const {
    out.table.axis = state_.axis;
    // In addition to noise: the shift by smoothing and mixed pixels at silhouettes, a few
    // hundredths of a pixel, and for the tilt a hundredth relative to the object's size. A sensor
    // that filters over its pixels also mixes those beside the outline (random_rigs: ten times as
    // much), and the shift increases the thinner the object is in its image.
    const double filtered = data_.correlated_noise ? 1.0 : 0.0;
    const double shift =
        std::hypot(0.03, kFilteredShift * std::pow(1.0 - data_.inner_share, 2)) * data_.spacing_m;
    double tilt = (0.01 + 0.09 * filtered) * data_.spacing_m / data_.extent_m;
    if (data_.platter) tilt = std::min(tilt, platter_axis_sigma_rad(*data_.platter));
    const auto& c = solution_.covariance;
    out.axis_sigma_rad = std::sqrt(c(0, 0) + c(1, 1) + tilt * tilt);
    out.center_sigma_m = std::sqrt(c(2, 2) + c(3, 3) + shift * shift);
    const std::string how = fmt::format("motion of {} frames, {} distances between them",
                                        data_.frames.size(), solution_.residuals);
    out.axis_found = out.center_found = how;
    if (out.axis_sigma_rad > 1.0 * kRadiansPerDegree) out.undetermined.emplace_back("axis");
    if (out.center_sigma_m > 0.003) out.undetermined.emplace_back("centre");
  }

  /// The height at which the axis meets the platter's surface, or else that of the object's lowest
  /// points.
  Result<> set_height(Calibration& out) const {
    if (data_.platter) {
      set_platter(*data_.platter, out);
      return {};
    }
    TurntableInfo axis;
    axis.axis = state_.axis, axis.center_m = state_.center;
    TURNSCAN_ASSIGN(const ObjectBase base, find_base(data_, axis, state_.angle, sequence_));
    const auto& table = sequence_.header().turntable;
    const auto disc =
        data_.projective ? std::nullopt : find_turning_disc(data_, axis, state_.angle);
    if (table && options_.use_table && table->radius_m)
      set_recorded_platter(*table, base, out);
    else if (disc)
      set_disc(*disc, out);
    else
      set_object(base, out);
    return {};
  }

  void set_platter(const DetectedPlatter& p, Calibration& out) const {
    const double along = p.axis.dot(p.center_m - state_.center) / p.axis.dot(state_.axis);
    out.table.center_m = state_.center + along * state_.axis;
    out.table.radius_m = p.radius_m;
    out.radius_sigma_m = p.radius_sigma_m;
    out.height_sigma_m = p.height_sigma_m;
    out.rim_share = p.rim_share;
    out.confidence = p.confidence;
    out.height_found = "the platter's surface";
    out.radius_found = "the platter's rim";
  }

  void set_disc(const TurningDisc& disc, Calibration& out) const {
    out.table.center_m = state_.center + disc.height_m * state_.axis;
    out.table.radius_m = disc.radius_m;
    out.height_sigma_m = disc.height_sigma_m;
    out.radius_sigma_m = disc.radius_sigma_m;
    out.rim_share = disc.rim_share;
    out.height_found = out.radius_found = "a level disc that turns";
  }

  void set_object(const ObjectBase& base, Calibration& out) const {
    out.table.center_m = state_.center + base.height_m * state_.axis;
    const double hidden = base.on_surface ? 0.0 : kHiddenBase * base.reach_m.value_or(0.0);
    out.height_sigma_m =
        base.ends ? std::hypot(std::max(kBaseSigma_m, kBaseNoises * data_.noise_m), hidden)
                  : kSpreadingBaseSigma_m;
    out.height_found = "the lowest points of what turns";
    if (!base.ends) out.undetermined.emplace_back("height");
    out.table.reach_m = base.reach_m;
  }

  /// Only surface above the recording's platter was used: the object may end elsewhere if it
  /// extends beyond it. Its lowest points give its base if they are about as high as that platter.
  void set_recorded_platter(const TurntableInfo& table, const ObjectBase& base,
                            Calibration& out) const {
    set_object(base, out);
    out.table.reach_m.reset();
    out.table.radius_m = table.radius_m;
    out.radius_found = "the recording's";
    const double upright = table.axis.normalized().dot(state_.axis);
    if (std::abs(upright) < 0.5) return;
    const double along = table.axis.normalized().dot(table.center_m - state_.center) / upright;
    if (base.ends && std::abs(base.height_m - along) < kRecordedHeight_m) return;
    out.table.center_m = state_.center + along * state_.axis;
    out.height_sigma_m = kRecordedHeight_m;
    out.height_found = "the recording's";
    if (base.ends) out.undetermined.emplace_back("height");
  }

  /// Frames of other sensors and dropped ones get their angles by time, or from their neighbours.
  void set_angles(Calibration& out) const {
    const auto& infos = sequence_.frames();
    out.angles_rad.assign(infos.size(), 0.0);
    out.angle_sigma_rad.assign(infos.size(), std::nan(""));
    std::size_t next = 0;
    for (std::size_t i = 0; i < infos.size(); ++i) {
      while (next < data_.frames.size() && data_.frames[next].position < i) ++next;
      if (next < data_.frames.size() && data_.frames[next].position == i) {
        out.angles_rad[i] = state_.angle[next];
        out.angle_sigma_rad[i] = next == 0 ? 0.0 : angle_sigma(next);
        continue;
      }
      out.angles_rad[i] = between(next, infos[i].time_s);
    }
    out.angles_found =
        motion_.turn_observable ? "motion of each frame" : "the law of the motor alone";
    if (!motion_.turn_observable || motion_.prior.unjoined) out.undetermined.emplace_back("angles");
    if (const auto& unjoined = motion_.prior.unjoined)
      out.notes.push_back(fmt::format(
          "views before and after {:.1f} s show no surface in common: how far the table turned "
          "between them is known to {:.0f} deg only; let it turn farther, or a second time",
          data_.frames[unjoined->frame].time_s, std::abs(unjoined->turn_rad) * kDegreesPerRadian));
  }

  /// Includes the shift by silhouettes, a few hundredths of a pixel, as for the axis.
  double angle_sigma(std::size_t i) const {
    const auto& unjoined = motion_.prior.unjoined;
    const double apart = unjoined && i >= unjoined->frame ? unjoined->turn_rad : 0.0;
    return std::hypot(apart, solution_.angle_sigma[i],
                      motion_.turn_observable ? 0.03 * data_.spacing_m / data_.extent_m : 0.0);
  }

  double between(std::size_t next, double time_s) const {
    const auto& frames = data_.frames;
    if (frames.size() < 2) return 0.0;
    const std::size_t b = std::clamp<std::size_t>(next, 1, frames.size() - 1), a = b - 1;
    const double span = frames[b].time_s - frames[a].time_s;
    const double share =
        std::isfinite(time_s) && span > 0.0 ? (time_s - frames[a].time_s) / span : 0.5;
    return state_.angle[a] + share * (state_.angle[b] - state_.angle[a]);
  }

  /// Frames during which the table turned evenly, and the sums of their regression line.
  struct Stretch {
    std::size_t first, last;
    double time_s = 0.0, angle_rad = 0.0;  ///< means
    double squares = 0.0, along = 0.0;     ///< of times, and of times with angles
  };

  Stretch regression(std::size_t first, std::size_t last) const {
    Stretch out{first, last};
    const double share = 1.0 / double(last - first + 1);
    for (std::size_t i = first; i <= last; ++i)
      out.time_s += share * data_.frames[i].time_s, out.angle_rad += share * state_.angle[i];
    for (std::size_t i = first; i <= last; ++i) {
      const double t = data_.frames[i].time_s - out.time_s;
      out.squares += t * t, out.along += t * (state_.angle[i] - out.angle_rad);
    }
    return out;
  }

  bool is_steady(std::size_t frame) const {
    const auto& transient = motion_.prior.transient;
    return transient.empty() || transient[frame] == 0;
  }

  bool slips_after(std::size_t frame) const {
    const auto& slips = motion_.prior.slips;
    return !slips.empty() && slips[frame] != 0;
  }

  /// The stretches between slips and halts; all frames if there are none.
  std::vector<Stretch> steady_stretches(std::size_t first, std::size_t last) const {
    std::vector<Stretch> out;
    for (std::size_t i = first; i <= last; ++i) {
      if (!is_steady(i)) continue;
      std::size_t end = i;
      while (end < last && is_steady(end + 1) && !slips_after(end)) ++end;
      if (end - i >= kMinStretch) out.push_back(regression(i, end));
      i = end;
    }
    if (out.empty()) out.push_back(regression(first, last));
    return out;
  }

  /// Slips, each placed at the largest of the steps between the frames that bracket it.
  std::vector<TableSlip> slips_beside(double speed_rad_s) const {
    const auto& frames = data_.frames;
    std::vector<TableSlip> out;
    for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
      if (!slips_after(i)) continue;
      TableSlip slip;
      double largest = 0.0;
      for (; i + 1 < frames.size() && slips_after(i); ++i) {
        const double turn = state_.angle[i + 1] - state_.angle[i] -
                            speed_rad_s * (frames[i + 1].time_s - frames[i].time_s);
        slip.turn_rad += turn;
        if (std::abs(turn) < largest) continue;
        largest = std::abs(turn);
        slip.first_frame = frames[i + 1].position;
      }
      out.push_back(slip);
    }
    return out;
  }

  /// Whether slips and halts take up much of the recording.
  bool uneven(std::size_t first, std::size_t last) const {
    const auto& transient = motion_.prior.transient;
    if (transient.empty() || last < first + 4 * kMinStretch) return false;
    const auto steady = std::count(transient.begin() + std::ptrdiff_t(first),
                                   transient.begin() + std::ptrdiff_t(last) + 1, 0);
    return double(steady) < kMinSteady * double(last - first + 1);
  }

  double slope(std::size_t a, std::size_t b) const {
    return (state_.angle[b] - state_.angle[a]) / (data_.frames[b].time_s - data_.frames[a].time_s);
  }

  /// Their common slope.
  static double speed_of(const std::vector<Stretch>& lines) {
    double along = 0.0, squares = 0.0;
    for (const Stretch& line : lines) along += line.along, squares += line.squares;
    return along / squares;
  }

  /// The angles of the steady stretches only, concatenated.
  std::vector<double> steady_angles(double speed_rad_s) const {
    std::vector<double> out = state_.angle;
    for (std::size_t i = 0; i + 1 < out.size(); ++i) {
      out[i + 1] = out[i] + state_.angle[i + 1] - state_.angle[i];
      if (slips_after(i) || !is_steady(i) || !is_steady(i + 1))
        out[i + 1] = out[i] + speed_rad_s * (data_.frames[i + 1].time_s - data_.frames[i].time_s);
    }
    return out;
  }

  /// Variance of the mean speed, from the speeds of the quarters.
  double variance_of_quarters(const std::vector<double>& angle, std::size_t first,
                              std::size_t last) const {
    double sum = 0.0, squares = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t a = first + k * (last - first) / 4,
                        b = first + (k + 1) * (last - first) / 4;
      const double speed =
          (angle[b] - angle[a]) / (data_.frames[b].time_s - data_.frames[a].time_s);
      sum += speed, squares += speed * speed;
    }
    return std::max(0.0, squares / 4.0 - sum * sum / 16.0) / 3.0;
  }

  /// Standard deviation of the speed: from the errors of the angles, and from its variation beyond
  /// them. lines: whose slope it is; angle: from first to last, without the excluded parts.
  double speed_sigma(double angle_sigma_rad, const std::vector<Stretch>& lines,
                     const std::vector<double>& angle, std::size_t first, std::size_t last) const {
    double spans = 0.0;
    for (const Stretch& line : lines)
      spans += std::pow(data_.frames[line.last].time_s - data_.frames[line.first].time_s, 2);
    const double seconds = data_.frames[last].time_s - data_.frames[first].time_s;
    // Contribution of the angles' errors to the quarters, each of which has two.
    const double of_angles = 8.0 * std::pow(angle_sigma_rad / seconds, 2);
    const double quarters =
        last < first + 4 * kMinStretch ? 0.0 : variance_of_quarters(angle, first, last);
    return std::sqrt(angle_sigma_rad * angle_sigma_rad / spans +
                     std::max(0.0, quarters - of_angles));
  }

  /// The steady speed: the slope of the angles over time once the table runs, without slips and
  /// halts; if the table turns unevenly, the mean speed. And the moment at which that line left the
  /// angle at which the table stood.
  void set_speed(Calibration& out) const {
    const auto& frames = data_.frames;
    const std::size_t n = frames.size();
    const double middle = slope(n / 4, 3 * n / 4);
    // The table runs from where a stretch of a twentieth has nearly the steady speed.
    const std::size_t stretch = std::max<std::size_t>(1, n / 20);
    std::size_t first = 0, last = n - 1;
    while (first + stretch < n / 4 && slope(first, first + stretch) / middle < 0.93) ++first;
    while (last > stretch + 3 * n / 4 && slope(last - stretch, last) / middle < 0.93) --last;
    const bool mean = uneven(first, last);
    const auto lines = mean ? std::vector{regression(first, last)} : steady_stretches(first, last);
    double sigma = 0.0;
    const double speed = mean ? slope(first, last) : speed_of(lines);
    out.table.speed_rad_s = speed;
    out.slips = slips_beside(speed);
    for (std::size_t i = first; i <= last; ++i) sigma = std::max(sigma, solution_.angle_sigma[i]);
    out.speed_sigma_rad_s =
        speed_sigma(sigma, lines, mean ? state_.angle : steady_angles(speed), first, last);
    out.speed_found = !motion_.turn_observable ? "stated"
                      : mean                   ? "mean of an uneven turn"
                                               : "slope of the angles over time";
    if (!motion_.turn_observable) {
      out.undetermined.emplace_back("speed");
      out.speed_sigma_rad_s = std::nan("");
    }
    // The intersection of the line with angle 0.
    const double start = lines.front().time_s - lines.front().angle_rad / speed;
    out.start_s = first == 0 ? frames.front().time_s : start;
  }

  const MotionData& data_;
  const RefinedMotion& motion_;
  const MotionSolution& solution_;
  const MotionState& state_;
  const FrameSequence& sequence_;
  const FromMotionOptions& options_;
};

/// At most about max_samples, evenly spread over the samples of all frames, rotated back to angle
/// 0.
std::vector<SurfaceSample> samples_at_zero(const MotionData& data, const MotionState& state,
                                           const Pose& T_table_sensor, std::size_t max_samples) {
  std::vector<SurfaceSample> out;
  std::size_t all = 0;
  for (const MotionFrame& frame : data.frames) all += frame.samples.size();
  const std::size_t stride = std::max<std::size_t>(1, all / max_samples);
  std::size_t next = stride / 2;
  for (std::size_t i = 0; i < data.frames.size(); ++i) {
    const auto& samples = data.frames[i].samples;
    const Pose T = rotation_about_y(-state.angle[i]) * T_table_sensor;
    for (; next < samples.size(); next += stride) {
      SurfaceSample s = samples[next];
      s.p = (T * s.p.cast<double>()).cast<float>();
      s.n = (T.linear() * s.n.cast<double>()).cast<float>();
      out.push_back(s);
    }
    next -= samples.size();
  }
  return out;
}

}  // namespace

Result<Calibration> to_calibration(const MotionData& data, const RefinedMotion& motion,
                                   const FrameSequence& sequence,
                                   const FromMotionOptions& options) {
  return Publication(data, motion, sequence, options).run();
}

Result<SensorMotion> with_model(Calibration calibration, const MotionData& data,
                                const MotionState& state, std::size_t max_samples) {
  SensorMotion out;
  out.noise_m = data.noise_m;
  out.spacing_m = data.spacing_m;
  out.platter = data.platter.has_value();
  if (max_samples > 0) {
    TURNSCAN_ASSIGN(const Pose T_table_sensor, table_from_sensor(calibration.table));
    out.model = samples_at_zero(data, state, T_table_sensor, max_samples);
  }
  out.calibration = std::move(calibration);
  return out;
}

}  // namespace turnscan::motion
