#pragma once
// Frames on their way from the thread that grabs them to the one that uses them.

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <turnscan/capture/source/frame_source.hpp>

namespace turnscan::source {

/// Holds at most `capacity` frames with images. All members may be called from any thread.
class FrameQueue {
 public:
  /// drop_oldest: a full queue drops its oldest image and keeps its info; else push() waits.
  FrameQueue(std::size_t capacity, bool drop_oldest);

  /// Moves the frame into the queue. False when the queue is closed, or was while it waited; the
  /// frame stays where it was then.
  bool push(Delivery& delivery);
  /// Nothing more comes in: because of an error, or of the end.
  void close(std::optional<Error> error);
  void reopen();

  /// The oldest; kNothing after timeout_s; once closed and empty, the error or kEnd.
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
  std::size_t images_ = 0;  ///< of waiting_, those with a status of kOk
  std::size_t most_waiting_ = 0;
  std::uint64_t dropped_ = 0;
  bool closed_ = false;
  std::optional<Error> error_;
};

}  // namespace turnscan::source
