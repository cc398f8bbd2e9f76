#pragma once
// Searches the candidates of a plan, using rays and the error model for prediction.

#include <turnscan/simulator/planning/choice.hpp>
#include <turnscan/simulator/planning/error_model.hpp>
#include <turnscan/workflow/plan/plan_candidates.hpp>

namespace turnscan::workflow {

/// Preference among rigs with the same coverage.
enum class Prefer { kCovered, kError };

/// Placed sensors, and for each object its poses in all passes (indices into PlanObject::poses; the
/// first is 0).
struct Rig {
  std::vector<PlanPlace> places;
  std::vector<std::vector<std::uint32_t>> poses;
};

struct RigScore {
  double covered = 0.0, median_error_m = 0.0;
  double value = 0.0;  ///< objective to maximise; approximately the covered share
};

struct ChosenRig {
  Rig rig;
  RigScore score;
  double most_covered = 0.0;  ///< upper bound of the score's covered, over all candidates
  bool error_first = false;
  std::size_t passes = 1;
};

/// Value of a spot that is seen with this error and with this probability, at most kFullWorth:
/// close to that for any error unless the error is preferred. Decreases with the error. 0 beyond
/// max_error_m.
std::uint16_t worth_of(double error_m, const std::optional<double>& max_error_m, Prefer prefer,
                       double chance = 1.0);
inline constexpr double kFullWorth = 60000.0;

class PlanSearch {
 public:
  PlanSearch(const PlanRequest& request, const PlanField& field)
      : request_(request), field_(field) {}

  /// Evaluates all candidates; begins the phase "candidates".
  Result<> look(const RunContext& context);
  /// The best rigs for each number of sensors and passes, for both preferences; best first, without
  /// dominated ones. Begins the phase "choose".
  Result<std::vector<ChosenRig>> choose_all(const RunContext& context);
  /// The rig with its placements optimised continuously, between the candidates.
  Result<ChosenRig> refined(ChosenRig chosen, const RunContext& context);
  RigScore score(const Rig& rig, Prefer prefer);

  std::uint64_t turns() const { return turns_; }
  std::uint64_t sets() const { return sets_; }

 private:
  Result<ChosenRig> choose_one(std::size_t sensors, std::size_t passes, Prefer prefer,
                               const RunContext& context);
  std::vector<planning::ChoiceGroup> groups(
      std::size_t passes, Prefer prefer,
      std::vector<std::vector<std::vector<std::uint32_t>>>& poses) const;
  std::size_t most_passes() const;

  const PlanRequest& request_;
  const PlanField& field_;
  planning::ErrorModel model_;
  /// Observation of a spot from a placement; chance as in SpotSight::chance(), 0: not seen.
  struct Look {
    float error_m = 0.0f, chance = 0.0f;
  };
  std::vector<std::vector<std::vector<Look>>> looks_;  ///< [object][pose], placements x spots
  std::uint64_t turns_ = 0, sets_ = 0;
};

/// The non-dominated rigs, the first of equal ones; most covered first.
std::vector<ChosenRig> unbeaten(const std::vector<ChosenRig>& rigs);

/// Whether a dominates b: at least as good in covered area, error, sensors and passes, and better
/// in one.
bool beats(const ChosenRig& a, const ChosenRig& b);

}  // namespace turnscan::workflow
