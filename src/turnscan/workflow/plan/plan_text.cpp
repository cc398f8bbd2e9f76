#include <cmath>
#include <nlohmann/json.hpp>
#include <turnscan/core/units.hpp>
#include <turnscan/workflow/plan/plan.hpp>
#include <turnscan/workflow/text/text_table.hpp>

namespace turnscan {

namespace {

std::string percent(double share) { return fmt::format("{:.1f} %", 100.0 * share); }
std::string millimetres(double metres) {
  return std::isfinite(metres) ? fmt::format("{:.2f} mm", 1e3 * metres) : std::string("-");
}

std::string sensor_words(const ScannerEntry& entry) {
  std::string out = entry.model;
  for (const auto& [name, value] : entry.options) out += fmt::format(", {} {}", name, value);
  return out;
}

std::string pass_words(const PassEntry& pass) {
  std::string out;
  for (const auto& [name, value] : pass)
    out += fmt::format("{}{} {}", out.empty() ? "" : ", ", name, value);
  return out;
}

nlohmann::json entries_json(const std::vector<std::pair<std::string, std::string>>& entries) {
  nlohmann::json out = nlohmann::json::object();
  for (const auto& [name, value] : entries) out[name] = value;
  return out;
}

nlohmann::json number_json(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}

nlohmann::json plan_part_json(const Plan& plan) {
  nlohmann::json sensors = nlohmann::json::array(), passes = nlohmann::json::array();
  for (const ScannerEntry& entry : plan.sensors) {
    nlohmann::json sensor = entries_json(entry.options);
    sensor["model"] = entry.model;
    sensors.push_back(std::move(sensor));
  }
  for (const auto& object : plan.next_passes) {
    nlohmann::json list = nlohmann::json::array();
    for (const PassEntry& pass : object) list.push_back(entries_json(pass));
    passes.push_back(std::move(list));
  }
  nlohmann::json out = {{"sensors", sensors},
                        {"next_passes", passes},
                        {"passes", plan.passes()},
                        {"covered", plan.covered},
                        {"most_covered", plan.most_covered},
                        {"median_error_m", number_json(plan.median_error_m)},
                        {"time_s", plan.time_s},
                        {"preferred", plan.error_first ? "error" : "covered"},
                        {"unseen", plan.unseen},
                        {"scenes", plan.scenes},
                        {"pictures", plan.pictures}};
  if (plan.trial) {
    out["simulated"] = {{"covered", plan.trial->covered},
                        {"median_error_m", number_json(plan.trial->median_error_m)}};
    if (!plan.trial->failure.empty()) out["simulated"]["failure"] = plan.trial->failure;
  }
  return out;
}

}  // namespace

std::string plan_json(const PlanRequest& request, const PlanOutcome& outcome) {
  nlohmann::json plans = nlohmann::json::array(), options = nlohmann::json::object();
  for (const Plan& plan : outcome.plans) plans.push_back(plan_part_json(plan));
  PlanOptions copy = request.options;
  const OptionTable table = describe(copy);
  for (const OptionField& field : table.fields()) options[field.name] = field.get();
  const nlohmann::json out = {{"objects", request.objects},
                              {"options", options},
                              {"placements", outcome.placements},
                              {"poses", outcome.poses},
                              {"turns_looked_at", outcome.turns_looked_at},
                              {"sets_compared", outcome.sets_compared},
                              {"simulations", outcome.simulations},
                              {"plans", plans}};
  return out.dump(2) + "\n";
}

std::string plan_text(const PlanRequest& request, const PlanOutcome& outcome) {
  workflow::TextTable table({});
  table.add({"plan", "sensors", "passes", "time", "covered", "at most", "error", "simulated",
             "error there"});
  for (std::size_t k = 0; k < outcome.plans.size(); ++k) {
    const Plan& plan = outcome.plans[k];
    table.add({fmt::format("{}", k + 1), fmt::format("{}", plan.sensors.size()),
               fmt::format("{}", plan.passes()), fmt::format("{:.0f} s", plan.time_s),
               percent(plan.covered), percent(plan.most_covered), millimetres(plan.median_error_m),
               plan.trial ? percent(plan.trial->covered) : "-",
               plan.trial ? millimetres(plan.trial->median_error_m) : "-"});
  }
  std::string out = table.text(0);
  for (std::size_t k = 0; k < outcome.plans.size(); ++k) {
    const Plan& plan = outcome.plans[k];
    out += fmt::format("\nPlan {}{}\n", k + 1,
                       plan.error_first ? ", chosen for the smallest error" : "");
    for (const ScannerEntry& sensor : plan.sensors)
      out += fmt::format("  {}\n", sensor_words(sensor));
    for (std::size_t m = 0; m < plan.next_passes.size(); ++m)
      for (std::size_t p = 0; p < plan.next_passes[m].size(); ++p)
        out += fmt::format("  pass {}{}: {}\n", p + 2,
                           plan.next_passes.size() > 1 ? " of " + request.objects[m] : "",
                           pass_words(plan.next_passes[m][p]));
    out += fmt::format("  {}\n", plan.unseen);
    if (plan.trial && !plan.trial->failure.empty())
      out += fmt::format("  The simulated scan gave no mesh: {}\n", plan.trial->failure);
  }
  return out;
}

}  // namespace turnscan
