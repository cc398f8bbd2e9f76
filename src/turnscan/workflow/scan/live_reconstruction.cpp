#include <turnscan/workflow/scan/live_reconstruction.hpp>

namespace turnscan::workflow {

namespace {

constexpr std::size_t kFramesAtOnce = 16;

}  // namespace

LiveReconstruction::LiveReconstruction(ReconstructionStream stream, const RunContext& context)
    : quiet_(context.quiet()), stream_(std::move(stream)), thread_([this] { run(); }) {}

void LiveReconstruction::add(const Frame& frame) {
  const std::lock_guard lock(mutex_);
  waiting_.push_back(frame);
  wake_.notify_one();
}

Result<Reconstruction> LiveReconstruction::finish(const RunContext& context) {
  close();
  TURNSCAN_TRY(added_);
  return stream_.finish({}, context);
}

void LiveReconstruction::close() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  wake_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void LiveReconstruction::run() {
  for (;;) {
    std::vector<Frame> batch;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return closing_ || !waiting_.empty(); });
      if (waiting_.empty()) return;
      while (!waiting_.empty() && batch.size() < kFramesAtOnce) {
        batch.push_back(std::move(waiting_.front()));
        waiting_.pop_front();
      }
    }
    if (added_) added_ = stream_.add(batch, quiet_);
  }
}

}  // namespace turnscan::workflow
