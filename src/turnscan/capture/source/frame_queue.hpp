#pragma once
// Queue of frames between the grabbing thread and the consumer.

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <turnscan/capture/source/frame_source.hpp>

namespace turnscan::source {

/// Holds at most `capacity` frames with images. All members are thread-safe.
class FrameQueue {
 public:
  /// drop_oldest: a full queue drops its oldest image but keeps the info; else push() waits.
  FrameQueue(std::size_t capacity, bool drop_oldest);

  /// Moves the frame into the queue. False if the queue is closed, or was closed during the wait;
  /// the frame is not moved then.
  bool push(Delivery& delivery);
  /// Ends the input: because of an error, or at the end of the source.
  void close(std::optional<Error> error);
  void reopen();

  /// The oldest frame; kNothing after timeout_s; once closed and empty, the error or kEnd.
  Result<Delivery> pop(double timeout_s);

  std::uint64_t dropped() const;
  std::size_t most_waiting() const;

 private:
  void drop_one();

  const std::size_t capacity_;
  const bool drop_oldest_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Delivery> waiting_;
  std::size_t images_ = 0;  ///< number of entries in waiting_ with status kOk
  std::size_t most_waiting_ = 0;
  std::uint64_t dropped_ = 0;
  bool closed_ = false;
  std::optional<Error> error_;
};

}  // namespace turnscan::source
