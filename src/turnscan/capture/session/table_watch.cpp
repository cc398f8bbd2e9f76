#include <algorithm>
#include <chrono>
#include <cmath>
#include <turnscan/capture/recorder/depth_crop.hpp>
#include <turnscan/capture/session/table_watch.hpp>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/core/stopwatch.hpp>
#include <turnscan/turntable/table_frame.hpp>

namespace turnscan {

namespace {

constexpr double kAbove_m = 0.01, kWithin_m = 0.04, kHeight_m = 1.0;
constexpr std::size_t kMinPixels = 100;
constexpr int kMinFrames = 5;
constexpr double kWait_s = 10.0;

/// The sensor's next frame that is not dropped.
Result<Frame> next_frame(FrameSource& source, std::uint32_t sensor, const RunContext& context) {
  for (;;) {
    TURNSCAN_ASSIGN(Delivery delivery, source.next(kWait_s, context));
    if (delivery.kind == Delivery::Kind::kNothing)
      return fail(ErrorCode::kDeviceLost,
                  "{}: no frame came for {:.0f} s; check the cable and plug the device in again",
                  source.info().driver, kWait_s);
    if (delivery.kind == Delivery::Kind::kEnd)
      return fail(ErrorCode::kMissingData, "the source ended before the recording began");
    const FrameInfo& info = delivery.frame.info;
    if (info.sensor == sensor && info.status == FrameStatus::kOk) return std::move(delivery.frame);
  }
}

/// Uses the sensor's time, or this machine's if its frames have none.
class WaitClock {
 public:
  double waited_s(const FrameInfo& info) {
    if (!std::isfinite(info.time_s)) return seconds_since(begin_);
    if (!first_s_) first_s_ = info.time_s;
    return info.time_s - *first_s_;
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::optional<double> first_s_;
};

}  // namespace

Result<AveragedScan> mean_of_next(FrameSource& source, std::uint32_t sensor, int frames,
                                  const RunContext& context) {
  std::vector<std::shared_ptr<const Frame>> kept;
  for (int i = 0; i < frames; ++i) {
    TURNSCAN_ASSIGN(Frame frame, next_frame(source, sensor, context));
    kept.push_back(std::make_shared<const Frame>(std::move(frame)));
  }
  const MemoryFrames sequence(source.info().header, std::move(kept));
  AverageOptions average;
  average.frames = frames;
  return average_frames(sequence, spread_positions(sequence, sensor, std::size_t(frames)), average,
                        context);
}

Result<> wait_for_object(FrameSource& source, const SequenceHeader& header,
                         std::optional<double> most_s, const std::function<void()>& told,
                         const RunContext& context) {
  TURNSCAN_ASSIGN(const Pose pose, sensor_pose(header, 0));
  Cylinder cylinder;
  cylinder.margin_m = kAbove_m;
  cylinder.height_m = kHeight_m;
  cylinder.radius_m = std::max(0.02, header.turntable->radius_m.value_or(0.1) - kWithin_m);
  TURNSCAN_ASSIGN(const DepthCrop crop, DepthCrop::create(cylinder, pose, header.sensors[0]));
  bool waiting = false;
  WaitClock clock;
  for (int seen = 0; seen < kMinFrames;) {
    TURNSCAN_ASSIGN(Frame frame, next_frame(source, 0, context));
    if (frame.depth.empty()) return {};  // scanners that deliver points are not supported here
    crop.apply(frame.depth);
    const auto pixels =
        std::count_if(frame.depth.pixels.begin(), frame.depth.pixels.end(),
                      [](std::uint16_t raw) { return raw != kNoReturn && raw != kOutsideCrop; });
    seen = std::size_t(pixels) >= kMinPixels ? seen + 1 : 0;
    if (seen == 0 && most_s && clock.waited_s(frame.info) > *most_s)
      return fail(ErrorCode::kMissingData,
                  "nothing stood on the platter within {:.1f} s (--seconds); put the object on it "
                  "first, give more seconds, or record what is there with --no-wait",
                  *most_s);
    if (seen == 0 && !waiting) {
      waiting = true;
      told();
    }
  }
  return {};
}

}  // namespace turnscan
