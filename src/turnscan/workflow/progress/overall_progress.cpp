#include <algorithm>
#include <turnscan/workflow/progress/overall_progress.hpp>

namespace turnscan {

namespace {

constexpr double kBeforeTheEnd = 0.995;  // maximum that is shown while the run is in progress
// Share of the plan's weight for a phase that is not in it.
constexpr double kUnplannedShare = 0.02;
constexpr double kMinKnown = 0.05;     // share of a phase or the whole that must be done before its
                                       // pace is used for an estimate
constexpr double kLongestGuess = 0.9;  // maximum for a phase that does not report its fraction
// Time constant with which the displayed time follows a shorter estimate.
constexpr double kCatchUp_s = 3.0;
constexpr double kFarOff = 1.5, kFarOff_s = 5.0;

double total(const PhasePlan& plan, std::size_t begin) {
  double sum = 0.0;
  for (std::size_t i = begin; i < plan.size(); ++i) sum += plan[i].weight;
  return sum;
}

}  // namespace

PhasePlan joined(std::vector<PhasePlan> plans) {
  PhasePlan all;
  for (PhasePlan& plan : plans)
    all.insert(all.end(), std::make_move_iterator(plan.begin()),
               std::make_move_iterator(plan.end()));
  return all;
}

void OverallProgress::plan(PhasePlan plan) {
  plan_ = std::move(plan);
  next_ = 0;
}

double OverallProgress::later_weight() const { return total(plan_, next_); }

double OverallProgress::weight_of(const std::string& name) {
  const auto is_it = [&](const PlannedPhase& phase) { return phase.name == name; };
  const auto rest = plan_.begin() + std::ptrdiff_t(next_);
  // A repetition of the current phase is another part of it, unless the plan has it twice in a row.
  const bool again = name == name_ && !(rest != plan_.end() && is_it(*rest));
  const auto ahead = again ? plan_.end() : std::find_if(rest, plan_.end(), is_it);
  if (ahead != plan_.end()) {
    next_ = std::size_t(ahead - plan_.begin()) + 1;
    return ahead->weight;
  }
  const auto before = std::find_if(plan_.begin(), rest, is_it);
  return before != rest ? before->weight : kUnplannedShare * total(plan_, 0);
}

void OverallProgress::begin_phase(const Progress& progress, double now_s) {
  if (weight_ > 0.0) {
    done_weight_ += weight_;
    done_seconds_ += now_s - begin_s_;
  }
  weight_ = weight_of(progress.phase);
  name_ = progress.phase;
  number_ = progress.phase_number;
  begin_s_ = now_s;
  const double rest = weight_ + later_weight();
  slot_begin_ = fraction_;
  slot_end_ = rest > 0.0 ? fraction_ + (1.0 - fraction_) * weight_ / rest : fraction_;
}

std::optional<double> OverallProgress::phase_seconds_left(double fraction, double elapsed_s) const {
  if (fraction >= kMinKnown) return elapsed_s * (1.0 - fraction) / fraction;
  if (done_weight_ < kMinKnown * (done_weight_ + weight_ + later_weight())) return std::nullopt;
  return std::max(0.0, weight_ * done_seconds_ / done_weight_ - elapsed_s);
}

void OverallProgress::update(const Progress& progress, double now_s) {
  if (progress.phase_number != number_) begin_phase(progress, now_s);
  if (!(weight_ > 0.0)) return;
  const double elapsed = now_s - begin_s_;
  const auto left = phase_seconds_left(progress.fraction, elapsed);
  double part = progress.fraction;
  if (part <= 0.0 && left && elapsed > 0.0)
    part = std::min(kLongestGuess, elapsed / (elapsed + *left));
  const double whole = slot_begin_ + (slot_end_ - slot_begin_) * part;
  fraction_ = std::min(std::max(fraction_, whole), kBeforeTheEnd);
  const double work = done_weight_ + weight_ * part, later = later_weight();
  if (left && work >= kMinKnown * (done_weight_ + weight_ + later))
    count_down(*left + later * (done_seconds_ + elapsed + *left) / (done_weight_ + weight_), now_s);
}

void OverallProgress::count_down(double estimate_s, double now_s) {
  if (!left_s_) {
    left_s_ = estimate_s;
  } else {
    const double passed = now_s - left_at_s_, counted = std::max(0.0, *left_s_ - passed);
    if (estimate_s > kFarOff * counted + kFarOff_s)
      left_s_ = estimate_s;
    else if (estimate_s >= counted)
      left_s_ = std::min(*left_s_, estimate_s);
    else
      left_s_ = counted - (counted - estimate_s) * std::min(1.0, passed / kCatchUp_s);
  }
  left_at_s_ = now_s;
}

std::optional<double> OverallProgress::fraction() const {
  if (number_ > 0 && !(weight_ > 0.0)) return std::nullopt;
  return plan_.empty() ? std::nullopt : std::optional(fraction_);
}

std::optional<double> OverallProgress::seconds_left() const {
  return fraction() ? left_s_ : std::nullopt;
}

}  // namespace turnscan
