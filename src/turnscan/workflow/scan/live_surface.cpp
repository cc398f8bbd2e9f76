#include <turnscan/workflow/scan/live_surface.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/process/thread_priority.hpp>

namespace turnscan {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kAtOnce = 4;
/// Limits above which the axis, found from a small part of a turn, would smear the surface.
constexpr double kMaxCenterSigma_m = 0.004, kMaxAxisSigma_rad = 0.02;

bool known_well(const Calibration& shown) {
  return shown.center_sigma_m < kMaxCenterSigma_m && shown.axis_sigma_rad < kMaxAxisSigma_rad;
}

}  // namespace

std::optional<double> LiveMotion::turned_rad(const FrameInfo& info) const {
  if (info.angle_rad) return info.angle_rad;
  if (!speed_rad_s || !std::isfinite(info.time_s)) return std::nullopt;
  return *speed_rad_s * std::max(0.0, info.time_s - start_s);
}

std::optional<LiveMotion> live_motion(const TurntableInfo* known, const Calibration* shown,
                                      std::optional<double> speed_rad_s, bool has_angles,
                                      double first_s) {
  LiveMotion out;
  if (known) {
    out.table = *known;
  } else if (shown && known_well(*shown)) {
    out.table = shown->table;
  } else {
    return std::nullopt;
  }
  out.start_s = first_s;
  if (speed_rad_s) {
    out.speed_rad_s = speed_rad_s;
  } else if (shown && shown->table.speed_rad_s) {
    out.speed_rad_s = shown->table.speed_rad_s;
    // The sign belongs to the axis with which it was found.
    if (shown->table.axis.dot(out.table.axis) < 0.0) out.speed_rad_s = -*out.speed_rad_s;
    out.start_s = std::max(first_s, shown->start_s.value_or(first_s));
  } else if (!has_angles) {
    return std::nullopt;
  }
  return out;
}

LiveMotionFinder::LiveMotionFinder(const SequenceHeader& header, std::optional<double> speed_rad_s)
    : table_(header.turntable), speed_rad_s_(speed_rad_s) {
  if (!speed_rad_s_ && table_) speed_rad_s_ = table_->speed_rad_s;
}

std::optional<LiveMotion> LiveMotionFinder::take(const FrameInfo& frame) {
  if (frame.status != FrameStatus::kOk) return std::nullopt;
  if (!first_s_ && std::isfinite(frame.time_s)) first_s_ = frame.time_s;
  const bool has_angle = frame.angle_rad.has_value();
  if (found_ || (!speed_rad_s_ && !has_angle)) return std::nullopt;
  auto motion = live_motion(table_ ? &*table_ : nullptr, nullptr, speed_rad_s_, has_angle,
                            first_s_.value_or(0.0));
  found_ = motion.has_value();
  return motion;
}

std::optional<LiveMotion> LiveMotionFinder::take(const std::shared_ptr<const Calibration>& shown) {
  if (!shown || shown == shown_) return std::nullopt;
  shown_ = shown;
  auto motion = live_motion(table_ ? &*table_ : nullptr, shown.get(), std::nullopt, false,
                            first_s_.value_or(0.0));
  found_ = found_ || motion.has_value();
  return motion;
}

LiveSurface::LiveSurface(SequenceHeader header)
    : header_(std::move(header)), thread_([this] {
        process::lower_thread_priority();  // a preview must not cause dropped frames
        run_on_this_thread([this] { run(); });
      }) {}

LiveSurface::~LiveSurface() {
  context_.cancel();
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void LiveSurface::add(const Frame& frame) {
  if (frame.info.status != FrameStatus::kOk || frame.info.sensor != 0) return;
  const std::lock_guard lock(mutex_);
  const std::uint64_t number = came_++;
  if (number % every_ != 0) return;
  Frame copy = frame;
  copy.color = ColorImage();  // the preview is coloured by coverage instead
  kept_.push_back({number, std::make_shared<const Frame>(std::move(copy))});
  if (kept_.size() > kMaxFrames) {
    every_ *= 2;
    std::erase_if(kept_, [this](const Kept& kept) { return kept.number % every_ != 0; });
  }
  wake_.notify_all();
}

void LiveSurface::set_motion(const LiveMotion& motion) {
  const std::lock_guard lock(mutex_);
  motion_ = motion;
  anew_ = true;
  wake_.notify_all();
}

void LiveSurface::rest(bool resting) {
  const std::lock_guard lock(mutex_);
  resting_ = resting;
  wake_.notify_all();
}

std::vector<std::shared_ptr<const Frame>> LiveSurface::frames() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::shared_ptr<const Frame>> out;
  for (const Kept& kept : kept_) out.push_back(kept.frame);
  return out;
}

std::optional<LiveSurface::Update> LiveSurface::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(update_, std::nullopt);
}

bool LiveSurface::wait_for_work(std::vector<Kept>& batch, std::optional<LiveMotion>& anew) {
  std::unique_lock lock(mutex_);
  const auto first = [this] {
    return std::find_if(kept_.begin(), kept_.end(),
                        [this](const Kept& kept) { return kept.number >= next_; });
  };
  const auto ready = [&] {
    return closing_ || (!resting_ && motion_ && (anew_ || first() != kept_.end()));
  };
  if (pending_) {
    // Includes the last frames, even if none follows them.
    wake_.wait_for(lock, std::chrono::duration<double>(kMinPause_s), ready);
  } else {
    wake_.wait(lock, ready);
  }
  if (closing_) return false;
  anew.reset();
  batch.clear();
  if (resting_) return true;
  if (anew_) {
    anew = motion_;
    anew_ = false;
    next_ = 0;
  }
  for (auto kept = first(); kept != kept_.end() && batch.size() < kAtOnce; ++kept)
    batch.push_back(*kept);
  if (!batch.empty()) next_ = batch.back().number + 1;
  return true;
}

Result<> LiveSurface::work(const std::vector<Kept>& batch, const std::optional<LiveMotion>& anew) {
  if (anew) {
    placed_ = *anew;
    SequenceHeader header = header_;
    header.turntable = placed_.table;
    header.turntable->speed_rad_s.reset();  // included in the angles
    TURNSCAN_ASSIGN(stream_, ReconstructionStream::create(header, {}));
    added_ = 0;
  }
  std::vector<Frame> frames;
  for (const Kept& kept : batch) {
    Frame frame = *kept.frame;
    frame.info.angle_rad = placed_.turned_rad(frame.info);
    if (frame.info.angle_rad) frames.push_back(std::move(frame));
  }
  TURNSCAN_TRY(stream_->add(frames, context_));
  added_ += frames.size();
  return {};
}

void LiveSurface::run() {
  std::vector<Kept> batch;
  std::optional<LiveMotion> anew;
  Clock::time_point last = Clock::now() - std::chrono::seconds(1);
  bool failed = false;
  while (wait_for_work(batch, anew)) {
    if (anew) failed = false;
    // Errors will appear in the reconstruction; here there is just no mesh.
    if (!failed) failed = !work(batch, anew).has_value();
    pending_ = !failed;
    if (failed || Clock::now() - last < std::chrono::duration<double>(kMinPause_s)) continue;
    last = Clock::now();
    auto mesh = stream_->preview(context_);
    pending_ = false;
    if (!mesh || mesh->empty()) continue;
    const std::lock_guard lock(mutex_);
    update_ = Update{std::move(*mesh), added_};
  }
}

}  // namespace turnscan
