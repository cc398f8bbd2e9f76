#include <turnscan/workflow/scan/scan.hpp>

#include <time.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <turnscan/capture/session/device_calibration.hpp>
#include <turnscan/capture/session/table_watch.hpp>
#include <turnscan/capture/source/source_uri.hpp>
#include <turnscan/core/stopwatch.hpp>
#include <turnscan/reconstruction/texture/texture_objects.hpp>
#include <turnscan/recording/recording.hpp>

#include <turnscan/workflow/mesh_output.hpp>
#include <turnscan/workflow/next_pass/next_pass_text.hpp>
#include <turnscan/workflow/output_file.hpp>
#include <turnscan/workflow/page/page_output.hpp>
#include <turnscan/workflow/run_steps.hpp>
#include <turnscan/workflow/scan/capture_outcome.hpp>
#include <turnscan/workflow/scan/live_reconstruction.hpp>
#include <turnscan/workflow/scan/scan_ahead.hpp>
#include <turnscan/workflow/scan/scan_report.hpp>
#include <turnscan/workflow/scan/table_finder.hpp>

namespace turnscan {

namespace {

namespace fs = std::filesystem;
using workflow::LiveReconstruction;

/// Processor time of the whole process.
double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

/// Measures time since the last frame of a pass.
class AfterClock {
 public:
  void tell(ScanOutcome& out) const {
    out.after_s = seconds_since(end_of_turn_);
    out.processor_after_s = processor_seconds() - processor_before_s_;
  }

 private:
  std::chrono::steady_clock::time_point end_of_turn_ = std::chrono::steady_clock::now();
  double processor_before_s_ = processor_seconds();
};

/// Whether the user, or the source, can reposition the object.
bool can_be_laid(const FrameSource& source, const std::vector<std::string>& devices) {
  if (source.info().lays_object) return true;
  return std::none_of(devices.begin(), devices.end(), [](const std::string& device) {
    const auto uri = parse_source_uri(device);
    return uri && (uri->scheme == "virtual" || uri->scheme == "replay");
  });
}

/// A scan as a sequence of steps.
class ScanRun {
 public:
  ScanRun(ScanRequest request, const ScanHooks& hooks, const RunContext& context)
      : request_(std::move(request)), hooks_(hooks), context_(context) {}

  Result<ScanOutcome> run() {
    TURNSCAN_TRY(check_files());
    setup().options.speed_rad_s = request_.reconstruct.merge.speed_rad_s;
    TURNSCAN_ASSIGN(const auto source, setup().open(context_));
    TURNSCAN_TRY(check_passes(*source));
    TURNSCAN_ASSIGN(std::optional<Motor> motor, setup().open_motor(context_));
    TURNSCAN_TRY(scan_first(*source, motor ? &*motor : nullptr));
    for (;;) {
      TURNSCAN_ASSIGN(const bool more, prompt_next_pass(*source));
      if (!more) return std::move(out_);
      TURNSCAN_TRY(scan_next(*source, motor ? &*motor : nullptr));
    }
  }

 private:
  CaptureSetup& setup() { return request_.setup; }

  Result<> check_files() {
    TURNSCAN_TRY(check_textured_mesh_file(request_.mesh, request_.reconstruct.texture,
                                          request_.mesh_options));
    TURNSCAN_TRY(check_report_files({request_.report, request_.page}));
    TURNSCAN_TRY(check_output_file(request_.advice_picture, ".png"));
    out_.recording = recording_of(request_);
    if (setup().options.resume) return {};
    return check_output_folder(out_.recording, request_.overwrite_unfinished);
  }

  Result<> check_passes(const FrameSource& source) {
    laid_ = can_be_laid(source, setup().devices);
    if (request_.passes.value_or(1) > 1 && !laid_)
      return fail(ErrorCode::kInvalidOption,
                  "passes: what this source shows cannot be laid another way; leave it out");
    if (request_.passes.value_or(1) > 1 && request_.reconstruct.merge.pass)
      return fail(ErrorCode::kInvalidOption,
                  "--pass takes one pass of a recording, and --passes joins them; leave one out");
    return {};
  }

  Result<> scan_first(FrameSource& source, Motor* motor) {
    TURNSCAN_TRY(source.start());
    workflow::TableFinder finder(setup(), out_.notes);
    TURNSCAN_ASSIGN(const bool table_known, finder.find(source, context_));
    TURNSCAN_TRY(wait(source));
    // The frames before a gap have to be placed first.
    if (!setup().options.resume || !source.info().live) TURNSCAN_TRY(begin_live(table_known));
    if (!setup().options.resume)
      TURNSCAN_TRY(clear_output_folder(out_.recording, request_.overwrite_unfinished));
    TURNSCAN_TRY(record(source, motor, setup().options));
    const AfterClock after;
    source.stop();
    TURNSCAN_TRY(capture_outcome(out_.captured.back(), out_.recording));
    TURNSCAN_TRY(with_hint(reconstruct_first(source.info(), after)));
    return write_beside_meshes(source.info());
  }

  /// Makes the mesh first, then the results derived from it.
  Result<> reconstruct_first(const SourceInfo& info, const AfterClock& after) {
    TURNSCAN_ASSIGN(const Recording recording, Recording::open(out_.recording, context_));
    auto placed = make_first_meshes(recording, after);
    TURNSCAN_ASSIGN(auto findings, find_implausible(recording, context_));
    if (!placed)
      return tl::unexpected<Error>(
          workflow::with_cause(std::move(placed).error(), {std::move(findings)}));
    keep_found(info, placed->calibrated.choice);
    placed->findings = std::move(findings);
    std::vector<workflow::PlacedRecording> all;
    all.push_back(std::move(*placed));
    return workflow::conclude_run(all, {}, request(), context_, out_.run);
  }

  Result<workflow::PlacedRecording> make_first_meshes(const Recording& recording,
                                                      const AfterClock& after) {
    std::optional<workflow::PlacedRecording> placed;
    if (live_) {
      TURNSCAN_ASSIGN(out_.run.reconstruction, live_->finish(context_));
      TURNSCAN_TRY(add_textures(recording, out_.run.reconstruction));
      TURNSCAN_TRY(write_meshes(after));
    } else {
      TURNSCAN_ASSIGN(placed, finish_ahead(recording));
      if (placed) TURNSCAN_TRY(write_meshes(after));
    }
    if (!placed) {
      TURNSCAN_ASSIGN(placed, workflow::place_recording({"", &recording}, request(), context_));
      if (!live_ || moves_frames(placed->calibrated.choice)) {
        const CalibratedFrames& calibrated = placed->calibrated;
        TURNSCAN_ASSIGN(out_.run.reconstruction,
                        reconstruct(*calibrated.frames, calibrated.options, {}, context_));
        TURNSCAN_TRY(write_meshes(after));
      }
    }
    return std::move(*placed);
  }

  /// Whether the choice changes the frames' poses compared to the recording alone.
  static bool moves_frames(const CalibrationChoice& choice) {
    return choice.calibration || !choice.poses.empty() || !choice.left_out.empty();
  }

  ReconstructRequest request() const {
    ReconstructRequest out;
    out.options = request_.reconstruct;
    out.allow_open = request_.allow_open;
    return out;
  }

  ReconstructFiles files() const {
    ReconstructFiles out;
    out.mesh = request_.mesh;
    out.mesh_options = request_.mesh_options;
    out.report = request_.report;
    out.page = request_.page;
    out.advice_picture = request_.advice_picture;
    return out;
  }

  Result<> write_meshes(const AfterClock& after) {
    if (!request_.allow_open) TURNSCAN_TRY(check_watertight(out_.run.reconstruction));
    TURNSCAN_TRY(context_.check());
    TURNSCAN_ASSIGN(out_.files, write_run_meshes(files(), out_.run));
    after.tell(out_);
    return {};
  }

  Result<> wait(FrameSource& source) {
    if (!request_.wait || !setup().header.turntable) return {};
    return wait_for_object(
        source, setup().header, setup().options.limits.seconds,
        [&] { context_.begin_phase("wait for an object on the platter", 0); }, context_);
  }

  /// Reconstructs during recording if poses are known before all frames have arrived. (The platter
  /// of the first frames is seen from one side only; the turning object is seen from all.)
  Result<> begin_live(bool table_known) {
    const auto& table = setup().header.turntable;
    if (table_known && table->speed_rad_s) {
      TURNSCAN_ASSIGN(auto stream,
                      ReconstructionStream::create(setup().header, request_.reconstruct));
      live_ = std::make_unique<LiveReconstruction>(std::move(stream), context_);
    }
    // Axis, speed and angles have to be found from the motion seen by one sensor.
    const bool speed_known = setup().options.speed_rad_s || (table && table->speed_rad_s);
    if (request_.ahead.share && setup().header.sensors.size() == 1 && !speed_known)
      ahead_ = std::make_unique<ScanAhead>(out_.recording, request_.reconstruct,
                                           *request_.ahead.share, context_);
    return {};
  }

  Result<> record(FrameSource& source, Motor* motor, const CaptureOptions& options) {
    const bool first = !options.add_pass;
    CaptureHooks hooks;
    hooks.motor = motor;
    hooks.progress = [this, first](const CaptureProgress& progress) {
      if (hooks_.progress) hooks_.progress(progress);
      if (ahead_ && first) ahead_->progress(progress.fraction);
    };
    hooks.frame = [this, first](const Frame& frame) -> Result<> {
      if (hooks_.frame) hooks_.frame(frame);
      if (!first) return {};
      if (live_) live_->add(frame);
      if (ahead_ && !live_) ahead_->frame_came();
      return {};
    };
    if (hooks_.begin) hooks_.begin(setup());
    context_.begin_phase(first ? "record" : "record another side", 1000);
    auto result =
        capture(source, out_.recording, setup().header, setup().settings, options, hooks, context_);
    if (hooks_.recorded) hooks_.recorded();
    if (!result) return tl::unexpected<Error>(std::move(result).error());
    out_.captured.push_back(std::move(*result));
    return {};
  }

  /// The result of ScanAhead, if it is kept.
  Result<std::optional<workflow::PlacedRecording>> finish_ahead(const Recording& recording) {
    if (!ahead_) return std::nullopt;
    TURNSCAN_ASSIGN(ScanAhead::Outcome ahead, ahead_->finish(context_));
    if (!ahead.note.empty()) out_.notes.push_back(ahead.note);
    out_.ahead = {ahead.frames_ahead, ahead.kept, ahead.closure_m, ahead.closure_limit_m};
    if (!ahead.kept) return std::nullopt;
    CalibrationChoice choice;
    choice.calibration = std::move(ahead.calibration);
    TURNSCAN_ASSIGN(auto placed,
                    workflow::place_recording({"", &recording}, request(), std::move(choice)));
    out_.run.reconstruction = std::move(ahead.reconstruction);
    TURNSCAN_TRY(add_textures(*placed.calibrated.frames, out_.run.reconstruction));
    return placed;
  }

  /// Adds textures from the recorded images to meshes made during recording.
  Result<> add_textures(const FrameSequence& placed, Reconstruction& made) const {
    ReconstructOptions options = request_.reconstruct;
    if (!options.texture.texture) return {};
    if (!live_) options.merge.speed_rad_s.reset();  // included in the angles
    TURNSCAN_TRY(texture::check_colors(placed));
    return texture::texture_objects(placed, options, {}, made, context_);
  }

  /// Stores the calibration for the next scan with this device. Failing to store it is not an
  /// error.
  void keep_found(const SourceInfo& info, const CalibrationChoice& choice) {
    if (!choice.calibration || info.identities.empty()) return;
    Calibration found = *choice.calibration;
    found.others.clear();  // valid for this scan only
    found.made_at = date_of_calibration(info);
    if (auto kept = keep_calibration(info.identities.front(), found); !kept)
      out_.notes.push_back("the calibration could not be stored: " + kept.error().text());
  }

  /// Writes picture, report and page for all passes so far.
  Result<> write_beside_meshes(const SourceInfo& info) {
    TURNSCAN_ASSIGN(const auto written,
                    with_hint(write_beside(files(), out_.run,
                                           workflow::scan_report(request_, out_, info), context_)));
    out_.files.insert(out_.files.end(), written.begin(), written.end());
    return {};
  }

  // --- further passes

  /// Whether there is a further pass; if so, the object has been repositioned.
  Result<bool> prompt_next_pass(FrameSource& source) {
    const auto pass = std::uint32_t(out_.captured.size());
    const bool asks = !request_.passes, by_itself = source.info().lays_object;
    const bool advised = out_.run.next_pass && !out_.run.next_pass->poses.empty();
    if (request_.passes && int(pass) >= *request_.passes) return false;
    if (asks && (!hooks_.another_side || !laid_ || !advised)) return false;
    if (asks || !by_itself) {
      if (!hooks_.another_side)
        return fail(ErrorCode::kInvalidOption,
                    "passes: there is nobody who could lay the object another way; leave it out");
      const std::string advice = out_.run.next_pass ? next_pass_text(*out_.run.next_pass)
                                                    : "Nearly all of its surface was seen.";
      TURNSCAN_ASSIGN(const bool laid, with_hint(hooks_.another_side(advice, pass)));
      if (!laid) return false;
    }
    if (!by_itself) return true;
    if (!advised) {
      out_.notes.push_back(
          fmt::format("there was no pass {}: no other way to lay it shows much more", pass));
      return false;
    }
    const NextPose& pose = out_.run.next_pass->poses.front();
    out_.notes.push_back(
        fmt::format("before pass {}: {}", pass, next_pass_text(*out_.run.next_pass)));
    TURNSCAN_TRY(source.lay_object(turn_seen_by_sensor(pose, out_.run.seen_from),
                                   out_.run.seen_from.first_time_s));
    return true;
  }

  Result<> scan_next(FrameSource& source, Motor* motor) {
    TURNSCAN_TRY(with_hint(take_what_waits(source)));
    TURNSCAN_TRY(with_hint(source.start()));
    TURNSCAN_TRY(with_hint(wait(source)));
    CaptureOptions options = setup().options;
    options.add_pass = true;
    options.resume = false;
    TURNSCAN_TRY(with_hint(record(source, motor, options)));
    const AfterClock after;
    source.stop();
    TURNSCAN_TRY(capture_outcome(out_.captured.back(), out_.recording));
    TURNSCAN_ASSIGN(const Recording recording,
                    with_hint(Recording::open(out_.recording, context_)));
    const std::vector<std::string> before = std::move(out_.files);
    const auto write_joined = [&](const ReconstructRun& run) -> Result<> {
      TURNSCAN_TRY(write_passes(run, before));
      after.tell(out_);
      return {};
    };
    TURNSCAN_ASSIGN(ReconstructRun run,
                    with_hint(run_reconstruction(recording, request(), context_, write_joined)));
    take_joined(std::move(run));
    return write_beside_meshes(source.info());
  }

  /// Discards frames of the object's previous pose.
  Result<> take_what_waits(FrameSource& source) const {
    for (;;) {
      TURNSCAN_ASSIGN(const Delivery delivery, source.next(0.0, context_));
      if (delivery.kind != Delivery::Kind::kFrame) return {};
    }
  }

  /// If no pass was joined, the mesh remains as it was.
  Result<> write_passes(const ReconstructRun& run, const std::vector<std::string>& before) {
    out_.files.clear();
    if (!run.reconstruction.objects.empty()) {
      TURNSCAN_ASSIGN(out_.files,
                      write_objects(request_.mesh, run.reconstruction, request_.mesh_options));
    } else {
      for (const std::string& file : before)
        if (!is_beside(file)) out_.files.push_back(file);
    }
    for (const PassApart& pass : run.apart) {
      if (pass.reason.empty() || pass.reconstruction.objects.empty()) continue;
      TURNSCAN_ASSIGN(const auto own, write_objects(mesh_of_pass(request_.mesh, pass.number),
                                                    pass.reconstruction, request_.mesh_options));
      out_.files.insert(out_.files.end(), own.begin(), own.end());
    }
    // A pass that now fits no longer has a separate mesh.
    for (const std::string& file : before) {
      std::error_code ignored;
      if (!is_beside(file) &&
          std::find(out_.files.begin(), out_.files.end(), file) == out_.files.end())
        fs::remove(file, ignored);
    }
    return {};
  }

  void take_joined(ReconstructRun run) {
    std::erase_if(run.apart, [](const PassApart& pass) { return pass.reason.empty(); });
    if (run.reconstruction.objects.empty())
      out_.run.apart = std::move(run.apart);
    else
      out_.run = std::move(run);
  }

  bool is_beside(const std::string& file) const {
    return file == request_.report || file == request_.page || file == request_.advice_picture;
  }

  /// The recording exists, whatever fails from here on.
  template <class T>
  Result<T> with_hint(Result<T> result) const {
    if (result) return result;
    Error error = std::move(result).error();
    const char* joint = error.message.find("; ") == std::string::npos ? "; " : " - ";
    error.message += fmt::format("{}the recording is in {}", joint, out_.recording);
    return tl::unexpected<Error>(std::move(error));
  }

  ScanRequest request_;
  const ScanHooks& hooks_;
  const RunContext& context_;
  ScanOutcome out_;
  std::unique_ptr<LiveReconstruction> live_;
  std::unique_ptr<ScanAhead> ahead_;
  bool laid_ = false;  ///< the object can be repositioned
};

}  // namespace

Result<ScanOutcome> run_scan(ScanRequest request, const ScanHooks& hooks,
                             const RunContext& context) {
  return ScanRun(std::move(request), hooks, context).run();
}

}  // namespace turnscan
