#pragma once
// How far a whole command is. A RunContext counts each phase by itself; a plan says which phases a
// command will come to, and what they usually cost beside each other.

#include <optional>
#include <string>
#include <turnscan/core/run_context.hpp>
#include <vector>

namespace turnscan {

struct PlannedPhase {
  std::string name;     ///< as RunContext::begin_phase() gets it
  double weight = 1.0;  ///< share of the time beside the other phases; 0: a wait that may take long
};

/// In the order in which the phases come. A name may be there several times.
using PhasePlan = std::vector<PlannedPhase>;

/// The plans one after the other.
PhasePlan joined(std::vector<PhasePlan> plans);

/// The fraction of the whole that is done, and the time left. A planned phase that does not come
/// leaves its share to those behind it; one that was not planned or comes again takes a share of
/// what is left. Not for several threads at once. Times are seconds of any one clock.
class OverallProgress {
 public:
  /// What is still to come. May be called again when more is known; the fraction goes on from where
  /// it is.
  void plan(PhasePlan plan);

  /// To be called with whatever the context reports, and now and then in between.
  void update(const Progress& progress, double now_s);

  /// In [0, 1), never falls: that the run has ended, its caller knows. nullopt in a wait, and
  /// without a plan.
  std::optional<double> fraction() const;

  /// Counts down; grows only if the estimate is far above it. nullopt while too little is known.
  std::optional<double> seconds_left() const;

 private:
  void begin_phase(const Progress& progress, double now_s);
  double weight_of(const std::string& name);
  double later_weight() const;
  std::optional<double> phase_seconds_left(double fraction, double elapsed_s) const;
  void count_down(double estimate_s, double now_s);

  PhasePlan plan_;
  std::size_t next_ = 0;  // of the plan
  std::string name_;
  int number_ = 0;
  double weight_ = 0.0, begin_s_ = 0.0;            // of this phase
  double slot_begin_ = 0.0, slot_end_ = 0.0;       // of this phase in the whole
  double done_weight_ = 0.0, done_seconds_ = 0.0;  // of the phases before it
  double fraction_ = 0.0;
  std::optional<double> left_s_;
  double left_at_s_ = 0.0;
};

}  // namespace turnscan
