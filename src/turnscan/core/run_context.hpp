#pragma once
// Progress and cancellation of a long call, as one cheap handle that is passed by const reference.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <turnscan/core/result.hpp>

namespace turnscan {

/// What a run is doing. fraction is within the phase, in [0, 1]; it never goes back in one phase.
struct Progress {
  std::string phase;     ///< e.g. "read frames"; empty before the first phase
  int phase_number = 0;  ///< counts from 1 with each phase begun
  double fraction = 0.0;
};

/// Copies share one state. All members may be called from any thread. A default-constructed
/// context works and reports to nobody; results never depend on it.
class RunContext {
 public:
  using Listener = std::function<void(const Progress&)>;

  RunContext();

  /// Called at the start of each phase and at most about 20 times a second within it, from
  /// whichever thread works, never from two at once. It may call cancel() and cancelled(), and
  /// nothing else of the context; it must not own a copy of it, which would then never be released.
  void set_listener(Listener listener);

  void cancel() const noexcept;
  bool cancelled() const noexcept;

  /// Succeeds, or fails with ErrorCode::kCancelled.
  Result<> check() const;

  /// A context for work in the background, whose phases are not shown: it is cancelled when this
  /// one is, and by itself.
  RunContext quiet() const;

  /// Starts a phase of total_steps steps (0: unknown).
  void begin_phase(std::string name, std::uint64_t total_steps) const;
  void advance(std::uint64_t steps = 1) const;

  Progress progress() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace turnscan
