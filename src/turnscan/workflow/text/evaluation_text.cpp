#include <turnscan/workflow/text/evaluation_text.hpp>

#include <turnscan/workflow/text/text_table.hpp>

namespace turnscan {

namespace {

void add_errors(workflow::TextTable& table, const std::string& name, const ErrorStatistics& e) {
  const auto mm = [](double value_m) { return fmt::format("{:.3f}", value_m * 1e3); };
  table.add({name, mm(e.mean), mm(e.median), mm(e.p95), mm(e.max)});
}

}  // namespace

std::string evaluation_text(const Evaluation& e) {
  workflow::TextTable errors({0});
  errors.add({"error in mm", "mean", "median", "p95", "max"});
  add_errors(errors, "accuracy (mesh to reference)", e.accuracy);
  add_errors(errors, "completeness (reference to mesh)", e.completeness);
  if (e.invented.count > 0) add_errors(errors, "where nothing was seen", e.invented);
  workflow::TextTable scores({});
  scores.add({"within", "precision", "recall", "F"});
  for (const ThresholdScore& s : e.scores)
    scores.add({format_quantity(s.threshold_m, Quantity::kLength),
                fmt::format("{:.2f} %", 100.0 * s.precision),
                fmt::format("{:.2f} %", 100.0 * s.recall), fmt::format("{:.4f}", s.f)});
  std::string text = errors.text() + scores.text();
  text += fmt::format("Bias {:+.3f} mm (positive: the mesh lies outside)\n", e.bias_m * 1e3);
  text += fmt::format("Area: mesh {:.2f} cm2, of these {:.2f} where nothing was seen; ",
                      e.mesh_area_m2 * 1e4, e.invented_area_m2 * 1e4);
  text += fmt::format("reference {:.2f} cm2, of these {:.2f} seen\n", e.reference_area_m2 * 1e4,
                      e.seen_area_m2 * 1e4);
  if (e.aligned)
    text += fmt::format("The mesh was moved onto the reference first (rms {:.3f} mm)\n",
                        e.alignment_rms_m * 1e3);
  return text;
}

}  // namespace turnscan
