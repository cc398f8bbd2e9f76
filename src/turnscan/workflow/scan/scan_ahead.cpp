#include <turnscan/workflow/scan/scan_ahead.hpp>

#include <algorithm>
#include <chrono>
#include <future>
#include <optional>
#include <thread>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/reconstruction/stream.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/turntable/checks/check.hpp>
#include <turnscan/turntable/motion/continue_motion.hpp>
#include <turnscan/workflow/calibration/exactness_text.hpp>

namespace turnscan {

namespace {

using namespace std::chrono_literals;

/// Views one turn apart also differ by their noise: by a tenth of that of one depth value.
constexpr double kClosureShare = 0.25;
constexpr double kMinLimit_m = 2e-4;

/// Result of the thread.
struct Begun {
  Calibration calibration;
  ReconstructionStream stream;
};

}  // namespace

struct ScanAhead::Parts {
  std::string folder;
  ReconstructOptions options;
  double share;
  std::size_t came = 0, first = 0;
  RunContext quiet;  ///< for the thread: its phases are not shown to the user
  std::future<Result<Begun>> begun;

  /// Waits until the frames are in the recording.
  Result<Recording> open_first() const {
    for (;;) {
      TURNSCAN_ASSIGN(Recording recording, Recording::open(folder, quiet));
      if (recording.frames().size() >= first) return recording;
      std::this_thread::sleep_for(20ms);
    }
  }

  Result<Begun> begin() const {
    TURNSCAN_ASSIGN(const Recording recording, open_first());
    const SequenceView frames = first_frames(recording, first);
    TURNSCAN_ASSIGN(Calibration found, calibrate_from_motion(frames, {}, {}, quiet));
    if (!found.undetermined.empty())
      return fail(ErrorCode::kMissingData, "they do not determine {}",
                  fmt::join(found.undetermined, ", "));
    TURNSCAN_ASSIGN(const auto calibrated, with_calibration(frames, found));
    TURNSCAN_ASSIGN(auto stream, ReconstructionStream::create(calibrated->header(), options));
    TURNSCAN_TRY(stream.add(*calibrated, 0, quiet));
    return Begun{std::move(found), std::move(stream)};
  }

  Result<Begun> wait(const RunContext& context) {
    context.begin_phase("find the motion", 0);
    while (begun.wait_for(20ms) != std::future_status::ready) TURNSCAN_TRY(context.check());
    return begun.get();
  }

  /// Extends calibration and stream to the end of the recording, if they fit it.
  Result<> complete(Begun& ahead, Outcome& out, const RunContext& context) const {
    TURNSCAN_ASSIGN(const Recording recording, Recording::open(folder, context));
    TURNSCAN_ASSIGN(ContinuedMotion all,
                    continue_motion(recording, ahead.calibration, {}, context));
    TURNSCAN_ASSIGN(const auto calibrated, with_calibration(recording, all.calibration));
    TURNSCAN_ASSIGN(const auto closure, measure_closure(*calibrated, context));
    if (!closure)
      return fail(ErrorCode::kMissingData, "no view of the object comes back after one turn");
    out.closure_m = closure->shift_m;
    out.closure_limit_m = std::max(kMinLimit_m, kClosureShare * all.noise_m);
    if (!(out.closure_m <= out.closure_limit_m))
      return fail(ErrorCode::kMissingData,
                  "one turn later the object would lie {:.2f} mm off, more than {:.2f} mm",
                  out.closure_m * 1e3, out.closure_limit_m * 1e3);
    TURNSCAN_TRY(ahead.stream.add(*calibrated, first, context));
    out.calibration = std::move(all.calibration);
    return {};
  }
};

ScanAhead::ScanAhead(std::string recording, const ReconstructOptions& options, double share,
                     const RunContext& context)
    : parts_(std::make_unique<Parts>()) {
  parts_->quiet = context.quiet();
  parts_->folder = std::move(recording);
  parts_->options = options;
  parts_->options.merge.speed_rad_s.reset();  // included in the angles
  parts_->share = share;
}

ScanAhead::~ScanAhead() {
  parts_->quiet.cancel();
  if (parts_->begun.valid()) parts_->begun.wait();
}

void ScanAhead::frame_came() { ++parts_->came; }

void ScanAhead::progress(double fraction) {
  if (parts_->first > 0 || !(fraction >= parts_->share)) return;
  parts_->first = parts_->came;
  parts_->begun = std::async(std::launch::async, [parts = parts_.get()] { return parts->begin(); });
}

Result<ScanAhead::Outcome> ScanAhead::finish(const RunContext& context) {
  Outcome out;
  out.frames_ahead = parts_->first;
  if (out.frames_ahead == 0) return out;
  auto ahead = parts_->wait(context);
  TURNSCAN_TRY(context.check());
  const Result<> good = ahead ? parts_->complete(*ahead, out, context)
                              : Result<>(tl::unexpected<Error>(ahead.error()));
  if (!good && good.error().code == ErrorCode::kCancelled)
    return tl::unexpected<Error>(good.error());
  if (!good) {
    out.note = fmt::format(
        "the first {} frames were calibrated and added up while the others "
        "were recorded, but that was not kept: {}",
        out.frames_ahead, good.error().message);
    return out;
  }
  TURNSCAN_ASSIGN(out.reconstruction, ahead->stream.finish({}, context));
  out.kept = true;
  out.note = fmt::format(
      "the turntable was found from motion, in the first {} frames while the others were recorded: "
      "{}; one turn later the object lies {:.2f} mm off (noise included; up to {:.2f} mm is good)",
      out.frames_ahead, workflow::exactness_text(out.calibration), out.closure_m * 1e3,
      out.closure_limit_m * 1e3);
  return out;
}

}  // namespace turnscan
