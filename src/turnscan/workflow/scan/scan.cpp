#include <turnscan/workflow/scan/scan.hpp>

#include <time.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <turnscan/capture/session/device_calibration.hpp>
#include <turnscan/capture/session/table_watch.hpp>
#include <turnscan/capture/source/source_uri.hpp>
#include <turnscan/core/stopwatch.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/reconstruction/texture/texture_objects.hpp>
#include <turnscan/recording/recording.hpp>

#include <turnscan/workflow/mesh_output.hpp>
#include <turnscan/workflow/next_pass/next_pass_picture.hpp>
#include <turnscan/workflow/next_pass/next_pass_text.hpp>
#include <turnscan/workflow/output_file.hpp>
#include <turnscan/workflow/page/page_output.hpp>
#include <turnscan/workflow/reconstruct_run.hpp>
#include <turnscan/workflow/scan/capture_outcome.hpp>
#include <turnscan/workflow/scan/live_reconstruction.hpp>
#include <turnscan/workflow/scan/scan_ahead.hpp>
#include <turnscan/workflow/scan/scan_report.hpp>
#include <turnscan/workflow/scan/table_finder.hpp>
#include <turnscan/workflow/verdict/verdict_rules.hpp>

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

/// From the last frame of a pass on.
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

/// Whether somebody, or the source, can lay what it sees another way.
bool can_be_laid(const FrameSource& source, const std::vector<std::string>& devices) {
  if (source.info().lays_object) return true;
  return std::none_of(devices.begin(), devices.end(), [](const std::string& device) {
    const auto uri = parse_source_uri(device);
    return uri && (uri->scheme == "virtual" || uri->scheme == "replay");
  });
}

/// One scan, step by step.
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
    TURNSCAN_TRY(begin_live(table_known));
    TURNSCAN_TRY(clear_output_folder(out_.recording, request_.overwrite_unfinished));
    TURNSCAN_TRY(record(source, motor, setup().options));
    const AfterClock after;
    source.stop();
    TURNSCAN_TRY(capture_outcome(out_.captured.back(), out_.recording));
    TURNSCAN_ASSIGN(out_.reconstruction, with_hint(reconstruct_all()));
    if (!request_.allow_open) TURNSCAN_TRY(with_hint(check_watertight(out_.reconstruction)));
    TURNSCAN_TRY(context_.check());
    keep_found(source.info());
    TURNSCAN_ASSIGN(out_.files,
                    write_objects(request_.mesh, out_.reconstruction, request_.mesh_options));
    after.tell(out_);
    TURNSCAN_TRY(judge_first());
    return write_beside(source.info());
  }

  Result<> wait(FrameSource& source) {
    if (!request_.wait || !setup().header.turntable) return {};
    return wait_for_object(
        source, setup().header, setup().options.limits.seconds,
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

  Result<> record(FrameSource& source, Motor* motor, const CaptureOptions& options) {
    const bool first = !options.add_pass;
    CaptureHooks hooks;
    hooks.motor = motor;
    hooks.progress = [this, first](const CaptureProgress& progress) {
      if (hooks_.progress) hooks_.progress(progress);
      if (ahead_ && first) ahead_->progress(progress.fraction);
    };
    if (first && (live_ || ahead_)) {
      hooks.frame = [this](const Frame& frame) -> Result<> {
        if (live_) live_->add(frame);
        if (ahead_ && !live_) ahead_->frame_came();
        return {};
      };
    }
    context_.begin_phase(first ? "record" : "record another side", 1000);
    auto result =
        capture(source, out_.recording, setup().header, setup().settings, options, hooks, context_);
    if (hooks_.recorded) hooks_.recorded();
    if (!result) return tl::unexpected<Error>(std::move(result).error());
    out_.captured.push_back(std::move(*result));
    return {};
  }

  Result<Reconstruction> reconstruct_all() {
    if (live_) {
      TURNSCAN_ASSIGN(Reconstruction made, live_->finish(context_));
      TURNSCAN_TRY(add_textures(std::nullopt, made));
      return made;
    }
    if (ahead_) {
      TURNSCAN_ASSIGN(ScanAhead::Outcome ahead, ahead_->finish(context_));
      if (!ahead.note.empty()) out_.notes.push_back(ahead.note);
      out_.ahead = {ahead.frames_ahead, ahead.kept, ahead.closure_m, ahead.closure_limit_m};
      if (ahead.kept) {
        TURNSCAN_TRY(add_textures(ahead.calibration, ahead.reconstruction));
        choice_.calibration = std::move(ahead.calibration);
        return std::move(ahead.reconstruction);
      }
    }
    TURNSCAN_ASSIGN(const Recording recording, Recording::open(out_.recording));
    TURNSCAN_ASSIGN(const CalibratedFrames calibrated,
                    calibrate_frames(recording, "auto", false, request_.reconstruct, context_));
    choice_ = calibrated.choice;
    if (!choice_.note.empty()) out_.notes.push_back(choice_.note);
    return reconstruct(*calibrated.frames, calibrated.options, {}, context_);
  }

  /// From the recording, to meshes that were made while it was written.
  Result<> add_textures(const std::optional<Calibration>& found, Reconstruction& made) const {
    if (!request_.reconstruct.texture.texture) return {};
    TURNSCAN_ASSIGN(const Recording recording, Recording::open(out_.recording));
    TURNSCAN_TRY(texture::check_colors(recording));
    ReconstructOptions options = request_.reconstruct;
    if (!found) return texture::texture_objects(recording, options, {}, made, context_);
    options.merge.speed_rad_s.reset();  // it is in the angles
    TURNSCAN_ASSIGN(const auto placed, with_calibration(recording, *found));
    return texture::texture_objects(*placed, options, {}, made, context_);
  }

  /// For the next scan with this device. That it cannot be kept is no reason to fail.
  void keep_found(const SourceInfo& info) {
    if (!choice_.calibration || info.identities.empty()) return;
    Calibration found = *choice_.calibration;
    found.others.clear();  // they were there this time
    found.made_at = date_of_calibration(info);
    if (auto kept = keep_calibration(info.identities.front(), found); !kept)
      out_.notes.push_back("the calibration could not be kept: " + kept.error().text());
  }

  /// Verdicts, and the advice for the next pass; what is not known is no reason to fail.
  Result<> judge_first() {
    if (out_.reconstruction.objects.empty()) return {};
    TURNSCAN_ASSIGN(const Recording recording, Recording::open(out_.recording));
    TURNSCAN_ASSIGN(const auto placed, with_choice(recording, choice_));
    const auto speed = choice_.calibration ? std::nullopt : request_.reconstruct.merge.speed_rad_s;
    if (auto views = pass_views(*placed, std::nullopt, speed)) {
      seen_from_ = std::move(*views);
      TURNSCAN_ASSIGN(out_.next_pass,
                      advise_next_pass(out_.reconstruction.objects[0], seen_from_, context_));
    }
    ScanKnowledge known;
    known.turn = turn_seen(*placed, speed);
    known.choice = &choice_;
    known.dates = workflow::dates_of(recording);
    known.table_recorded = recording.header().turntable && !choice_.calibration;
    if (known.table_recorded) {
      TURNSCAN_ASSIGN(known.platter, workflow::platter_against_calibration(recording, context_));
    }
    for (const ObjectResult& object : out_.reconstruction.objects)
      TURNSCAN_TRY(compare_object(object, {{placed.get(), std::nullopt, speed}},
                                  out_.reconstruction.sensor_noise_m, context_, known));
    out_.frame_residuals = known.residuals;
    known.next_pass = out_.next_pass;
    judge_objects(out_.reconstruction, known);
    return {};
  }

  /// Picture, report and page, of all passes so far.
  Result<> write_beside(const SourceInfo& info) {
    if (!request_.advice_picture.empty() && out_.next_pass) {
      TURNSCAN_ASSIGN(
          const ColorImage picture,
          next_pass_picture(out_.reconstruction.objects[0], seen_from_, *out_.next_pass, context_));
      TURNSCAN_TRY(write_color_png(request_.advice_picture, picture));
      out_.files.push_back(request_.advice_picture);
    }
    const std::string report = workflow::scan_report(request_, out_, info);
    if (!request_.report.empty()) {
      TURNSCAN_TRY(write_file_atomically(request_.report, report));
      out_.files.push_back(request_.report);
    }
    if (request_.page.empty()) return {};
    TURNSCAN_TRY(with_hint(
        workflow::write_scan_page(request_, out_, report, choice_.calibration, context_)));
    out_.files.push_back(request_.page);
    return {};
  }

  // --- further passes

  /// Whether there is a further pass; then the object lies as it should.
  Result<bool> prompt_next_pass(FrameSource& source) {
    const auto pass = std::uint32_t(out_.captured.size());
    const bool asks = !request_.passes, by_itself = source.info().lays_object;
    const bool advised = out_.next_pass && !out_.next_pass->poses.empty();
    if (request_.passes && int(pass) >= *request_.passes) return false;
    if (asks && (!hooks_.another_side || !laid_ || !advised)) return false;
    if (asks || !by_itself) {
      if (!hooks_.another_side)
        return fail(ErrorCode::kInvalidOption,
                    "passes: there is nobody who could lay the object another way; leave it out");
      const std::string advice =
          out_.next_pass ? next_pass_text(*out_.next_pass) : "Nearly all of its surface was seen.";
      TURNSCAN_ASSIGN(const bool laid, with_hint(hooks_.another_side(advice, pass)));
      if (!laid) return false;
    }
    if (!by_itself) return true;
    if (!advised) {
      out_.notes.push_back(
          fmt::format("there was no pass {}: no other way to lay it shows much more", pass));
      return false;
    }
    const NextPose& pose = out_.next_pass->poses.front();
    out_.notes.push_back(fmt::format("before pass {}: {}", pass, next_pass_text(*out_.next_pass)));
    TURNSCAN_TRY(source.lay_object(turn_seen_by_sensor(pose, seen_from_), seen_from_.first_time_s));
    return true;
  }

  Result<> scan_next(FrameSource& source, Motor* motor) {
    TURNSCAN_TRY(with_hint(take_what_waits(source)));
    TURNSCAN_TRY(with_hint(source.start()));
    TURNSCAN_TRY(with_hint(wait(source)));
    CaptureOptions options = setup().options;
    options.add_pass = true;
    TURNSCAN_TRY(with_hint(record(source, motor, options)));
    const AfterClock after;
    source.stop();
    TURNSCAN_TRY(capture_outcome(out_.captured.back(), out_.recording));
    TURNSCAN_ASSIGN(const Recording recording, Recording::open(out_.recording));
    ReconstructRequest request;
    request.options = request_.reconstruct;
    request.allow_open = request_.allow_open;
    TURNSCAN_ASSIGN(ReconstructRun run,
                    with_hint(run_reconstruction(recording, request, context_)));
    TURNSCAN_TRY(write_joined(run));
    after.tell(out_);
    return write_beside(source.info());
  }

  /// Frames of how the object lay before.
  Result<> take_what_waits(FrameSource& source) const {
    for (;;) {
      TURNSCAN_ASSIGN(const Delivery delivery, source.next(0.0, context_));
      if (delivery.kind != Delivery::Kind::kFrame) return {};
    }
  }

  /// Where no pass was joined the mesh stays what it was.
  Result<> write_joined(ReconstructRun& run) {
    const std::vector<std::string> before = std::move(out_.files);
    out_.files.clear();
    if (!run.reconstruction.objects.empty()) {
      out_.reconstruction = std::move(run.reconstruction);
      out_.frame_residuals = std::move(run.frame_residuals);
      out_.next_pass = std::move(run.next_pass);
      seen_from_ = std::move(run.seen_from);
      TURNSCAN_ASSIGN(out_.files,
                      write_objects(request_.mesh, out_.reconstruction, request_.mesh_options));
    } else {
      for (const std::string& file : before)
        if (!is_beside(file)) out_.files.push_back(file);
    }
    out_.apart.clear();
    for (PassApart& pass : run.apart) {
      if (pass.reason.empty()) continue;
      if (!pass.reconstruction.objects.empty()) {
        TURNSCAN_ASSIGN(const auto own, write_objects(mesh_of_pass(request_.mesh, pass.number),
                                                      pass.reconstruction, request_.mesh_options));
        out_.files.insert(out_.files.end(), own.begin(), own.end());
      }
      out_.apart.push_back(std::move(pass));
    }
    // A pass that did not fit until now has no mesh of its own any more.
    for (const std::string& file : before) {
      std::error_code ignored;
      if (!is_beside(file) &&
          std::find(out_.files.begin(), out_.files.end(), file) == out_.files.end())
        fs::remove(file, ignored);
    }
    return {};
  }

  bool is_beside(const std::string& file) const {
    return file == request_.report || file == request_.page || file == request_.advice_picture;
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

  ScanRequest request_;
  const ScanHooks& hooks_;
  const RunContext& context_;
  ScanOutcome out_;
  std::unique_ptr<LiveReconstruction> live_;
  std::unique_ptr<ScanAhead> ahead_;
  CalibrationChoice choice_;  ///< of the first pass
  PassViews seen_from_;       ///< of the last pass in the mesh
  bool laid_ = false;         ///< the object can be laid another way
};

}  // namespace

Result<ScanOutcome> run_scan(ScanRequest request, const ScanHooks& hooks,
                             const RunContext& context) {
  return ScanRun(std::move(request), hooks, context).run();
}

}  // namespace turnscan
