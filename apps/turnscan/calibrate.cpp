#include <array>
#include <turnscan/capture/device_calibration.hpp>
#include <turnscan/capture/taken_frames.hpp>
#include <turnscan/io/iai_kinect2.hpp>
#include <turnscan/recording/calibration_file.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/turntable/check.hpp>
#include <turnscan/turntable/depth_bias.hpp>
#include <turnscan/turntable/detect.hpp>
#include <turnscan/turntable/gauge_ball.hpp>
#include <turnscan/turntable/motion.hpp>
#include <turnscan/turntable/picked_points.hpp>

#include "calibration_text.hpp"
#include "command_line.hpp"
#include "commands.hpp"
#include "output_file.hpp"
#include "pick_file.hpp"

namespace turnscan::cli {

namespace {

/// A recording with other cameras and depth.
class Corrected : public FrameSequence {
 public:
  static Result<Corrected> of(const FrameSequence& sequence, const Calibration& correction) {
    Corrected out(sequence);
    TURNSCAN_TRY(correct_sensors(correction, out.header_.sensors));
    return out;
  }
  const SequenceHeader& header() const override { return header_; }
  const std::vector<FrameInfo>& frames() const override { return sequence_->frames(); }
  Result<Frame> read(std::size_t position) const override { return sequence_->read(position); }

 private:
  explicit Corrected(const FrameSequence& sequence)
      : sequence_(&sequence), header_(sequence.header()) {}

  const FrameSequence* sequence_;
  SequenceHeader header_;
};

constexpr int kFramesForMotion = 920;  // about a turn; half a minute at 30 frames a second
constexpr int kFramesForCheck = 10;

struct DeviceOptions {
  std::optional<int> frames;
};

OptionTable describe(DeviceOptions& o) {
  OptionTable table;
  table.number("device-frames", o.frames, {1, 20000},
               "How many frames are taken from the device; automatic: as many as are averaged, "
               "920 where motion is looked at, 10 with --check");
  return table;
}

class CalibrateCommand : public Command {
 public:
  void declare(CommandLine& line) override {
    line.optional_positional("RECORDING", recording_,
                             "Recording of the turntable (see turnscan import)");
    line.option(
        "--device", "URI", device_,
        "Take frames from a sensor instead (see turnscan devices); its calibration is kept, "
        "and used from then on. With --check: say whether the table has moved since");
    line.option("--points", "PICKS.csv", points_,
                "Use points on the platter's rim: columns x_mm,y_mm,z_mm (or _m) in the sensor's "
                "frame, or column,row of the averaged depth image");
    line.flag("--detect", detect_, "Find the platter's surface and rim in the averaged frames");
    line.flag("--from-motion", from_motion_,
              "Find axis, speed and angles from the motion of what stands on the platter");
    line.flag("--depth-bias", depth_bias_,
              "First find the constant offset of each sensor's depth, from --platter-radius or "
              "--gauge-ball");
    line.option("--depth-also", "RECORDING", depth_also_,
                "With --depth-bias: the same platter or ball at another distance, which tells the "
                "scale of the sensor's depth, too");
    line.repeatable(
        "--iai-kinect2", "FOLDER", iai_folders_,
        "First take cameras and depth offset from a Kinect v2 calibration in the layout "
        "of iai_kinect2; given again: of the next sensor of the recording");
    line.flag("--check", check_,
              "Look at closure, direction, speed, slips and warm-up of the recording, and say what "
              "is wrong; nothing is calibrated");
    line.option("--json", "FILE.json", json_, "Write the calibration with its standard deviations");
    line.option("--save", "FILE.json", save_,
                "Keep the calibration as a file for reconstruct --turntable (the same content)");
    line.allow_config();
    line.group("device", "Device", describe(device_options_));
    line.group("average", "Averaging", describe(average_));
    line.group("detect", "Detection", describe(detect_options_));
    line.group("gauge", "Gauge", describe(ball_options_));
    line.group("motion", "Motion", describe(motion_options_));
  }

  Result<> run(Session& session) override {
    if (int(!points_.empty()) + int(detect_) + int(from_motion_) > 1)
      return fail(ErrorCode::kInvalidOption,
                  "--points, --detect and --from-motion are different ways to calibrate; give one "
                  "of them");
    if (check_ && !(json_.empty() && save_.empty()))
      return fail(ErrorCode::kInvalidOption,
                  "--check makes no calibration; leave out --json and --save");
    if (!depth_also_.empty() && !depth_bias_)
      return fail(ErrorCode::kInvalidOption, "--depth-also says more to --depth-bias; give both");
    if (depth_bias_ && !detect_options_.radius_m && !ball_options_.diameter_m)
      return fail(ErrorCode::kInvalidOption,
                  "--depth-bias needs a known size; give --platter-radius or --gauge-ball");
    if (ball_options_.diameter_m && !depth_bias_)
      return fail(ErrorCode::kInvalidOption, "--gauge-ball is for --depth-bias; give both");
    if (recording_.empty() && device_.empty())
      return fail(ErrorCode::kInvalidOption, "RECORDING: missing; give it, or --device URI");
    if (!recording_.empty() && !device_.empty())
      return fail(ErrorCode::kInvalidOption,
                  "RECORDING and --device are both given; give one of them");
    TURNSCAN_TRY(check_output_file(json_, ".json"));
    TURNSCAN_TRY(check_output_file(save_, ".json"));
    if (!device_.empty()) return run_device(session);
    TURNSCAN_ASSIGN(const Recording recording, Recording::open(recording_));
    if (check_) return check(recording, session);
    TURNSCAN_TRY(calibrate_and_tell(recording, session));
    for (const std::string& note : recording.notes()) session.print("Note: {}\n", note);
    return {};
  }

 private:
  Result<> run_device(Session& session) {
    TURNSCAN_ASSIGN(const auto source, open_source(device_, session.context()));
    const std::string& identity = source->info().identities.front();
    if (check_) return check_device(*source, session);
    const auto count = static_cast<std::size_t>(device_options_.frames.value_or(
        detect_ || !points_.empty() ? average_.frames : kFramesForMotion));
    TURNSCAN_ASSIGN(const auto frames, take_frames(*source, count, session.context()));
    TURNSCAN_ASSIGN(const Calibration calibration, calibrate_and_tell(*frames, session));
    TURNSCAN_TRY(keep_calibration(identity, calibration));
    TURNSCAN_ASSIGN(const auto file, kept_calibration_file(identity));
    session.print("Kept for {} in {}\n", identity, file.string());
    return {};
  }

  /// Fails when the table has moved since it was calibrated.
  Result<> check_device(FrameSource& source, Session& session) const {
    const std::string& identity = source.info().identities.front();
    TURNSCAN_ASSIGN(const auto kept, kept_calibration(identity));
    if (!kept)
      return fail(ErrorCode::kMissingData,
                  "{}: it was never calibrated; run 'turnscan calibrate --device' without --check",
                  identity);
    const auto count = static_cast<std::size_t>(device_options_.frames.value_or(kFramesForCheck));
    TURNSCAN_ASSIGN(const auto frames, take_frames(source, count, session.context()));
    TURNSCAN_ASSIGN(
        const AveragedScan scan,
        average_frames(*frames, spread_positions(*frames, 0, count), average_, session.context()));
    TURNSCAN_ASSIGN(const RigCheck rig, check_rig(scan, *kept, session.context()));
    if (rig.moved) return fail(ErrorCode::kMissingData, "{}: {}", identity, rig.text);
    session.print("good   {}\n", rig.text);
    return {};
  }

  Result<Calibration> calibrate_and_tell(const FrameSequence& sequence, Session& session) {
    TURNSCAN_ASSIGN(const Calibration correction, sensor_correction(sequence, session));
    TURNSCAN_ASSIGN(const Corrected corrected, Corrected::of(sequence, correction));
    TURNSCAN_ASSIGN(Calibration found, calibrate(corrected, session));
    keep_corrections(correction, found);
    // What is shown is what the file gives back.
    TURNSCAN_ASSIGN(Calibration calibration, parse_calibration(calibration_json(found)));
    TURNSCAN_TRY(session.context().check());
    for (const std::string& path : {json_, save_}) {
      if (!path.empty()) TURNSCAN_TRY(write_calibration(path, calibration));
    }
    session.print("{}", calibration_text(calibration));
    for (const std::string& path : {json_, save_}) {
      if (!path.empty()) session.print("Wrote {}\n", path);
    }
    return calibration;
  }

  /// Fails when something is wrong, after saying what.
  Result<> check(const Recording& recording, Session& session) const {
    TURNSCAN_ASSIGN(
        const auto findings,
        check_recording(recording, {motion_options_, detect_options_}, session.context()));
    std::size_t wrong = 0;
    for (const Finding& finding : findings) {
      session.print("{}  {}\n", finding.good ? "good " : "WRONG", finding.text);
      wrong += finding.good ? 0 : 1;
    }
    if (wrong == 0) return {};
    return fail(ErrorCode::kMissingData,
                "{} of {} checks found something wrong; calibrate anew with 'turnscan calibrate'",
                wrong, findings.size());
  }

  /// Cameras and depth of the sensors; the rest of it says nothing.
  Result<Calibration> sensor_correction(const FrameSequence& recording, Session& session) const {
    const std::size_t sensors = recording.header().sensors.size();
    if (iai_folders_.size() > sensors)
      return fail(ErrorCode::kInvalidOption,
                  "--iai-kinect2 is given {} times, but the recording has {} sensor{}",
                  iai_folders_.size(), sensors, sensors == 1 ? "" : "s");
    Calibration out;
    out.others.resize(std::max<std::size_t>(sensors, 1) - 1);
    for (std::size_t k = 0; k < iai_folders_.size(); ++k) {
      TURNSCAN_ASSIGN(const Kinect2Calibration kinect, read_iai_kinect2(iai_folders_[k]));
      depth_of(out, k) = kinect.depth;
      (k == 0 ? out.camera : out.others[k - 1].camera) = kinect.camera;
    }
    if (!depth_bias_) return out;
    TURNSCAN_ASSIGN(const Corrected calibrated, Corrected::of(recording, out));
    const Calibration cameras = out;
    for (std::size_t k = 0; k < sensors; ++k) {
      auto depth = depth_from_gauge(calibrated, cameras, std::uint32_t(k), session);
      if (!depth && sensors > 1 && depth.error().code != ErrorCode::kCancelled)
        depth.error().message = fmt::format("sensor {}: {}", k, depth.error().message);
      TURNSCAN_ASSIGN(depth_of(out, k), std::move(depth));
    }
    return out;
  }

  static std::optional<DepthCorrection>& depth_of(Calibration& calibration, std::size_t sensor) {
    return sensor == 0 ? calibration.depth : calibration.others[sensor - 1].depth;
  }

  /// A way to calibrate that says nothing of the other sensors leaves no place for theirs.
  static void keep_corrections(const Calibration& correction, Calibration& found) {
    found.depth = correction.depth;
    found.camera = correction.camera;
    for (std::size_t k = 0; k < correction.others.size(); ++k) {
      const SensorPlace& other = correction.others[k];
      if (k < found.others.size()) {
        found.others[k].depth = other.depth;
        found.others[k].camera = other.camera;
      } else if (other.depth || other.camera) {
        found.notes.push_back(fmt::format(
            "sensor {}: its depth and camera are not kept, since only --from-motion tells where "
            "it stands",
            k + 1));
      }
    }
  }

  Result<DepthCorrection> depth_from_gauge(const FrameSequence& recording,
                                           const Calibration& cameras, std::uint32_t sensor,
                                           Session& session) const {
    TURNSCAN_ASSIGN(const DepthGauge here, gauge(recording, sensor, session));
    if (!depth_also_.empty()) {
      TURNSCAN_ASSIGN(const Recording opened, Recording::open(depth_also_));
      TURNSCAN_ASSIGN(const Corrected also, Corrected::of(opened, cameras));
      if (also.header().sensors.size() != recording.header().sensors.size())
        return fail(ErrorCode::kInvalidOption,
                    "--depth-also: the recordings have different numbers of sensors; record both "
                    "with the same ones");
      if (also.header().sensors[sensor].depth_unit_m !=
          recording.header().sensors[sensor].depth_unit_m)
        return fail(ErrorCode::kInvalidOption,
                    "--depth-also: the recordings have depth in different units; record both with "
                    "the same sensor");
      TURNSCAN_ASSIGN(const DepthGauge there, gauge(also, sensor, session));
      return fit_depth(std::array{here, there});
    }
    DepthCorrection out;
    out.bias_m = here.offset_m;
    out.bias_sigma_m = here.sigma_m;
    out.found = ball_options_.diameter_m
                    ? fmt::format("a ball of {}",
                                  format_quantity(*ball_options_.diameter_m, Quantity::kLength))
                    : fmt::format("the platter's rim, whose radius is {}",
                                  format_quantity(*detect_options_.radius_m, Quantity::kLength));
    return out;
  }

  /// By the ball where one is stated: its size is known better than a platter's.
  Result<DepthGauge> gauge(const FrameSequence& recording, std::uint32_t sensor,
                           Session& session) const {
    const double recorded_m = recording.header().sensors[sensor].depth_bias_m;
    TURNSCAN_ASSIGN(const AveragedScan scan, average(recording, session, sensor));
    if (!ball_options_.diameter_m)
      return gauge_depth(scan, *detect_options_.radius_m, recorded_m, detect_options_,
                         session.context());
    TURNSCAN_ASSIGN(const BallGauge ball, gauge_depth_with_ball(scan, *ball_options_.diameter_m,
                                                                recorded_m, session.context()));
    return ball.gauge;
  }

  Result<Calibration> calibrate(const FrameSequence& recording, Session& session) const {
    if (!points_.empty()) return from_points(recording, session);
    if (from_motion_) return motion(recording, session);
    if (detect_) return detected(recording, session);
    return automatic(recording, session);
  }

  Result<Calibration> motion(const FrameSequence& recording, Session& session) const {
    return calibrate_from_motion(recording, motion_options_, detect_options_, session.context());
  }

  Result<Calibration> detected(const FrameSequence& recording, Session& session) const {
    TURNSCAN_ASSIGN(const AveragedScan scan, average(recording, session));
    TURNSCAN_ASSIGN(const DetectedPlatter platter,
                    detect_platter(scan, detect_options_, session.context()));
    Calibration out = calibration_of(platter, scan);
    out.table.speed_rad_s = motion_options_.speed_rad_s;
    if (motion_options_.speed_rad_s) out.speed_found = "stated";
    return out;
  }

  /// From motion; where nothing turns or nothing about the turn can be seen, from the platter.
  Result<Calibration> automatic(const FrameSequence& recording, Session& session) const {
    auto moving = motion(recording, session);
    if (moving || moving.error().code == ErrorCode::kCancelled) return moving;
    auto still = detected(recording, session);
    if (!still) {
      if (still.error().code == ErrorCode::kCancelled) return still;
      return fail(ErrorCode::kMissingData, "neither motion nor platter: {} ({})",
                  moving.error().message, still.error().message);
    }
    still->notes.push_back("not from motion: " + moving.error().message);
    return still;
  }

  Result<AveragedScan> average(const FrameSequence& recording, Session& session,
                               std::uint32_t sensor = 0) const {
    return average_frames(recording,
                          spread_positions(recording, sensor, std::size_t(average_.frames)),
                          average_, session.context());
  }

  Result<Calibration> from_points(const FrameSequence& recording, Session& session) const {
    TURNSCAN_ASSIGN(const bool pixels, picks_pixels(points_));
    std::optional<AveragedScan> scan;
    if (pixels) {
      TURNSCAN_ASSIGN(scan, average(recording, session));
    }
    TURNSCAN_ASSIGN(const auto picks, read_picks(points_, scan ? &*scan : nullptr));
    const SensorInfo& sensor = recording.header().sensors.front();
    const Vec3d above =
        sensor.viewpoint.parallel ? Vec3d(1e6 * sensor.viewpoint.value) : sensor.viewpoint.value;
    auto calibration = calibrate_from_points(picks, above);
    if (!calibration) {
      // What the file holds is data, not the way the command was called.
      Error error = std::move(calibration).error();
      if (error.code == ErrorCode::kInvalidOption) error.code = ErrorCode::kFormat;
      error.path = points_;
      return tl::unexpected<Error>(std::move(error));
    }
    return calibration;
  }

  std::string recording_, device_, points_, json_, save_, depth_also_;
  std::vector<std::string> iai_folders_;
  DeviceOptions device_options_;
  bool detect_ = false, from_motion_ = false, check_ = false, depth_bias_ = false;
  AverageOptions average_;
  DetectOptions detect_options_;
  BallOptions ball_options_;
  FromMotionOptions motion_options_;
};

}  // namespace

std::unique_ptr<Command> make_calibrate_command() { return std::make_unique<CalibrateCommand>(); }

}  // namespace turnscan::cli
