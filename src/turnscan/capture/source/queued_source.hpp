#pragma once
// Makes a FrameSource of a Grabber: runs its thread and queue, and enforces the invariants of
// frames.

#include <atomic>
#include <thread>
#include <turnscan/capture/source/frame_queue.hpp>
#include <turnscan/capture/source/grabber.hpp>

namespace turnscan::source {

class QueuedSource : public FrameSource {
 public:
  QueuedSource(std::unique_ptr<Grabber> grabber, std::size_t capacity);
  ~QueuedSource() override;
  QueuedSource(const QueuedSource&) = delete;
  QueuedSource& operator=(const QueuedSource&) = delete;

  const SourceInfo& info() const override { return grabber_->info(); }
  Result<> start() override;
  Result<Delivery> next(double timeout_s, const RunContext& context) override;
  void stop() override;
  SourceStatistics statistics() const override;
  Result<> lay_object(const Eigen::Matrix3d& rotation, double time_s) override;

 private:
  void run();
  Result<> admit(Delivery& delivery);
  std::string fault_of(const Frame& frame) const;

  std::unique_ptr<Grabber> grabber_;
  FrameQueue queue_;
  std::thread thread_;
  std::atomic<bool> stopping_ = false;
  std::optional<Error> failed_;
  // Used by the grabbing thread only.
  std::optional<Delivery> pending_;  ///< admitted, but not queued before stop() was called
  std::uint32_t next_index_ = 0;
  int refused_in_a_row_ = 0;
  std::vector<double> last_time_s_;
  // Counters.
  std::atomic<std::uint64_t> delivered_ = 0, dropped_by_sensor_ = 0, refused_ = 0;
};

}  // namespace turnscan::source
