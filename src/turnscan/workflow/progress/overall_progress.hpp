#pragma once
// Progress of a whole command. A RunContext reports each phase by itself; a plan lists the phases
// of a command and their usual relative costs.

#include <optional>
#include <string>
#include <turnscan/core/run_context.hpp>
#include <vector>

namespace turnscan {

struct PlannedPhase {
  std::string name;     ///< as passed to RunContext::begin_phase()
  double weight = 1.0;  ///< relative share of the time; 0: a wait of unknown duration
};

/// In the order of the phases. A name may occur several times.
using PhasePlan = std::vector<PlannedPhase>;

/// Concatenates plans.
PhasePlan joined(std::vector<PhasePlan> plans);

/// Fraction of the whole that is done, and remaining time. A planned phase that is skipped leaves
/// its share to the later phases; one that was not planned or is repeated takes a share of the
/// remainder. Not thread-safe. Times are seconds of any single clock.
class OverallProgress {
 public:
  /// Sets the phases still to come. May be called again when more is known; the fraction continues
  /// from its current value.
  void plan(PhasePlan plan);

  /// Call with every report of the context, and now and then in between.
  void update(const Progress& progress, double now_s);

  /// In [0, 1), never decreases; only the caller knows when the run has ended. nullopt during a
  /// wait, and without a plan.
  std::optional<double> fraction() const;

  /// Counts down; increases only if the estimate is far above it. nullopt while too little is
  /// known.
  std::optional<double> seconds_left() const;

 private:
  void begin_phase(const Progress& progress, double now_s);
  double weight_of(const std::string& name);
  double later_weight() const;
  std::optional<double> phase_seconds_left(double fraction, double elapsed_s) const;
  void count_down(double estimate_s, double now_s);

  PhasePlan plan_;
  std::size_t next_ = 0;  // index into the plan
  std::string name_;
  int number_ = 0;
  double weight_ = 0.0, begin_s_ = 0.0;            // of this phase
  double slot_begin_ = 0.0, slot_end_ = 0.0;       // interval of this phase within the whole
  double done_weight_ = 0.0, done_seconds_ = 0.0;  // totals of the phases before it
  double fraction_ = 0.0;
  std::optional<double> left_s_;
  double left_at_s_ = 0.0;
};

}  // namespace turnscan
