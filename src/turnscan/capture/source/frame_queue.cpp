#include <algorithm>
#include <chrono>
#include <turnscan/capture/source/frame_queue.hpp>

namespace turnscan::source {

namespace {

bool has_image(const Delivery& delivery) { return delivery.frame.info.status == FrameStatus::kOk; }

}  // namespace

FrameQueue::FrameQueue(std::size_t capacity, bool drop_oldest)
    : capacity_(std::max<std::size_t>(capacity, 1)), drop_oldest_(drop_oldest) {}

void FrameQueue::drop_one() {
  const auto oldest = std::find_if(waiting_.begin(), waiting_.end(), has_image);
  Frame lost;
  lost.info = oldest->frame.info;
  lost.info.status = FrameStatus::kDropped;
  oldest->frame = std::move(lost);
  --images_;
  ++dropped_;
}

bool FrameQueue::push(Delivery& delivery) {
  std::unique_lock lock(mutex_);
  const bool image = has_image(delivery);
  if (image && !drop_oldest_) changed_.wait(lock, [&] { return closed_ || images_ < capacity_; });
  if (closed_) return false;
  if (image && images_ == capacity_) drop_one();
  waiting_.push_back(std::move(delivery));
  if (image) ++images_;
  most_waiting_ = std::max(most_waiting_, images_);
  lock.unlock();
  changed_.notify_all();
  return true;
}

void FrameQueue::close(std::optional<Error> error) {
  {
    const std::lock_guard lock(mutex_);
    if (closed_) return;
    closed_ = true;
    error_ = std::move(error);
  }
  changed_.notify_all();
}

void FrameQueue::reopen() {
  const std::lock_guard lock(mutex_);
  closed_ = false;
  error_.reset();
}

Result<Delivery> FrameQueue::pop(double timeout_s) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, std::chrono::duration<double>(timeout_s),
                    [&] { return closed_ || !waiting_.empty(); });
  Delivery out;
  if (waiting_.empty()) {
    if (closed_ && error_) return tl::unexpected<Error>(*error_);
    out.kind = closed_ ? Delivery::Kind::kEnd : Delivery::Kind::kNothing;
    return out;
  }
  out = std::move(waiting_.front());
  waiting_.pop_front();
  if (has_image(out)) --images_;
  lock.unlock();
  changed_.notify_all();
  return out;
}

std::uint64_t FrameQueue::dropped() const {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

std::size_t FrameQueue::most_waiting() const {
  const std::lock_guard lock(mutex_);
  return most_waiting_;
}

}  // namespace turnscan::source
