#include <algorithm>
#include <chrono>
#include <turnscan/capture/source/queued_source.hpp>
#include <turnscan/core/guarded.hpp>

namespace turnscan::source {

namespace {

constexpr double kGrabSlice_s = 0.02;  // maximum delay until a call notices cancellation

}  // namespace

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string identity_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '_' || c == '.';
    out += plain ? c : '-';
  }
  return out;
}

QueuedSource::QueuedSource(std::unique_ptr<Grabber> grabber, std::size_t capacity)
    : grabber_(std::move(grabber)), queue_(capacity, grabber_->info().live) {
  last_time_s_.assign(grabber_->info().header.sensors.size(),
                      -std::numeric_limits<double>::infinity());
}

QueuedSource::~QueuedSource() { stop(); }

Result<> QueuedSource::start() {
  if (thread_.joinable()) return {};
  if (failed_) return tl::unexpected<Error>(*failed_);
  TURNSCAN_TRY(grabber_->start());
  stopping_ = false;
  queue_.reopen();
  thread_ = std::thread([this] {
    const auto ran = guarded([this]() -> Result<> {
      run();
      return {};
    });
    if (!ran) queue_.close(ran.error());
  });
  return {};
}

void QueuedSource::stop() {
  if (!thread_.joinable()) return;
  stopping_ = true;
  // Unblocks a source that waits for a free slot; frames in the queue can still be taken.
  queue_.close(std::nullopt);
  thread_.join();
  grabber_->stop();
}

void QueuedSource::run() {
  if (pending_ && !queue_.push(*pending_)) return;
  pending_.reset();
  while (!stopping_) {
    auto delivery = grabber_->grab(kGrabSlice_s);
    if (!delivery) return queue_.close(std::move(delivery).error());
    if (delivery->kind == Delivery::Kind::kEnd) return queue_.close(std::nullopt);
    if (delivery->kind == Delivery::Kind::kNothing) continue;
    if (auto good = admit(*delivery); !good) return queue_.close(std::move(good).error());
    if (!queue_.push(*delivery)) {
      if (!info().live) pending_ = std::move(*delivery);
      return;
    }
  }
}

std::string QueuedSource::fault_of(const Frame& frame) const {
  const SensorInfo& sensor = info().header.sensors[frame.info.sensor];
  const CameraIntrinsics& camera = sensor.intrinsics;
  if (sensor.kind == SensorKind::kDepthCamera &&
      (frame.depth.width != camera.width || frame.depth.height != camera.height))
    return fmt::format("it sends images of {} x {} pixels, not {} x {}", frame.depth.width,
                       frame.depth.height, camera.width, camera.height);
  if (frame.info.time_s < last_time_s_[frame.info.sensor])
    return fmt::format("its time runs back from {:.3f} s to {:.3f} s",
                       last_time_s_[frame.info.sensor], frame.info.time_s);
  return {};
}

Result<> QueuedSource::admit(Delivery& delivery) {
  Frame& frame = delivery.frame;
  frame.info.index = next_index_++;
  if (frame.info.status == FrameStatus::kDropped) {
    ++dropped_by_sensor_;
    return {};
  }
  const std::string fault = fault_of(frame);
  if (fault.empty()) {
    refused_in_a_row_ = 0;
    last_time_s_[frame.info.sensor] = frame.info.time_s;
    return {};
  }
  ++refused_;
  if (++refused_in_a_row_ >= kMaxRefused)
    return fail(ErrorCode::kFormat, "{}: {}, {} times in a row; start the sensor anew",
                info().driver, fault, kMaxRefused);
  Frame lost;
  lost.info = frame.info;
  lost.info.status = FrameStatus::kDropped;
  frame = std::move(lost);
  return {};
}

Result<Delivery> QueuedSource::next(double timeout_s, const RunContext& context) {
  if (failed_) return tl::unexpected<Error>(*failed_);
  const double end = steady_seconds() + std::max(timeout_s, 0.0);
  for (;;) {
    TURNSCAN_TRY(context.check());
    const double left = end - steady_seconds();
    auto delivery = queue_.pop(std::clamp(left, 0.0, kGrabSlice_s));
    if (!delivery) {
      failed_ = delivery.error();
      return delivery;
    }
    if (delivery->kind == Delivery::Kind::kNothing && left > 0.0) continue;
    if (delivery->kind == Delivery::Kind::kFrame && delivery->frame.info.status == FrameStatus::kOk)
      ++delivered_;
    return delivery;
  }
}

Result<> QueuedSource::lay_object(const Eigen::Matrix3d& rotation, double time_s) {
  stop();
  TURNSCAN_TRY(grabber_->lay_object(rotation, time_s));
  pending_.reset();
  for (;;) {
    TURNSCAN_ASSIGN(const Delivery old, queue_.pop(0.0));
    if (old.kind != Delivery::Kind::kFrame) return {};
  }
}

SourceStatistics QueuedSource::statistics() const {
  SourceStatistics out;
  out.delivered = delivered_;
  out.dropped_by_sensor = dropped_by_sensor_;
  out.dropped_by_queue = queue_.dropped();
  out.refused = refused_;
  out.most_waiting = queue_.most_waiting();
  return out;
}

}  // namespace turnscan::source
