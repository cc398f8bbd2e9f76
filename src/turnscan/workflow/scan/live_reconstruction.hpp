#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <turnscan/reconstruction/stream.hpp>

namespace turnscan::workflow {

/// Adds frames to a reconstruction on a separate thread, so that the sensor is not delayed.
class LiveReconstruction {
 public:
  LiveReconstruction(ReconstructionStream stream, const RunContext& context);
  ~LiveReconstruction() {
    quiet_.cancel();
    close();
  }
  LiveReconstruction(const LiveReconstruction&) = delete;
  LiveReconstruction& operator=(const LiveReconstruction&) = delete;

  /// May be called from any thread, before finish().
  void add(const Frame& frame);

  /// Waits for all added frames. Fails as ReconstructionStream::add() did and finish() does.
  Result<Reconstruction> finish(const RunContext& context);

 private:
  void close();
  void run();

  RunContext quiet_;
  ReconstructionStream stream_;
  Result<> added_;  ///< set by the thread; valid once it has ended
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Frame> waiting_;
  bool closing_ = false;
  std::thread thread_;
};

}  // namespace turnscan::workflow
