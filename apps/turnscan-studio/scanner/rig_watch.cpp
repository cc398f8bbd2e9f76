#include "scanner/rig_watch.hpp"

#include <turnscan/core/stopwatch.hpp>
#include <turnscan/turntable/detection/average.hpp>

namespace turnscan::studio {

Result<RigWatch::Look> RigWatch::look_at(const MemoryFrames& frames, const Calibration* calibration,
                                         const RunContext& context) {
  TURNSCAN_ASSIGN(
      const AveragedScan scan,
      average_frames(frames, spread_positions(frames, 0, frames.frames().size()), {}, context));
  Look out;
  if (calibration) {
    TURNSCAN_ASSIGN(out.rig, check_rig(scan, *calibration, context));
  } else {
    TURNSCAN_ASSIGN(out.platter, detect_platter(scan, {}, context));
  }
  return out;
}

RigWatch::~RigWatch() {
  context_.cancel();
  if (look_.valid()) look_.wait();
}

void RigWatch::take(const Frame& frame, const SequenceHeader& header,
                    const std::shared_ptr<const Calibration>& calibration) {
  if (calibration != calibration_) {
    calibration_ = calibration;
    frames_.clear();
    found_.reset();
    platter_.reset();
    no_platter_.clear();
    outdated_ = look_.valid();
    last_ = Clock::now() - std::chrono::minutes(1);
  }
  collect_result();
  if (!calibration_ && header.turntable) return;  // the device says where it is
  if (look_.valid() || seconds_since(last_) < kPause_s) return;
  if (frame.info.sensor != 0 || frame.info.status != FrameStatus::kOk) return;
  frames_.push_back(frame);
  frames_.back().color = ColorImage();
  if (frames_.size() < kFrames) return;
  SequenceHeader first = header;
  first.sensors.resize(1);
  look_ = std::async(
      std::launch::async,
      [frames = MemoryFrames(std::move(first), std::exchange(frames_, {})), known = calibration_,
       context = context_] { return look_at(frames, known.get(), context); });
}

void RigWatch::collect_result() {
  if (!look_.valid() || look_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return;
  auto made = look_.get();
  last_ = Clock::now();
  if (std::exchange(outdated_, false)) return;
  // If nothing could be compared, the user is not disturbed.
  if (made && made->rig) found_ = std::move(made->rig);
  if (calibration_) return;
  platter_ = made ? made->platter : std::nullopt;
  no_platter_ = made ? std::string() : made.error().message;
}

}  // namespace turnscan::studio
