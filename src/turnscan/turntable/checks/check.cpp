#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/median.hpp>
#include <turnscan/turntable/checks/check.hpp>
#include <turnscan/turntable/checks/motor_check.hpp>
#include <turnscan/turntable/checks/recorded_angles.hpp>
#include <turnscan/turntable/detection/plane_fit.hpp>

namespace turnscan::checks {

namespace {

constexpr double kAnglesWithin_deg = 1.5;

class RecordingCheck {
 public:
  RecordingCheck(const FrameSequence& sequence, const CheckOptions& options,
                 const RunContext& context)
      : sequence_(sequence), options_(options), context_(context) {}

  Result<std::vector<Finding>> run() {
    TURNSCAN_TRY(check_closure());
    TURNSCAN_TRY(check_drift());
    auto found = calibrate_from_motion(sequence_, options_.motion, options_.detect, context_);
    if (!found) {
      if (found.error().code == ErrorCode::kCancelled) return tl::unexpected<Error>(found.error());
      say(Rating::kWrong, "Motion: {}.", found.error().message);
      return std::move(findings_);
    }
    check_place(*found);
    check_direction(*found);
    check_speed(*found);
    check_angles(*found);
    TURNSCAN_TRY(check_turning(*found));
    return std::move(findings_);
  }

 private:
  template <class... Args>
  void say(Rating rating, fmt::format_string<Args...> format, Args&&... args) {
    findings_.push_back({rating, fmt::format(format, std::forward<Args>(args)...)});
  }

  Result<> check_closure() {
    auto closure = measure_closure(sequence_, context_);
    if (!closure) {
      if (closure.error().code != ErrorCode::kMissingData)
        return tl::unexpected<Error>(closure.error());
      say(Rating::kNotKnown, "Closure: {}, so that nothing can be said.", closure.error().message);
      return {};
    }
    if (!*closure) {
      say(Rating::kNotKnown,
          "Closure: the recording does not come back to a view that it had before, so that "
          "nothing can be said.");
      return {};
    }
    const ClosureError& e = **closure;
    say(rating_of(!e.significant()),
        "Closure: one turn later the object lies {} from where it was ({} pairs of frames; {}).{}",
        e.offset_text(), e.pairs, e.noise_text(),
        e.significant() ? " Axis, centre or speed of the recording are wrong." : "");
    return {};
  }

  /// Compares the mean depth of static pixels in the first and the last tenth of the frames.
  Result<> check_drift() {
    if (sequence_.header().sensors.front().kind != SensorKind::kDepthCamera) return {};
    const auto all = spread_positions(sequence_, 0, sequence_.frames().size());
    const std::size_t n = std::clamp<std::size_t>(all.size() / 10, 1, 20);
    if (all.size() < 8) return {};
    TURNSCAN_ASSIGN(
        const AveragedScan first,
        average_frames(sequence_, {all.begin(), all.begin() + std::ptrdiff_t(n)}, {}, context_));
    TURNSCAN_ASSIGN(
        const AveragedScan last,
        average_frames(sequence_, {all.end() - std::ptrdiff_t(n), all.end()}, {}, context_));
    TURNSCAN_ASSIGN(const AveragedScan whole,
                    average_frames(sequence_, spread_positions(sequence_, 0, 30), {}, context_));
    const detection::ScanPixels pixels = detection::pixels_of(whole);
    std::vector<double> moved;
    for (std::size_t i = 0; i < pixels.still.size(); ++i) {
      const float a = first.depth_m.pixels[i], b = last.depth_m.pixels[i];
      if (pixels.still[i] && a > 0.0f && b > 0.0f && std::abs(b - a) < 0.03f)
        moved.push_back(double(b) - double(a));
    }
    if (moved.size() < 500) return {};
    const double drift = median(moved);
    const bool good = std::abs(drift) < 0.001;
    say(rating_of(good),
        "Warm-up: what stands still moved by {:+.2f} mm from the first frames to the last.{}",
        drift * 1e3, good ? "" : " The sensor was still warming up; let it run for half an hour.");
    return {};
  }

  void check_place(const Calibration& found) {
    const auto& table = sequence_.header().turntable;
    if (!table) {
      say(Rating::kNotKnown,
          "Place: the recording does not say where the turntable is; its motion does.");
      return;
    }
    const Vec3d a = table->axis.normalized(), b = found.table.axis;
    const double tilt = std::atan2(a.cross(b).norm(), a.dot(b)) * kDegreesPerRadian;
    const Vec3d off = table->center_m - found.table.center_m;
    const double aside = (off - off.dot(b) * b).norm() * 1e3;
    const bool good = tilt < 0.5 && aside < 1.5;
    say(rating_of(good),
        "Place: the recorded axis leans by {:.2f} deg and lies {:.2f} mm beside the one that "
        "the motion shows.",
        tilt, aside);
  }

  bool determined(const Calibration& found, const char* what) const {
    const auto& list = found.undetermined;
    return std::find(list.begin(), list.end(), what) == list.end();
  }

  void check_direction(const Calibration& found) {
    if (!determined(found, "angles")) {
      say(Rating::kNotKnown,
          "Direction: the object looks the same from all sides, so that nothing can be said.");
      return;
    }
    const auto angle = recorded_angles(sequence_);
    const double recorded = angle.back(), seen = found.angles_rad.back();
    if (!std::isfinite(recorded) || std::abs(seen) < 0.05) return;
    const bool good = recorded * seen > 0.0;
    say(rating_of(good), "Direction: seen from above the platter turns {}clockwise{}.",
        seen > 0.0 ? "counter-" : "",
        good ? ", as recorded" : ", but the recording says the opposite: everything is mirrored");
  }

  void check_speed(const Calibration& found) {
    std::optional<double> stated = options_.motion.speed_rad_s;
    const auto& table = sequence_.header().turntable;
    if (!stated && table) stated = table->speed_rad_s;
    if (!stated || !found.table.speed_rad_s || !determined(found, "speed")) return;
    const double ratio = *found.table.speed_rad_s / *stated;
    const bool good = std::abs(ratio - 1.0) < 0.005;
    say(rating_of(good), "Speed: stated are {:.4f} deg/s, the data show {:.4f} deg/s{}.",
        *stated * kDegreesPerRadian, *found.table.speed_rad_s * kDegreesPerRadian,
        good ? "" : fmt::format(", {:+.2f} % off", 100.0 * (ratio - 1.0)));
  }

  /// Compares the angles recorded with every frame, e.g. by an encoder, with those of the motion.
  void check_angles(const Calibration& found) {
    const auto& frames = sequence_.frames();
    const bool has_angles = std::all_of(frames.begin(), frames.end(),
                                        [](const FrameInfo& f) { return f.angle_rad.has_value(); });
    if (!has_angles || !determined(found, "angles")) return;
    std::vector<double> off;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const double recorded = *frames[i].angle_rad - *frames[0].angle_rad;
      const double sign = recorded * found.angles_rad[i] < 0.0 ? -1.0 : 1.0;
      off.push_back(std::abs(sign * recorded - found.angles_rad[i]) * kDegreesPerRadian);
    }
    // A plate seen edge on hardly shows its rotation: some frames may be far off.
    std::sort(off.begin(), off.end());
    const double most = off[off.size() * 9 / 10];
    say(rating_of(most < kAnglesWithin_deg),
        "Angles: of nine in ten frames the recorded ones lie within {:.2f} deg of those that the "
        "motion shows.",
        most);
  }

  /// Checks for slips and stops.
  Result<> check_turning(const Calibration& found) {
    if (!determined(found, "angles")) {
      say(Rating::kNotKnown,
          "Motor: the object looks the same from all sides, so that nothing can be said.");
      return {};
    }
    TURNSCAN_ASSIGN(auto findings, check_motor(sequence_, options_, found, context_));
    std::move(findings.begin(), findings.end(), std::back_inserter(findings_));
    return {};
  }

  const FrameSequence& sequence_;
  const CheckOptions& options_;
  const RunContext& context_;
  std::vector<Finding> findings_;
};

}  // namespace

}  // namespace turnscan::checks

namespace turnscan {

Result<std::vector<Finding>> check_recording(const FrameSequence& sequence,
                                             const CheckOptions& options,
                                             const RunContext& context) {
  return checks::RecordingCheck(sequence, options, context).run();
}

}  // namespace turnscan
