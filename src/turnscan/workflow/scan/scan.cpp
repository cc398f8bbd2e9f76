#include <turnscan/reconstruction/report.hpp>
#include <turnscan/workflow/scan/scan.hpp>

#include <time.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <turnscan/capture/session/device_calibration.hpp>
#include <turnscan/capture/session/table_watch.hpp>
#include <turnscan/core/stopwatch.hpp>
#include <turnscan/core/version.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/recording/unfinished.hpp>

#include <turnscan/workflow/mesh_output.hpp>
#include <turnscan/workflow/output_file.hpp>
#include <turnscan/workflow/reconstruct_run.hpp>
#include <turnscan/workflow/scan/capture_json.hpp>
#include <turnscan/workflow/scan/capture_outcome.hpp>
#include <turnscan/workflow/scan/live_reconstruction.hpp>
#include <turnscan/workflow/scan/scan_ahead.hpp>
#include <turnscan/workflow/scan/table_finder.hpp>
#include <turnscan/workflow/text/capture_text.hpp>
#include <turnscan/workflow/text/reconstruction_text.hpp>

namespace turnscan {

namespace {

namespace fs = std::filesystem;
using workflow::LiveReconstruction;

/// Of the whole process.
double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

nlohmann::ordered_json ahead_json(const ScanAhead::Outcome& ahead) {
  auto out = nlohmann::ordered_json::object();
  out["frames"] = ahead.frames_ahead;
  out["kept"] = ahead.kept;
  if (ahead.closure_limit_m > 0.0) {
    out["closure_mm"] = ahead.closure_m * 1e3;
    out["closure_limit_mm"] = ahead.closure_limit_m * 1e3;
  }
  return out;
}

/// One scan, step by step.
class ScanRun {
 public:
  ScanRun(ScanRequest request, const ScanHooks& hooks, const RunContext& context)
      : request_(std::move(request)), hooks_(hooks), context_(context) {}

  Result<ScanOutcome> run() {
    TURNSCAN_TRY(check_files());
    setup().options.speed_rad_s = request_.reconstruct.merge.speed_rad_s;
    TURNSCAN_ASSIGN(auto source, setup().open(context_));
    TURNSCAN_ASSIGN(std::optional<Motor> motor, setup().open_motor(context_));
    TURNSCAN_TRY(source->start());
    workflow::TableFinder finder(setup(), out_.notes);
    TURNSCAN_ASSIGN(const bool table_known, finder.find(*source, context_));
    TURNSCAN_TRY(wait(*source));
    TURNSCAN_TRY(begin_live(table_known));
    TURNSCAN_ASSIGN(out_.captured, record(*source, motor ? &*motor : nullptr));
    const auto end_of_turn = std::chrono::steady_clock::now();
    const double processor_before_s = processor_seconds();
    source->stop();
    TURNSCAN_TRY(capture_outcome(out_.captured, out_.recording));
    TURNSCAN_ASSIGN(out_.reconstruction, with_hint(reconstruct_all()));
    if (!request_.allow_open) TURNSCAN_TRY(with_hint(check_watertight(out_.reconstruction)));
    TURNSCAN_TRY(context_.check());
    TURNSCAN_ASSIGN(out_.files, write_objects(request_.mesh, out_.reconstruction));
    keep_found(source->info());
    out_.after_s = seconds_since(end_of_turn);
    out_.processor_after_s = processor_seconds() - processor_before_s;
    if (!request_.report.empty()) {
      TURNSCAN_TRY(write_file_atomically(request_.report, report(source->info())));
      out_.files.push_back(request_.report);
    }
    return std::move(out_);
  }

 private:
  CaptureSetup& setup() { return request_.setup; }

  Result<> check_files() {
    TURNSCAN_TRY(check_mesh_file(request_.mesh));
    TURNSCAN_TRY(check_output_file(request_.report, ".json"));
    out_.recording = recording_of(request_);
    return check_output_folder(out_.recording, request_.overwrite_unfinished);
  }

  Result<> wait(FrameSource& source) {
    if (!request_.wait || !setup().header.turntable) return {};
    return wait_for_object(
        source, setup().header,
        [&] { context_.begin_phase("wait for an object on the platter", 0); }, context_);
  }

  /// While it records: reconstructs where poses are known before all frames are there. (The platter
  /// of the first frames is seen from one side only; what turns on it is seen from all.)
  Result<> begin_live(bool table_known) {
    const auto& table = setup().header.turntable;
    if (table_known && table->speed_rad_s) {
      TURNSCAN_ASSIGN(auto stream,
                      ReconstructionStream::create(setup().header, request_.reconstruct));
      live_ = std::make_unique<LiveReconstruction>(std::move(stream));
    }
    // Place, speed and angles are to come from the motion of what one sensor sees.
    const bool speed_known = setup().options.speed_rad_s || (table && table->speed_rad_s);
    if (request_.ahead.share && setup().header.sensors.size() == 1 && !speed_known)
      ahead_ =
          std::make_unique<ScanAhead>(out_.recording, request_.reconstruct, *request_.ahead.share);
    return {};
  }

  Result<CaptureResult> record(FrameSource& source, Motor* motor) {
    CaptureHooks hooks;
    hooks.motor = motor;
    hooks.progress = [this](const CaptureProgress& progress) {
      if (hooks_.progress) hooks_.progress(progress);
      if (ahead_) ahead_->progress(progress.fraction);
    };
    if (live_ || ahead_) {
      hooks.frame = [this](const Frame& frame) -> Result<> {
        if (live_) live_->add(frame);
        if (ahead_ && !live_) ahead_->frame_came();
        return {};
      };
    }
    TURNSCAN_TRY(clear_output_folder(out_.recording, request_.overwrite_unfinished));
    context_.begin_phase("record", 1000);
    auto result = capture(source, out_.recording, setup().header, setup().settings, setup().options,
                          hooks, context_);
    if (hooks_.recorded) hooks_.recorded();
    return result;
  }

  Result<Reconstruction> reconstruct_all() {
    if (live_) return live_->finish(context_);
    if (ahead_) {
      TURNSCAN_ASSIGN(ScanAhead::Outcome ahead, ahead_->finish(context_));
      if (!ahead.note.empty()) out_.notes.push_back(ahead.note);
      ahead_report_ = ahead_json(ahead);
      if (ahead.kept) found_ = std::move(ahead.calibration);
      if (ahead.kept) return std::move(ahead.reconstruction);
    }
    TURNSCAN_ASSIGN(const Recording recording, Recording::open(out_.recording));
    TURNSCAN_ASSIGN(const CalibratedFrames calibrated,
                    calibrate_frames(recording, "auto", false, request_.reconstruct, context_));
    if (!calibrated.choice.note.empty()) out_.notes.push_back(calibrated.choice.note);
    found_ = calibrated.choice.calibration;
    return reconstruct(*calibrated.frames, calibrated.options, {}, context_);
  }

  /// For the next scan with this device. That it cannot be kept is no reason to fail.
  void keep_found(const SourceInfo& info) {
    if (!found_ || info.identities.empty()) return;
    found_->others.clear();  // they were there this time
    if (auto kept = keep_calibration(info.identities.front(), *found_); !kept)
      out_.notes.push_back("the calibration could not be kept: " + kept.error().text());
  }

  /// Whatever fails now, the recording is there.
  template <class T>
  Result<T> with_hint(Result<T> result) const {
    if (result) return result;
    Error error = std::move(result).error();
    const char* joint = error.message.find("; ") == std::string::npos ? "; " : " - ";
    error.message += fmt::format("{}the recording is in {}", joint, out_.recording);
    return tl::unexpected<Error>(std::move(error));
  }

  std::string report(const SourceInfo& info) const {
    auto out = nlohmann::ordered_json::object();
    out["software"] = std::string("turnscan ") + version();
    out["recording"] = out_.recording;
    out["mesh"] = request_.mesh;
    out["notes"] = out_.notes;
    out["seconds_after_the_last_frame"] = out_.after_s;
    out["processor_seconds_after_the_last_frame"] = out_.processor_after_s;
    if (!ahead_report_.is_null()) out["ahead"] = ahead_report_;
    out["capture"] = workflow::capture_json(out_.captured, info);
    out["reconstruction"] = nlohmann::ordered_json::parse(
        report_json(out_.reconstruction, request_.reconstruct), nullptr, false);
    return out.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  }

  ScanRequest request_;
  const ScanHooks& hooks_;
  const RunContext& context_;
  ScanOutcome out_;
  std::unique_ptr<LiveReconstruction> live_;
  std::unique_ptr<ScanAhead> ahead_;
  nlohmann::ordered_json ahead_report_;
  std::optional<Calibration> found_;  ///< from the object's motion
};

}  // namespace

OptionTable describe(AheadOptions& options) {
  OptionTable table;
  table.number("ahead", options.share, Quantity::kNone, {0.5, 0.98},
               "Where nothing is known of the turntable: begin to calibrate from motion and to "
               "reconstruct when this share of the recording is there. auto: at its end");
  return table;
}

std::string recording_of(const ScanRequest& request) {
  if (!request.recording.empty()) return request.recording;
  const std::string& mesh = request.mesh;
  const std::string stem = mesh.substr(0, mesh.size() - ending_of(mesh).size());
  std::string name = stem + ".recording";
  std::error_code error;
  for (int i = 2; fs::exists(name, error); ++i) {
    if (request.overwrite_unfinished && is_unfinished_recording(name)) break;
    name = fmt::format("{}-{}.recording", stem, i);
  }
  return name;
}

Result<ScanOutcome> run_scan(ScanRequest request, const ScanHooks& hooks,
                             const RunContext& context) {
  return ScanRun(std::move(request), hooks, context).run();
}

std::string scan_text(const ScanOutcome& outcome) {
  std::string text = capture_text(outcome.captured, outcome.recording) +
                     reconstruction_text(outcome.reconstruction);
  for (const std::string& note : outcome.notes) text += fmt::format("Note: {}\n", note);
  text += fmt::format(
      "The mesh was there {:.1f} s after the last frame, with {:.1f} s of processor time\n",
      outcome.after_s, outcome.processor_after_s);
  for (const std::string& file : outcome.files) text += fmt::format("Wrote {}\n", file);
  return text;
}

}  // namespace turnscan
