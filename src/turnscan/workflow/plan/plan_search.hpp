#pragma once
// The choice among the candidates of a plan, by what rays and the error model predict.

#include <turnscan/simulator/planning/choice.hpp>
#include <turnscan/simulator/planning/error_model.hpp>
#include <turnscan/workflow/plan/plan_candidates.hpp>

namespace turnscan::workflow {

/// What is preferred among rigs that cover the same.
enum class Prefer { kCovered, kError };

/// Sensors in their places, and for each object the poses of all its passes (PlanObject::poses; the
/// first is 0).
struct Rig {
  std::vector<PlanPlace> places;
  std::vector<std::vector<std::uint32_t>> poses;
};

struct RigScore {
  double covered = 0.0, median_error_m = 0.0;
  double value = 0.0;  ///< what is made as large as can be; about the share that is covered
};

struct ChosenRig {
  Rig rig;
  RigScore score;
  double most_covered = 0.0;  ///< bound of the score's covered, of all candidates
  bool error_first = false;
  std::size_t passes = 1;
};

/// Worth of a spot that is seen with this error, with this chance, of kFullWorth: near that
/// whatever the error, unless the error is preferred. Falls with the error. 0 beyond the greatest
/// error.
std::uint16_t worth_of(double error_m, const std::optional<double>& max_error_m, Prefer prefer,
                       double chance = 1.0);
inline constexpr double kFullWorth = 60000.0;

class PlanSearch {
 public:
  PlanSearch(const PlanRequest& request, const PlanField& field)
      : request_(request), field_(field) {}

  /// Looks at all candidates: begins the phase "candidates".
  Result<> look(const RunContext& context);
  /// The best rig of each number of sensors and passes, both preferences; best first, none that
  /// another beats in every respect. Begins the phase "choose".
  Result<std::vector<ChosenRig>> choose_all(const RunContext& context);
  /// A rig with its places moved, between the candidates, to where the prediction is best.
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
  /// Of a spot from a place; chance as SpotSight::chance(), 0: not seen.
  struct Look {
    float error_m = 0.0f, chance = 0.0f;
  };
  std::vector<std::vector<std::vector<Look>>> looks_;  ///< [object][pose], places x spots
  std::uint64_t turns_ = 0, sets_ = 0;
};

/// Those that none beats, of such as are alike the first; most covered first.
std::vector<ChosenRig> unbeaten(const std::vector<ChosenRig>& rigs);

/// Whether a is at least as good as b in covered area, error, sensors and passes, and better in
/// one.
bool beats(const ChosenRig& a, const ChosenRig& b);

}  // namespace turnscan::workflow
