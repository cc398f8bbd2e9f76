#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <turnscan/capture/recorder/depth_crop.hpp>
#include <turnscan/capture/session/capture.hpp>
#include <turnscan/capture/session/capture_options.hpp>
#include <turnscan/capture/session/turn_counter.hpp>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/stopwatch.hpp>
#include <turnscan/core/units.hpp>
#include <turnscan/core/utc_time.hpp>
#include <turnscan/recording/repair.hpp>
#include <turnscan/recording/unfinished.hpp>
#include <turnscan/turntable/table_frame.hpp>

namespace turnscan {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kPoll_s = 0.1;
constexpr double kMaxUnknown_s = 60.0;  ///< of recording while the speed of the table is not known
constexpr double kBetweenStretches_s = 1.0;  ///< in the times of a source whose clock began anew
constexpr double kSameTime_s = 1e-6;         ///< of a frame that is given again
/// Keys of the settings: number of stops in a turn, the board's angle at the first one, how the
/// recording ended, and that this was too early.
constexpr const char *kStops = "stops", *kBoardAngle = "board_angle_rad", *kEnded = "ended",
                     *kEndedEarly = "ended_early";
constexpr double kBytesPerPixel = 1.2;  ///< of a noisy depth image as PNG, measured

double process_cpu_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Estimated size on disk; 0 if it cannot be estimated.
double expected_bytes(const SequenceHeader& header, const SourceInfo& info,
                      const CaptureOptions& options) {
  double pixels = 0.0;
  for (const SensorInfo& sensor : header.sensors)
    pixels += double(sensor.intrinsics.width) * double(sensor.intrinsics.height);
  double frames = 0.0;
  if (options.limits.frames) frames = double(*options.limits.frames);
  if (options.limits.seconds) frames = *options.limits.seconds * info.fps;
  if (!options.limits.frames && !options.limits.seconds && options.speed_rad_s)
    frames = options.limits.turns.value_or(1.0) * kTurn / std::abs(*options.speed_rad_s) * info.fps;
  return pixels * kBytesPerPixel * frames;
}

/// Statistics since an earlier state, for a source that was used for earlier passes.
SourceStatistics counted_since(const SourceStatistics& before, SourceStatistics now) {
  now.delivered -= before.delivered;
  now.dropped_by_sensor -= before.dropped_by_sensor;
  now.dropped_by_queue -= before.dropped_by_queue;
  now.refused -= before.refused;
  return now;
}

/// A recording in progress.
class Session {
 public:
  Session(FrameSource& source, std::filesystem::path folder, const SequenceHeader& header,
          const CaptureSettings& settings, const CaptureOptions& options, const CaptureHooks& hooks,
          const RunContext& context)
      : source_(source),
        folder_(std::move(folder)),
        header_(header),
        settings_(settings),
        options_(options),
        hooks_(hooks),
        context_(context),
        turns_(header, speed_for_counting(), wants_turns(), !source.info().live, context) {}

  Result<> prepare() {
    if (options_.stops.stops) settings_[kStops] = fmt::format("{}", *options_.stops.stops);
    if (options_.add_pass) TURNSCAN_TRY(continue_recording());
    if (options_.resume) TURNSCAN_TRY(resume_recording());
    if (!options_.crop.enabled) return {};
    Cylinder cylinder;
    cylinder.margin_m = -options_.crop.below_m;
    cylinder.height_m = options_.crop.height_m;
    if (!header_.turntable || !header_.turntable->radius_m)
      return fail(ErrorCode::kInvalidOption,
                  "crop: it needs the turntable's pose and radius; calibrate first");
    cylinder.radius_m = *header_.turntable->radius_m + options_.crop.beyond_m;
    for (std::size_t i = 0; i < header_.sensors.size(); ++i) {
      TURNSCAN_ASSIGN(const Pose pose, sensor_pose(header_, i));
      TURNSCAN_ASSIGN(DepthCrop crop, DepthCrop::create(cylinder, pose, header_.sensors[i]));
      crops_.push_back(std::move(crop));
    }
    return {};
  }

  Result<CaptureResult> run() {
    const double cpu = process_cpu_s();
    Result<> done = options_.stops.stops ? stop_and_go() : steadily();
    if (!done && !recorder_ && done.error().code != ErrorCode::kCancelled && refused_at_start_)
      return tl::unexpected<Error>(std::move(done).error());
    if (!done) result_.error = std::move(done).error();
    if (hooks_.motor != nullptr) stop_motor();
    finish();
    result_.source = counted_since(before_, source_.statistics());
    result_.turned_rad = turns_.turned_rad();
    result_.turns_found = turns_.found();
    result_.speed_rad_s = turns_.speed_rad_s();
    result_.cpu_s = process_cpu_s() - cpu;
    return std::move(result_);
  }

 private:
  bool wants_turns() const {
    const CaptureLimits& limits = options_.limits;
    return !limits.seconds && !limits.frames && !limits.until_stopped;
  }
  std::optional<double> speed_for_counting() const {
    if (options_.speed_rad_s) return options_.speed_rad_s;
    return header_.turntable ? header_.turntable->speed_rad_s : std::nullopt;
  }
  /// Prefix of the settings of a further pass.
  std::string prefix_of_pass() const {
    return options_.add_pass ? fmt::format("pass_{}_", pass_) : "";
  }
  double wanted_rad() const {
    return options_.limits.turns.value_or(1.0) * kTurn + options_.limits.overlap_rad;
  }

  bool has_sensors_of(const Recording& recording) const {
    const auto is_same = [](const SensorInfo& one, const SensorInfo& other) {
      return one.kind == other.kind && one.model == other.model &&
             one.intrinsics.width == other.intrinsics.width &&
             one.intrinsics.height == other.intrinsics.height;
    };
    const auto& sensors = recording.header().sensors;
    return std::equal(sensors.begin(), sensors.end(), header_.sensors.begin(),
                      header_.sensors.end(), is_same);
  }

  /// Numbers the new frames after those of the existing passes.
  Result<> continue_recording() {
    TURNSCAN_ASSIGN(const Recording recording, Recording::open(folder_, context_));
    if (!has_sensors_of(recording))
      return fail_at(folder_.string(), ErrorCode::kInvalidOption,
                     "its passes were recorded with other sensors; make a recording of its own");
    header_ = recording.header();
    settings_ = recording.capture_settings();
    for (const FrameInfo& frame : recording.frames()) {
      next_index_ = std::max(next_index_, frame.index + 1);
      pass_ = std::max(pass_, frame.pass + 1);
    }
    return {};
  }

  static std::string setting(const CaptureSettings& settings, const std::string& key) {
    const auto found = settings.find(key);
    return found == settings.end() ? std::string() : found->second;
  }

  /// Why the recording cannot be resumed; empty: it can.
  std::string reason_against(const Recording& recording) const {
    const CaptureSettings& before = recording.capture_settings();
    if (before.count(kEnded) > 0 && before.count(kEndedEarly) == 0)
      return "it is finished, so that there is nothing to go on with; choose another folder";
    const auto is_of_device = [](const auto& s) { return s.first.starts_with("device"); };
    CaptureSettings devices, own;
    std::copy_if(before.begin(), before.end(), std::inserter(devices, devices.end()), is_of_device);
    std::copy_if(settings_.begin(), settings_.end(), std::inserter(own, own.end()), is_of_device);
    if (devices != own || !has_sensors_of(recording))
      return "another device, or one of another image size, recorded it; give that --device, or "
             "choose another folder";
    if (setting(before, kStops) != setting(settings_, kStops))
      return before.count(kStops) == 0
                 ? std::string("its table turned steadily; leave out --stops")
                 : fmt::format("its table stood {} times a turn; give --motor and --stops {}",
                               setting(before, kStops), setting(before, kStops));
    for (std::size_t i = 0; i < recording.frames().size(); ++i) {
      const FrameInfo& frame = recording.frames()[i];
      if (frame.pass != 0)
        return "a further pass was being recorded; finish it with 'turnscan info --repair'";
      if (frame.index != i)
        return "another program numbered its frames; make a recording of its own";
    }
    return "";
  }

  Result<> resume_recording() {
    TURNSCAN_ASSIGN(const Recording recording, Recording::open(folder_, context_));
    if (const std::string reason = reason_against(recording); !reason.empty())
      return fail_at(folder_.string(), ErrorCode::kInvalidOption, "{}", reason);
    was_finished_ = !is_unfinished_recording(folder_);
    TURNSCAN_TRY(repair_recording(folder_, context_));
    header_ = recording.header();
    settings_ = recording.capture_settings();
    settings_.erase(kEndedEarly);
    recorded_ = recording.frames();
    if (options_.stops.stops) first_angle_ = 0.0;
    if (!source_.info().live || recorded_.empty()) return {};
    next_index_ = std::uint32_t(recorded_.size());
    stretch_ = recorded_.back().stretch;
    if (!options_.stops.stops) {
      resumed_at_ = next_index_;
      ++stretch_;
    }
    for (const FrameInfo& frame : recorded_)
      if (std::isfinite(frame.time_s))
        last_recorded_s_ = std::max(frame.time_s, last_recorded_s_.value_or(frame.time_s));
    return {};
  }

  /// Sets the times of a source whose clock began anew after those of the recording.
  void continue_times(FrameInfo& info) {
    if (!last_recorded_s_ || !std::isfinite(info.time_s)) return;
    if (!time_offset_s_)
      time_offset_s_ = info.time_s > *last_recorded_s_
                           ? 0.0
                           : *last_recorded_s_ + kBetweenStretches_s - info.time_s;
    info.time_s += *time_offset_s_;
  }

  // --- taking frames

  /// The next frame, with no time limit. nullopt: the source has ended.
  Result<std::optional<Frame>> take() {
    for (;;) {
      TURNSCAN_ASSIGN(Delivery delivery, source_.next(kPoll_s, context_));
      const double gap = seconds_since(last_frame_);
      if (hooks_.motor != nullptr) TURNSCAN_TRY(hooks_.motor->watch());
      if (delivery.kind == Delivery::Kind::kEnd) return std::optional<Frame>();
      if (delivery.kind == Delivery::Kind::kFrame) {
        if (count_ > 0) result_.longest_gap_s = std::max(result_.longest_gap_s, gap);
        last_frame_ = Clock::now();
        continue_times(delivery.frame.info);
        return std::optional<Frame>(std::move(delivery.frame));
      }
      if (gap > options_.limits.device_timeout_s)
        return fail(ErrorCode::kDeviceLost,
                    "{}: no frame came for {:.0f} s; check the cable and plug the device in again",
                    source_.info().driver, gap);
    }
  }

  Result<> create_recorder() {
    const double bytes = expected_bytes(header_, source_.info(), options_);
    // A replayed recording began when it was recorded.
    if (source_.info().driver != "replay")
      settings_.emplace(prefix_of_pass() + kStartedAt, utc_text(utc_now_s()));
    auto recorder =
        options_.add_pass || options_.resume
            ? Recorder::extend(folder_, options_.recorder, bytes, resumed_at_, was_finished_)
            : Recorder::create(folder_, header_, settings_, options_.recorder, bytes);
    refused_at_start_ = !recorder;
    if (!recorder) return tl::unexpected<Error>(std::move(recorder).error());
    recorder_.emplace(std::move(*recorder));
    return {};
  }

  Result<> record(Frame frame) {
    if (!recorder_) TURNSCAN_TRY(create_recorder());
    frame.info.index = next_index_++;
    ++count_;
    if (options_.add_pass) frame.info.pass = pass_;
    frame.info.file.clear();
    if (frame.info.angle_rad) {
      if (!first_angle_) first_angle_ = frame.info.angle_rad;
      *frame.info.angle_rad -= *first_angle_;
    }
    if (resumed_at_) frame.info.angle_rad.reset();  // it counts from another zero
    frame.info.stretch = stretch_;
    if (!crops_.empty() && !frame.depth.empty()) crops_.at(frame.info.sensor).apply(frame.depth);
    if (frame.info.index < recorded_.size()) return pass_over(frame);
    if (!source_.info().live) recorder_->wait_for_room();
    if (!hooks_.frame) return recorder_->put(std::move(frame));
    TURNSCAN_TRY(recorder_->put(frame));
    return hooks_.frame(frame);
  }

  /// A frame that was recorded before this capture was resumed.
  Result<> pass_over(const Frame& frame) {
    const FrameInfo& before = recorded_[frame.info.index];
    const bool timed = std::isfinite(before.time_s) && std::isfinite(frame.info.time_s);
    if (!source_.info().live && timed && std::abs(frame.info.time_s - before.time_s) > kSameTime_s)
      return fail_at(folder_.string(), ErrorCode::kInvalidOption,
                     "its frame {} is of another time than the one that the device gives now; give "
                     "the options with which the recording was begun",
                     before.index);
    return hooks_.frame ? hooks_.frame(frame) : Result<>();
  }

  void tell(double fraction) {
    if (!hooks_.progress) return;
    CaptureProgress progress;
    const RecorderStatistics counts = recorder_->statistics();
    progress.frames = counts.written;
    progress.dropped =
        counted_since(before_, source_.statistics()).dropped() + counts.dropped_by_disk;
    progress.turned_rad = turns_.turned_rad();
    progress.motion = turns_.motion();
    progress.seconds = result_.seconds;
    progress.free_bytes = counts.free_bytes;
    progress.fraction = std::clamp(fraction, 0.0, 1.0);
    hooks_.progress(progress);
  }

  // --- a table that turns steadily

  Result<> start_motor() {
    if (hooks_.motor == nullptr) return {};
    TURNSCAN_TRY(hooks_.motor->spin(*options_.speed_rad_s));
    const auto begin = Clock::now();
    while (seconds_since(begin) < options_.motor_ramp_s) {
      TURNSCAN_TRY(source_.next(0.02, context_));  // discards the frames of the ramp
      TURNSCAN_TRY(hooks_.motor->watch());
    }
    return {};
  }

  Result<> steadily() {
    TURNSCAN_TRY(start_motor());
    last_frame_ = Clock::now();
    for (;;) {
      auto taken = take();
      if (!taken && taken.error().code == ErrorCode::kCancelled && options_.limits.until_stopped) {
        result_.ended = "when it was stopped";
        return {};
      }
      TURNSCAN_ASSIGN(auto frame, std::move(taken));
      if (!frame) {
        result_.ended = "when the source ended";
        return {};
      }
      note_time(frame->info);
      if (hooks_.motor != nullptr) frame->info.angle_rad = *options_.speed_rad_s * result_.seconds;
      turns_.add(*frame);
      if (is_beyond()) return {};
      TURNSCAN_TRY(record(std::move(*frame)));
      TURNSCAN_TRY(check_turns_known());
      tell(fraction());
    }
  }

  void note_time(const FrameInfo& info) {
    if (!std::isfinite(info.time_s)) return;
    if (!first_time_) first_time_ = info.time_s;
    result_.seconds = std::max(result_.seconds, info.time_s - *first_time_);
  }

  /// A frame beyond the limits ends the recording.
  bool is_beyond() {
    const CaptureLimits& limits = options_.limits;
    const std::size_t sensors = header_.sensors.size();
    bool end = false;
    if (limits.frames) end = count_ >= std::uint32_t(*limits.frames) * sensors;
    if (limits.seconds) end = result_.seconds > *limits.seconds;
    if (wants_turns()) end = turns_.turned_rad().value_or(0.0) > wanted_rad();
    if (end) result_.ended = "as it was meant to";
    return end;
  }

  double fraction() const {
    const CaptureLimits& limits = options_.limits;
    if (limits.frames)
      return double(count_) / double(std::size_t(*limits.frames) * header_.sensors.size());
    if (limits.seconds) return result_.seconds / *limits.seconds;
    return wants_turns() ? turns_.turned_rad().value_or(0.0) / wanted_rad() : 0.0;
  }

  Result<> check_turns_known() const {
    if (!wants_turns() || turns_.turned_rad() || result_.seconds < kMaxUnknown_s) return {};
    return fail(ErrorCode::kMissingData,
                "after {:.0f} s it is not known how fast the table turns ({}); give --speed, or "
                "--seconds in place of turns",
                result_.seconds, turns_.trouble().empty() ? "nothing moves" : turns_.trouble());
  }

  // --- stop and go

  Result<> stop_and_go() {
    const int stops = *options_.stops.stops;
    const double turns = options_.limits.turns.value_or(1.0), speed = *options_.speed_rad_s;
    const double step = std::copysign(kTurn / double(stops), speed);
    const int count = static_cast<int>(std::lround(turns * double(stops)));
    // What is recorded of an incomplete stop is passed over.
    const int known = static_cast<int>(recorded_.size() / header_.sensors.size());
    const int first = source_.info().live ? known : 0;
    if (options_.resume) next_index_ = std::uint32_t(std::size_t(first) * header_.sensors.size());
    last_frame_ = Clock::now();
    for (int i = first; i < count; ++i) {
      if (i == 0) TURNSCAN_TRY(note_board_angle());
      if (i >= known) TURNSCAN_TRY(turn_to(i, known, step, std::abs(speed)));
      TURNSCAN_TRY(settle());
      TURNSCAN_TRY(record_stop(step * double(i), i / stops));
      tell(double(i + 1) / double(count));
    }
    result_.ended = "as it was meant to";
    return {};
  }

  Result<> note_board_angle() {
    TURNSCAN_ASSIGN(const MotorStatus now, hooks_.motor->status());
    settings_.emplace(kBoardAngle, fmt::format("{}", now.board_rad));
    return {};
  }

  /// Turns from the stop before; in a resumed recording from wherever the board says that the table
  /// stands. A board that was restarted does not know it: the table is taken to stand at the last
  /// stop that was recorded.
  Result<> turn_to(int stop, int first_new, double step, double speed) {
    double angle = stop == 0 ? 0.0 : step;
    if (options_.resume && stop == first_new) {
      TURNSCAN_TRY(hooks_.motor->stop());  // it may still be turning, or wait for this
      TURNSCAN_ASSIGN(const MotorStatus now, hooks_.motor->status());
      const auto zero = parse_number(setting(settings_, kBoardAngle));
      const double target = zero.value_or(0.0) + step * double(stop);
      const bool restarted = now.board_rad == 0.0 && std::abs(target - step) > 0.5 * std::abs(step);
      if (zero && !restarted) angle = target - now.board_rad;
    }
    return angle == 0.0 ? Result<>() : hooks_.motor->rotate(angle, speed, context_);
  }

  /// Discards frames taken while the table turned.
  Result<> settle() {
    while (source_.info().live) {
      TURNSCAN_ASSIGN(const Delivery delivery, source_.next(0.0, context_));
      if (delivery.kind != Delivery::Kind::kFrame) break;
    }
    last_frame_ = Clock::now();
    std::optional<double> since;
    for (;;) {
      TURNSCAN_ASSIGN(const auto frame, take());
      if (!frame) return ended_too_early();
      if (!since) since = frame->info.time_s;
      if (!(frame->info.time_s - *since < options_.stops.settle_s)) return {};
    }
  }

  static tl::unexpected<Error> ended_too_early() {
    return fail(ErrorCode::kMissingData, "the source ended before the turn was complete");
  }

  Result<> record_stop(double angle_rad, int turn) {
    std::vector<std::vector<Frame>> taken(header_.sensors.size());
    const auto want = std::size_t(options_.stops.averaged);
    while (
        std::any_of(taken.begin(), taken.end(), [&](const auto& t) { return t.size() < want; })) {
      TURNSCAN_ASSIGN(auto frame, take());
      if (!frame) return ended_too_early();
      note_time(frame->info);
      auto& frames = taken.at(frame->info.sensor);
      if (frame->info.status == FrameStatus::kOk && frames.size() < want)
        frames.push_back(std::move(*frame));
    }
    for (const auto& frames : taken) {
      Frame mean = mean_frame(frames);
      mean.info.angle_rad = angle_rad;
      mean.info.turn = static_cast<std::uint32_t>(turn);
      turns_.add(mean);
      TURNSCAN_TRY(record(std::move(mean)));
    }
    return {};
  }

  // --- the end

  void stop_motor() {
    if (auto stopped = hooks_.motor->stop(); !stopped && !result_.error)
      result_.error = std::move(stopped).error();
  }

  void finish() {
    if (!recorder_) return;
    if (result_.error)
      result_.ended = result_.error->code == ErrorCode::kCancelled ? "when it was stopped"
                                                                   : result_.error->message;
    CaptureSettings settings = settings_;
    const std::string of_pass = prefix_of_pass();
    settings[of_pass + kEnded] = result_.ended;
    if (result_.error && !options_.add_pass) settings[kEndedEarly] = "true";
    if (!turns_.found().empty()) settings[of_pass + "turns_counted_by"] = turns_.found();
    recorder_->describe(header_, settings);
    auto finished = recorder_->finish();
    result_.recorder = recorder_->statistics();
    result_.recorded = true;
    result_.complete = finished.has_value();
    if (!finished && !result_.error) result_.error = std::move(finished).error();
  }

  FrameSource& source_;
  std::filesystem::path folder_;
  SequenceHeader header_;
  CaptureSettings settings_;
  const CaptureOptions& options_;
  const CaptureHooks& hooks_;
  const RunContext& context_;
  session::TurnCounter turns_;
  std::vector<DepthCrop> crops_;
  std::optional<Recorder> recorder_;
  bool refused_at_start_ = false;
  CaptureResult result_;
  const SourceStatistics before_ = options_.add_pass ? source_.statistics() : SourceStatistics();
  std::uint32_t next_index_ = 0, pass_ = 0;
  std::uint32_t count_ = 0;  // of recorded frames
  // Of a recording that is resumed: its frames so far, and the first one of a new stretch.
  std::vector<FrameInfo> recorded_;
  std::optional<std::uint32_t> resumed_at_;
  bool was_finished_ = true;  // before it was resumed
  std::uint32_t stretch_ = 0;
  std::optional<double> last_recorded_s_, time_offset_s_;
  std::optional<double> first_time_, first_angle_;
  Clock::time_point last_frame_ = Clock::now();
};

}  // namespace

Frame mean_frame(const std::vector<Frame>& frames) {
  Frame mean = frames.back();
  if (mean.depth.empty()) return mean;
  const std::size_t pixels = mean.depth.pixels.size();
  for (std::size_t i = 0; i < pixels; ++i) {
    std::uint64_t sum = 0, count = 0;
    for (const Frame& frame : frames) {
      const std::uint16_t raw = frame.depth.pixels[i];
      if (raw == kNoReturn || raw == kOutsideCrop) continue;
      sum += raw;
      ++count;
    }
    mean.depth.pixels[i] = 2 * count < frames.size() || count == 0
                               ? kNoReturn
                               : static_cast<std::uint16_t>((sum + count / 2) / count);
  }
  return mean;
}

Result<CaptureResult> capture(FrameSource& source, const std::filesystem::path& folder,
                              const SequenceHeader& header, const CaptureSettings& settings,
                              const CaptureOptions& options, const CaptureHooks& hooks,
                              const RunContext& context) {
  TURNSCAN_TRY(session::check_capture_options(options, hooks.motor != nullptr));
  Session session(source, folder, header, settings, options, hooks, context);
  TURNSCAN_TRY(session.prepare());
  return session.run();
}

}  // namespace turnscan
