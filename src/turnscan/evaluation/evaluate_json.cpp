#include <nlohmann/json.hpp>
#include <turnscan/evaluation/evaluate.hpp>

namespace turnscan {
namespace {

using Json = nlohmann::ordered_json;

Json statistics_json(const ErrorStatistics& s) {
  return {{"samples", s.count}, {"mean_m", s.mean}, {"median_m", s.median},
          {"p95_m", s.p95},     {"max_m", s.max},   {"rms_m", s.rms}};
}

Json deviation_json(const DeviationStatistics& d) {
  return {{"samples", d.count}, {"mean_m", d.mean}, {"sigma_m", d.sigma}, {"p2_5_m", d.low},
          {"p97_5_m", d.high},  {"min_m", d.min},   {"max_m", d.max}};
}

Json tolerance_json(const std::optional<ToleranceShares>& t) {
  if (!t) return nullptr;
  return {{"tolerance_m", t->tolerance_m}, {"in", t->in}, {"above", t->above}, {"below", t->below}};
}

Json alignment_json(const Evaluation& e) {
  if (!e.aligned) return nullptr;
  Json rows = Json::array();
  for (int r = 0; r < 4; ++r) {
    Json row = Json::array();
    for (int c = 0; c < 4; ++c) row.push_back(e.T_reference_mesh.matrix()(r, c));
    rows.push_back(std::move(row));
  }
  return {{"T_reference_mesh", std::move(rows)}, {"rms_m", e.alignment_rms_m}};
}

}  // namespace

std::string to_json(const Evaluation& e) {
  Json scores = Json::array();
  for (const ThresholdScore& s : e.scores) {
    scores.push_back({{"threshold_m", s.threshold_m},
                      {"precision", s.precision},
                      {"recall", s.recall},
                      {"f", s.f}});
  }
  Json invented = {{"area_m2", e.invented_area_m2}};
  invented.update(statistics_json(e.invented));
  const Json json = {{"accuracy", statistics_json(e.accuracy)},
                     {"completeness", statistics_json(e.completeness)},
                     {"bias_m", e.bias_m},
                     {"deviation", deviation_json(e.deviation)},
                     {"tolerance", tolerance_json(e.tolerance)},
                     {"scores", std::move(scores)},
                     {"invented", std::move(invented)},
                     {"mesh_area_m2", e.mesh_area_m2},
                     {"reference_area_m2", e.reference_area_m2},
                     {"seen_area_m2", e.seen_area_m2},
                     {"alignment", alignment_json(e)}};
  return json.dump(2) + "\n";
}

}  // namespace turnscan
