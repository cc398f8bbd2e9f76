#include <algorithm>
#include <chrono>
#include <cmath>
#include <turnscan/capture/session/turn_counter.hpp>
#include <turnscan/core/process/thread_priority.hpp>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/turntable/motion/calibrate_from_motion.hpp>

namespace turnscan::session {

namespace {

constexpr double kFirstAttempt_s = 4.0;
constexpr double kLater = 1.5;        ///< ratio of the intervals used by successive attempts
constexpr std::size_t kMaxKept = 64;  ///< frames in memory, spread over the time so far
constexpr double kGoodSigma = 0.02;   ///< relative standard deviation of the speed
/// Angle after which the speed is estimated again.
constexpr double kWell_rad = 3.1415926535897932;

}  // namespace

TurnCounter::TurnCounter(const SequenceHeader& header, std::optional<double> speed_rad_s,
                         bool find_speed, bool wait, const RunContext& context)
    : quiet_(context.quiet()),
      header_(header),
      speed_(speed_rad_s),
      find_speed_(find_speed && !speed_rad_s),
      wait_(wait),
      attempt_s_(kFirstAttempt_s) {
  if (speed_) found_ = "stated speed";
  // The first sensor determines the speed.
  if (header_.sensors.size() > 1) header_.sensors.resize(1);
}

TurnCounter::~TurnCounter() {
  quiet_.cancel();
  if (search_.valid()) search_.wait();
}

void TurnCounter::add(const Frame& frame) {
  const FrameInfo& info = frame.info;
  if (std::isfinite(info.time_s)) {
    if (!first_time_) first_time_ = info.time_s;
    last_time_ = info.time_s;
  }
  if (info.angle_rad) {
    if (!first_angle_) first_angle_ = info.angle_rad;
    turned_ = std::abs(*info.angle_rad - *first_angle_);
    found_ = "angles of the frames";
    return;
  }
  if (find_speed_ && !found_well_ && info.status == FrameStatus::kOk && info.sensor == 0)
    look_for_speed(frame);
  if (speed_ && first_time_ && last_time_) {
    const double since = std::max(*first_time_, start_time_.value_or(*first_time_));
    turned_ = std::abs(*speed_) * std::max(0.0, *last_time_ - since);
  }
}

void TurnCounter::look_for_speed(const Frame& frame) {
  take_result();
  if (found_well_ || !first_time_) return;
  if (seen_++ % every_ == 0) {
    Frame copy = frame;
    copy.color = ColorImage();
    kept_.push_back(std::make_shared<const Frame>(std::move(copy)));
  }
  if (kept_.size() > kMaxKept) {  // from now on, keep only every second one
    for (std::size_t i = 0; 2 * i < kept_.size(); ++i) kept_[i] = kept_[2 * i];
    kept_.resize((kept_.size() + 1) / 2);
    every_ *= 2;
  }
  if (search_.valid() || kept_.size() < 8 || !time_to_look()) return;
  attempt_s_ *= kLater;
  last_search_ = speed_.has_value();
  search_ = std::async(std::launch::async, [header = header_, kept = kept_, quiet = quiet_] {
    process::lower_thread_priority();
    FromMotionOptions options;
    options.use_angles = false;
    return calibrate_from_motion(MemoryFrames(header, kept), options, DetectOptions(), quiet);
  });
  if (wait_) take_result();
}

bool TurnCounter::time_to_look() const {
  if (speed_) return turned_.value_or(0.0) > kWell_rad;
  return *last_time_ - *first_time_ >= attempt_s_;
}

void TurnCounter::take_result() {
  if (!search_.valid()) return;
  if (!wait_ && search_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  Result<Calibration> found = search_.get();
  found_well_ = last_search_;
  if (found_well_) kept_.clear();
  if (!found) {
    trouble_ = found.error().message;
    return;
  }
  const std::optional<double> speed = found->table.speed_rad_s;
  const bool guessed = std::find(found->undetermined.begin(), found->undetermined.end(), "speed") !=
                       found->undetermined.end();
  if (!speed || guessed || !(std::abs(*speed) > 1e-3) ||
      (std::isfinite(found->speed_sigma_rad_s) &&
       found->speed_sigma_rad_s > kGoodSigma * std::abs(*speed))) {
    trouble_ = "the object's shape does not show how fast it turns";
    return;
  }
  speed_ = speed;
  start_time_ = found->start_s;
  found_ = "motion";
  motion_ = std::make_shared<const Calibration>(std::move(*found));
}

}  // namespace turnscan::session
