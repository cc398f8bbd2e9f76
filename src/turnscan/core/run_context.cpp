#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <turnscan/core/run_context.hpp>

namespace turnscan {

namespace {
using Clock = std::chrono::steady_clock;
constexpr auto kListenerInterval = std::chrono::milliseconds(50);
}  // namespace

struct RunContext::State {
  std::atomic<bool> cancelled{false};
  std::shared_ptr<const State> parent;  ///< of a quiet context
  std::atomic<std::uint64_t> done{0};
  std::atomic<std::uint64_t> total{0};
  std::atomic<Clock::rep> next_report{0};
  std::mutex mutex;  // guards the following members
  std::string phase;
  int phase_number = 0;
  Listener listener;

  Progress snapshot() const {
    const std::uint64_t t = total.load(), d = done.load();
    return {phase, phase_number, t == 0 ? 0.0 : std::min(1.0, double(d) / double(t))};
  }
};

RunContext::RunContext() : state_(std::make_shared<State>()) {}

void RunContext::set_listener(Listener listener) {
  std::lock_guard lock(state_->mutex);
  state_->listener = std::move(listener);
}

void RunContext::cancel() const noexcept { state_->cancelled.store(true); }
bool RunContext::cancelled() const noexcept {
  for (const State* state = state_.get(); state != nullptr; state = state->parent.get())
    if (state->cancelled.load(std::memory_order_relaxed)) return true;
  return false;
}

RunContext RunContext::quiet() const {
  RunContext out;
  out.state_->parent = state_;
  return out;
}

Result<> RunContext::check() const {
  if (cancelled()) return fail(ErrorCode::kCancelled, "cancelled");
  return {};
}

void RunContext::begin_phase(std::string name, std::uint64_t total_steps) const {
  std::lock_guard lock(state_->mutex);
  state_->phase = std::move(name);
  ++state_->phase_number;
  state_->done = 0;
  state_->total = total_steps;
  state_->next_report = (Clock::now() + kListenerInterval).time_since_epoch().count();
  if (state_->listener) state_->listener(state_->snapshot());
}

void RunContext::advance(std::uint64_t steps) const {
  state_->done += steps;
  const auto now = Clock::now();
  auto due = state_->next_report.load(std::memory_order_relaxed);
  if (now.time_since_epoch().count() < due) return;
  const auto next = (now + kListenerInterval).time_since_epoch().count();
  if (!state_->next_report.compare_exchange_strong(due, next)) return;
  std::lock_guard lock(state_->mutex);
  if (state_->listener) state_->listener(state_->snapshot());
}

Progress RunContext::progress() const {
  std::lock_guard lock(state_->mutex);
  return state_->snapshot();
}

}  // namespace turnscan
