#include <array>
#include <map>
#include <turnscan/capture/session/device_calibration.hpp>
#include <turnscan/capture/session/taken_frames.hpp>
#include <turnscan/recording/calibration_file.hpp>
#include <turnscan/recording/plausibility/plausibility.hpp>
#include <turnscan/turntable/checks/check.hpp>

#include <turnscan/workflow/calibration/calibrate_run.hpp>
#include <turnscan/workflow/input.hpp>
#include <turnscan/workflow/output_file.hpp>
#include <turnscan/workflow/progress/phase_plans.hpp>
#include <turnscan/workflow/text/calibration_text.hpp>
#include "cli/command_line.hpp"
#include "cli/commands.hpp"

namespace turnscan::cli {

namespace {

constexpr int kFramesForMotion = 920;  // about one turn; half a minute at 30 frames per second
constexpr int kFramesForCheck = 10;

struct DeviceOptions {
  std::optional<int> frames;
};

OptionTable describe(DeviceOptions& o) {
  OptionTable table;
  table.number("device-frames", o.frames, {1, 20000},
               "Number of frames to take from the device; automatic: as many as are averaged, 920 "
               "to calibrate from motion, 10 with --check");
  return table;
}

class CalibrateCommand : public Command {
 public:
  void declare(CommandLine& line) override {
    line.optional_positional(
        "RECORDING", recording_,
        "Recording of the turntable, or a file or folder of another program (see "
        "turnscan import)");
    line.repeatable("--import", "NAME=VALUE", import_, kImportOptionsHelp);
    line.option(
        "--device", "URI", device_,
        "Take the frames from a sensor instead (see turnscan devices); its calibration is stored, "
        "and used from then on. With --check: tell whether the table has moved since");
    line.option("--points", "PICKS.csv", request_.points,
                "Use points on the platter's rim: columns x_mm,y_mm,z_mm (or _m) in the sensor's "
                "frame, or column,row of the averaged depth image");
    line.flag("--detect", detect_, "Find the platter's surface and rim in the averaged frames");
    line.flag("--from-motion", from_motion_,
              "Find axis, speed and angles from the motion of what stands on the platter");
    line.flag("--depth-bias", request_.depth_bias,
              "First find the constant offset of each sensor's depth, from --platter-radius or "
              "--gauge-ball");
    line.option("--depth-also", "RECORDING", request_.depth_also,
                "With --depth-bias: a recording of the same platter or ball at another distance, "
                "which also determines the scale of the sensor's depth");
    line.repeatable("--iai-kinect2", "FOLDER", request_.iai_folders,
                    "First read the cameras and the depth offset from a Kinect v2 calibration in "
                    "the layout of iai_kinect2; given again, for the next sensor of the recording");
    line.flag("--check", check_,
              "Check closure, direction, speed, slips and sensor warm-up of the recording, and "
              "rate each as good, WRONG or not known; nothing is calibrated");
    line.option("--json", "FILE.json", json_, "Write the calibration with its standard deviations");
    line.option("--save", "FILE.json", save_,
                "Write the calibration to a file for reconstruct --turntable (the same content)");
    line.allow_config();
    line.group("device", "Device", describe(device_options_));
    line.group("average", "Averaging", describe(request_.average));
    line.group("detect", "Detection", describe(request_.detect));
    line.group("gauge", "Gauge", describe(request_.ball));
    line.group("motion", "Motion", describe(request_.motion));
    line.common({"device", "detect", "from-motion", "points", "platter-radius", "speed", "check",
                 "save", "json", "depth-bias", "import"});
  }

  FileRoles files() const override {
    FileRoles files{{recording_, request_.points, request_.depth_also}, {json_, save_}};
    files.inputs.insert(files.inputs.end(), request_.iai_folders.begin(),
                        request_.iai_folders.end());
    return files;
  }

  Result<> run(Session& session) override {
    TURNSCAN_ASSIGN(request_.way, calibration_way(!request_.points.empty(), detect_, from_motion_));
    if (check_ && !(json_.empty() && save_.empty()))
      return fail(ErrorCode::kInvalidOption,
                  "--check makes no calibration; leave out --json and --save");
    TURNSCAN_TRY(request_.check());
    if (recording_.empty() && device_.empty())
      return fail(ErrorCode::kInvalidOption, "RECORDING: missing; give it, or --device URI");
    if (!recording_.empty() && !device_.empty())
      return fail(ErrorCode::kInvalidOption,
                  "RECORDING and --device are both given; give one of them");
    if (!device_.empty() && !import_.empty())
      return fail(ErrorCode::kInvalidOption,
                  "--import is for files of other programs; leave it out with --device");
    session.plan(phases());
    TURNSCAN_TRY(check_output_file(json_, ".json"));
    TURNSCAN_TRY(check_output_file(save_, ".json"));
    if (!device_.empty()) return run_device(session);
    TURNSCAN_ASSIGN(const Input input, open_input_asking(recording_, import_, session.context()));
    if (check_) return check(*input.frames, session);
    TURNSCAN_TRY(calibrate_and_tell(*input.frames, session));
    for (const std::string& note : input.notes) session.print("Note: {}\n", note);
    return {};
  }

 private:
  PhasePlan phases() const {
    PhasePlan plan;
    if (!device_.empty()) plan = {{"open device", 1.0}, {"take frames", 30.0}};
    return joined({plan, request_.way == CalibrationWay::kPoints || detect_ ? platter_phases()
                                                                            : motion_phases()});
  }

  Result<> run_device(Session& session) {
    TURNSCAN_ASSIGN(const auto source, open_source(device_, session.context()));
    const std::string& identity = source->info().identities.front();
    if (check_) return check_device(*source, session);
    const auto count = static_cast<std::size_t>(device_options_.frames.value_or(
        detect_ || !request_.points.empty() ? request_.average.frames : kFramesForMotion));
    TURNSCAN_ASSIGN(const auto frames, take_frames(*source, count, session.context()));
    request_.made_at = date_of_calibration(source->info());
    TURNSCAN_ASSIGN(const Calibration calibration, calibrate_and_tell(*frames, session));
    TURNSCAN_TRY(keep_calibration(identity, calibration));
    TURNSCAN_ASSIGN(const auto file, kept_calibration_file(identity));
    session.print("Stored for {} in {}\n", identity, file.string());
    return {};
  }

  /// Fails if the table has moved since it was calibrated.
  Result<> check_device(FrameSource& source, Session& session) const {
    const std::string& identity = source.info().identities.front();
    TURNSCAN_ASSIGN(const auto kept, kept_calibration(identity));
    if (!kept)
      return fail(ErrorCode::kMissingData,
                  "{}: it was never calibrated; run 'turnscan calibrate --device' without --check",
                  identity);
    const auto count = static_cast<std::size_t>(device_options_.frames.value_or(kFramesForCheck));
    TURNSCAN_ASSIGN(const auto frames, take_frames(source, count, session.context()));
    TURNSCAN_ASSIGN(const AveragedScan scan,
                    average_frames(*frames, spread_positions(*frames, 0, count), request_.average,
                                   session.context()));
    TURNSCAN_ASSIGN(const RigCheck rig, check_rig(scan, *kept, session.context()));
    if (rig.moved) return fail(ErrorCode::kMissingData, "{}: {}", identity, rig.text);
    session.print("{:<9}  {}\n", word_of(Rating::kGood), rig.text);
    return {};
  }

  Result<Calibration> calibrate_and_tell(const FrameSequence& sequence, Session& session) {
    TURNSCAN_ASSIGN(Calibration calibration,
                    run_calibration(sequence, request_, session.context()));
    for (const std::string& path : {json_, save_}) {
      if (!path.empty()) TURNSCAN_TRY(write_calibration(path, calibration));
    }
    session.print("{}", calibration_text(calibration));
    for (const std::string& path : {json_, save_}) {
      if (!path.empty()) session.print("Wrote {}\n", path);
    }
    return calibration;
  }

  /// Fails if something is wrong, after reporting it.
  Result<> check(const FrameSequence& recording, Session& session) const {
    std::map<Rating, std::size_t> count;
    const auto tell = [&](Rating rating, const std::string& text) {
      session.print("{:<9}  {}\n", word_of(rating), text);
      ++count[rating];
    };
    TURNSCAN_ASSIGN(const auto implausible, find_implausible(recording, session.context()));
    for (const PlausibilityFinding& finding : implausible)
      tell(finding.level == Plausibility::kImplausible ? Rating::kWrong : Rating::kNotKnown,
           fmt::format("Data: {}.", finding.text));
    TURNSCAN_ASSIGN(
        const auto findings,
        check_recording(recording, {request_.motion, request_.detect}, session.context()));
    for (const Finding& finding : findings) tell(finding.rating, finding.text);
    if (count[Rating::kWrong] > 0)
      return fail(ErrorCode::kMissingData,
                  "{} of {} checks failed; calibrate again with 'turnscan calibrate'",
                  count[Rating::kWrong], implausible.size() + findings.size());
    if (count[Rating::kGood] > 0) return {};
    return fail(ErrorCode::kMissingData,
                "nothing could be checked; record a whole turn of an object that is not "
                "rotationally symmetric");
  }

  static std::string_view word_of(Rating rating) {
    constexpr std::array<std::string_view, 3> kWords{"good", "not known", "WRONG"};
    return kWords[std::size_t(rating)];
  }

  std::string recording_, device_, json_, save_;
  std::vector<std::string> import_;
  DeviceOptions device_options_;
  bool detect_ = false, from_motion_ = false, check_ = false;
  CalibrateRequest request_;
};

}  // namespace

std::unique_ptr<Command> make_calibrate_command() { return std::make_unique<CalibrateCommand>(); }

}  // namespace turnscan::cli
