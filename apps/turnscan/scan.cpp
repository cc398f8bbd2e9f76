#include <time.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>
#include <turnscan/capture/capture.hpp>
#include <turnscan/capture/device_calibration.hpp>
#include <turnscan/capture/table_watch.hpp>
#include <turnscan/core/version.hpp>
#include <turnscan/io/atomic_file.hpp>
#include <turnscan/io/mesh_io.hpp>
#include <turnscan/reconstruction/stream.hpp>
#include <turnscan/recording/calibration_file.hpp>
#include <turnscan/turntable/detect.hpp>

#include "calibration_choice.hpp"
#include "capture_setup.hpp"
#include "capture_text.hpp"
#include "command_line.hpp"
#include "commands.hpp"
#include "output_file.hpp"
#include "reconstruction_text.hpp"
#include "scan_ahead.hpp"

namespace turnscan::cli {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Of the whole process.
double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

constexpr int kDetectFrames = 20;
constexpr std::size_t kBatch = 16;  ///< frames that are added together

/// Adds frames to a reconstruction on a thread of its own, so that the sensor is not held up.
class Feeder {
 public:
  explicit Feeder(ReconstructionStream stream)
      : stream_(std::move(stream)), thread_([this] { run(); }) {}
  ~Feeder() { close(); }
  Feeder(const Feeder&) = delete;
  Feeder& operator=(const Feeder&) = delete;

  void add(const Frame& frame) {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(frame);
    wake_.notify_one();
  }

  Result<Reconstruction> finish(const RunContext& context) {
    close();
    TURNSCAN_TRY(added_);
    return stream_.finish({}, context);
  }

 private:
  void close() {
    {
      const std::lock_guard lock(mutex_);
      closing_ = true;
    }
    wake_.notify_one();
    if (thread_.joinable()) thread_.join();
  }

  void run() {
    for (;;) {
      std::vector<Frame> batch;
      {
        std::unique_lock lock(mutex_);
        wake_.wait(lock, [this] { return closing_ || !waiting_.empty(); });
        if (waiting_.empty()) return;
        while (!waiting_.empty() && batch.size() < kBatch) {
          batch.push_back(std::move(waiting_.front()));
          waiting_.pop_front();
        }
      }
      if (added_) added_ = stream_.add(batch);
    }
  }

  ReconstructionStream stream_;
  Result<> added_;  ///< of the thread, until it has ended
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Frame> waiting_;
  bool closing_ = false;
  std::thread thread_;
};

/// "dir/doll.3mf" -> "dir/doll.recording", or the next free "dir/doll-2.recording"
std::string free_recording(const std::string& mesh) {
  const std::string stem = mesh.substr(0, mesh.size() - ending_of(mesh).size());
  std::string name = stem + ".recording";
  std::error_code error;
  for (int i = 2; fs::exists(name, error); ++i) name = fmt::format("{}-{}.recording", stem, i);
  return name;
}

class ScanCommand : public Command {
 public:
  void declare(CommandLine& line) override {
    line.required_repeatable("--device", "URI", setup_.devices,
                             "Sensor to scan with, e.g. virtual:doll (see docs/capture.md). May be "
                             "given several times: one mesh from all of them");
    line.required_option("-o,--out", "MESH", out_,
                         "Mesh to write: .ply, .obj or .glb in metres, .stl or .3mf in mm");
    line.option("--recording", "FOLDER", recording_,
                "Folder to make for the recording, by default beside the mesh. It is kept");
    line.option("--report", "FILE.json", report_,
                "Write what was recorded and reconstructed as JSON");
    line.flag("--no-wait", no_wait_, "Do not wait until something stands on the platter");
    line.flag("--allow-open", allow_open_, "Write meshes that are not watertight, too");
    setup_.declare(line);
    line.group("limits", "End of the recording", describe(setup_.options.limits));
    line.group("ahead", "Work while frames come", describe_ahead());
    for (StageOptions& stage : describe_stages(options_))
      line.group(stage.stage, "Stage " + stage.stage, std::move(stage.table));
  }

  Result<> run(Session& session) override {
    TURNSCAN_TRY(check_outputs());
    setup_.options.speed_rad_s = options_.merge.speed_rad_s;
    TURNSCAN_ASSIGN(auto source, setup_.open(session));
    TURNSCAN_ASSIGN(std::optional<Motor> motor, setup_.open_motor(session));
    TURNSCAN_TRY(source->start());
    TURNSCAN_TRY(find_table(*source, session));
    TURNSCAN_TRY(wait(*source, session));
    TURNSCAN_ASSIGN(const auto feeder, make_feeder());
    if (motion_will_tell()) ahead_ = std::make_unique<ScanAhead>(recording_, options_, *ahead_at_);
    TURNSCAN_ASSIGN(const CaptureResult captured,
                    record(*source, motor ? &*motor : nullptr, feeder.get(), session));
    const auto end_of_turn = Clock::now();
    const double processor_before_s = processor_seconds();
    source->stop();
    TURNSCAN_TRY(outcome_of(captured, recording_));
    TURNSCAN_ASSIGN(Reconstruction result, reconstruct_all(feeder.get(), session));
    if (!allow_open_) TURNSCAN_TRY(with_hint(check_watertight(result)));
    TURNSCAN_TRY(session.context().check());
    TURNSCAN_ASSIGN(const auto files, write_objects(out_, result));
    keep_found(source->info());
    after_s_ = std::chrono::duration<double>(Clock::now() - end_of_turn).count();
    processor_after_s_ = processor_seconds() - processor_before_s;
    if (!report_.empty())
      TURNSCAN_TRY(write_file_atomically(report_, report_json(captured, result, source->info())));
    session.print("{}{}", capture_text(captured, recording_), reconstruction_text(result));
    for (const std::string& note : notes_) session.print("Note: {}\n", note);
    session.print(
        "The mesh was there {:.1f} s after the last frame, with {:.1f} s of processor time\n",
        after_s_, processor_after_s_);
    for (const std::string& file : files) session.print("Wrote {}\n", file);
    if (!report_.empty()) session.print("Wrote {}\n", report_);
    return {};
  }

 private:
  OptionTable describe_ahead() {
    OptionTable table;
    table.number("ahead", ahead_at_, Quantity::kNone, {0.5, 0.98},
                 "Where nothing is known of the turntable: begin to calibrate from motion and to "
                 "reconstruct when this share of the recording is there. auto: at its end");
    return table;
  }

  Result<> check_outputs() {
    if (auto good = check_mesh_output(out_); !good) {
      Error error = std::move(good).error();
      if (error.code == ErrorCode::kUnsupported) error.code = ErrorCode::kInvalidOption;
      return tl::unexpected<Error>(std::move(error));
    }
    TURNSCAN_TRY(check_output_file(report_, ".json"));
    if (recording_.empty()) recording_ = free_recording(out_);
    return check_output_folder(recording_);
  }

  /// Checks where the table is said to be; where nobody says it, a calibration that was kept of
  /// this device, or else the platter, shows it.
  Result<> find_table(FrameSource& source, Session& session) {
    table_known_ = setup_.header.turntable && setup_.places_known();
    if (table_known_ && setup_.turntable_file.empty()) return {};
    if (!table_known_ && setup_.devices.size() > 1) {
      // A platter tells where each sensor stands, but not in which direction from each other.
      notes_.push_back("where the sensors stand comes from the object's motion alone");
      return {};
    }
    session.context().begin_phase("look for the turntable", 0);
    auto scan = mean_of_next(source, 0, kDetectFrames, session.context());
    const auto none = [](const Error& error) {
      return error.code == ErrorCode::kMissingData || error.code == ErrorCode::kTooFewPoints ||
             error.code == ErrorCode::kUnsupported;
    };
    if (!scan && !none(scan.error())) return tl::unexpected<Error>(std::move(scan).error());
    if (!scan) return {};  // nothing to be seen yet
    if (table_known_) return check_given(source, *scan, session);
    TURNSCAN_ASSIGN(const bool kept, take_kept(source, *scan, session));
    if (kept) return {};
    const auto platter = detect_platter(*scan, DetectOptions(), session.context());
    if (!platter && !none(platter.error())) return tl::unexpected<Error>(platter.error());
    if (!platter) {
      notes_.push_back("the platter was not found (" + platter.error().message +
                       "), so the turntable comes from the object's motion alone");
      return {};
    }
    set_table(calibration_of(*platter, *scan).table);
    notes_.push_back(fmt::format("the turntable was found by its platter, {:.0f} mm in radius",
                                 setup_.header.turntable->radius_m.value_or(0.0) * 1e3));
    return {};
  }

  /// The speed of another day says nothing about today's.
  void set_table(const TurntableInfo& table) {
    setup_.header.turntable = table;
    setup_.header.turntable->speed_rad_s = setup_.options.speed_rad_s;
  }

  Result<> check_given(FrameSource& source, const AveragedScan& first, Session& session) {
    TURNSCAN_ASSIGN(Calibration calibration, read_calibration(setup_.turntable_file));
    TURNSCAN_TRY(check_one(first, calibration, "", session));
    const TurntableInfo table = calibration.table;
    const std::vector<SensorPlace> others = std::move(calibration.others);
    for (std::size_t k = 0; k < others.size(); ++k) {
      TURNSCAN_ASSIGN(const AveragedScan scan,
                      mean_of_next(source, std::uint32_t(k + 1), kDetectFrames, session.context()));
      calibration = Calibration();
      calibration.table = table_before(others[k].T_table_sensor);
      calibration.table.radius_m = table.radius_m;
      TURNSCAN_TRY(check_one(scan, calibration, fmt::format("sensor {}: ", k + 1), session));
    }
    return {};
  }

  Result<> check_one(const AveragedScan& scan, const Calibration& calibration,
                     const std::string& who, Session& session) const {
    TURNSCAN_ASSIGN(const RigCheck check, check_rig(scan, calibration, session.context()));
    if (!check.moved) return {};
    return fail_at(setup_.turntable_file, ErrorCode::kMissingData,
                   "{}{}; calibrate anew, or leave out --turntable", who, check.text);
  }

  /// As a sensor sees the table that stands so before it.
  static TurntableInfo table_before(const Pose& T_table_sensor) {
    TurntableInfo table;
    table.axis = T_table_sensor.linear().transpose() * Vec3d::UnitY();
    table.center_m = T_table_sensor.inverse() * Vec3d::Zero();
    return table;
  }

  Result<bool> take_kept(const FrameSource& source, const AveragedScan& scan, Session& session) {
    const auto& identities = source.info().identities;
    if (identities.empty()) return false;
    const auto kept = kept_calibration(identities.front());
    if (!kept || !*kept) return false;
    TURNSCAN_ASSIGN(const RigCheck check, check_rig(scan, **kept, session.context()));
    notes_.push_back(check.text);
    if (check.moved) return false;
    set_table((*kept)->table);
    TURNSCAN_TRY(correct_sensors(**kept, setup_.header.sensors));
    notes_.push_back("the turntable's place is the one that was kept of this device");
    table_known_ = true;
    return true;
  }

  Result<> wait(FrameSource& source, Session& session) const {
    if (no_wait_ || !setup_.header.turntable) return {};
    return wait_for_object(
        source, setup_.header,
        [&] { session.context().begin_phase("wait for an object on the platter", 0); },
        session.context());
  }

  /// nullptr: poses are not known before all frames are there. (The platter of the first frames is
  /// seen from one side only; what turns on it is seen from all.)
  Result<std::unique_ptr<Feeder>> make_feeder() const {
    const auto& table = setup_.header.turntable;
    if (!table_known_ || !table->speed_rad_s) return std::unique_ptr<Feeder>();
    TURNSCAN_ASSIGN(auto stream, ReconstructionStream::create(setup_.header, options_));
    return std::make_unique<Feeder>(std::move(stream));
  }

  /// Whether place, speed and angles are to come from the motion of what one sensor sees.
  bool motion_will_tell() const {
    const auto& table = setup_.header.turntable;
    const bool speed_known = setup_.options.speed_rad_s || (table && table->speed_rad_s);
    return ahead_at_ && setup_.header.sensors.size() == 1 && !speed_known;
  }

  Result<CaptureResult> record(FrameSource& source, Motor* motor, Feeder* feeder,
                               Session& session) const {
    CaptureHooks hooks;
    hooks.motor = motor;
    hooks.progress = progress_in(session);
    if (ahead_) {
      hooks.progress = [show = hooks.progress, this](const CaptureProgress& progress) {
        show(progress);
        ahead_->progress(progress.fraction);
      };
      hooks.frame = [this](const Frame&) -> Result<> {
        ahead_->frame_came();
        return {};
      };
    }
    if (feeder != nullptr) {
      hooks.frame = [feeder](const Frame& frame) -> Result<> {
        feeder->add(frame);
        return {};
      };
    }
    session.context().begin_phase("record", 1000);
    auto result = turnscan::capture(source, recording_, setup_.header, setup_.settings,
                                    setup_.options, hooks, session.context());
    session.status().set("");
    return result;
  }

  Result<Reconstruction> reconstruct_all(Feeder* feeder, Session& session) {
    if (feeder != nullptr) return with_hint(feeder->finish(session.context()));
    if (ahead_) {
      TURNSCAN_ASSIGN(ScanAhead::Outcome ahead, with_hint(ahead_->finish(session.context())));
      if (!ahead.note.empty()) notes_.push_back(ahead.note);
      ahead_report_ = report_of(ahead);
      if (ahead.kept) found_ = std::move(ahead.calibration);
      if (ahead.kept) return std::move(ahead.reconstruction);
    }
    return with_hint(reconstruct_recording(session));
  }

  static nlohmann::ordered_json report_of(const ScanAhead::Outcome& ahead) {
    nlohmann::ordered_json out;
    out["frames"] = ahead.frames_ahead;
    out["kept"] = ahead.kept;
    if (ahead.closure_limit_m > 0.0) {
      out["closure_mm"] = ahead.closure_m * 1e3;
      out["closure_limit_mm"] = ahead.closure_limit_m * 1e3;
    }
    return out;
  }

  Result<Reconstruction> reconstruct_recording(Session& session) {
    TURNSCAN_ASSIGN(const Recording recording, Recording::open(recording_));
    TURNSCAN_ASSIGN(const CalibrationChoice choice,
                    choose_calibration(recording, {"auto", options_.merge.speed_rad_s, false},
                                       session.context()));
    TURNSCAN_ASSIGN(const auto frames, with_choice(recording, choice));
    ReconstructOptions options = options_;
    if (choice.calibration) options.merge.speed_rad_s.reset();  // it is in the angles
    if (!choice.note.empty()) notes_.push_back(choice.note);
    found_ = choice.calibration;
    return reconstruct(*frames, options, {}, session.context());
  }

  /// For the next scan with this device. That it cannot be kept is no reason to fail.
  void keep_found(const SourceInfo& info) {
    if (!found_ || info.identities.empty()) return;
    found_->others.clear();  // they were there this time
    if (auto kept = keep_calibration(info.identities.front(), *found_); !kept)
      notes_.push_back("the calibration could not be kept: " + kept.error().text());
  }

  /// Whatever fails now, the recording is there.
  template <class T>
  Result<T> with_hint(Result<T> result) const {
    if (result) return result;
    Error error = std::move(result).error();
    const char* joint = error.message.find("; ") == std::string::npos ? "; " : " - ";
    error.message += fmt::format("{}the recording is in {}", joint, recording_);
    return tl::unexpected<Error>(std::move(error));
  }

  std::string report_json(const CaptureResult& captured, const Reconstruction& result,
                          const SourceInfo& info) const {
    nlohmann::ordered_json out;
    out["software"] = std::string("turnscan ") + version();
    out["recording"] = recording_;
    out["mesh"] = out_;
    out["notes"] = notes_;
    out["seconds_after_the_last_frame"] = after_s_;
    out["processor_seconds_after_the_last_frame"] = processor_after_s_;
    if (!ahead_report_.is_null()) out["ahead"] = ahead_report_;
    out["capture"] = capture_json(captured, info);
    out["reconstruction"] =
        nlohmann::ordered_json::parse(turnscan::report_json(result, options_), nullptr, false);
    return out.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  }

  CaptureSetup setup_;
  ReconstructOptions options_;
  std::string out_, recording_, report_;
  double after_s_ = 0.0, processor_after_s_ = 0.0;
  bool no_wait_ = false, allow_open_ = false, table_known_ = false;
  std::optional<double> ahead_at_ = 0.8;
  std::unique_ptr<ScanAhead> ahead_;
  nlohmann::ordered_json ahead_report_;
  std::optional<Calibration> found_;  ///< from the object's motion
  std::vector<std::string> notes_;
};

}  // namespace

std::unique_ptr<Command> make_scan_command() { return std::make_unique<ScanCommand>(); }

}  // namespace turnscan::cli
