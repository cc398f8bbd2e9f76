#include <turnscan/workflow/text/evaluation_text.hpp>

#include <turnscan/workflow/text/text_table.hpp>

namespace turnscan {

namespace {

std::string plain_mm(double value_m) { return fmt::format("{:.3f}", value_m * 1e3); }

void add_errors(workflow::TextTable& table, const std::string& name, const ErrorStatistics& e) {
  table.add({name, plain_mm(e.mean), plain_mm(e.median), plain_mm(e.p95), plain_mm(e.max)});
}

/// With a sign.
std::string mm(double value_m) { return fmt::format("{:+.3f}", value_m * 1e3); }

std::string deviation_text(const Evaluation& e) {
  const DeviationStatistics& d = e.deviation;
  workflow::TextTable table({0});
  table.add({"signed, in mm", "mean", "sigma", "2.5 %", "97.5 %", "min", "max"});
  table.add({"deviation (positive: outside)", mm(d.mean), plain_mm(d.sigma), mm(d.low), mm(d.high),
             mm(d.min), mm(d.max)});
  std::string text = table.text();
  if (e.tolerance)
    text += fmt::format("Within +-{}: {:.2f} % of the mesh; above {:.2f} %, below {:.2f} %\n",
                        format_quantity(e.tolerance->tolerance_m, Quantity::kLength),
                        100.0 * e.tolerance->in, 100.0 * e.tolerance->above,
                        100.0 * e.tolerance->below);
  return text;
}

std::string points_text(const std::string& what, const FitFigures& fit) {
  std::string text =
      fmt::format("{}: {} points, {} of them rejected", what, fit.points, fit.rejected);
  if (fit.left_out > 0)
    text += fmt::format("; {} nearby are off its surface and were left out", fit.left_out);
  return text + "\n";
}

std::string ball_name(const ArtefactFigures& figures, std::size_t i) {
  return figures.balls.size() == 1 ? "ball" : fmt::format("ball {}", i + 1);
}

void add_balls(workflow::TextTable& table, const ArtefactFigures& figures) {
  for (std::size_t i = 0; i < figures.balls.size(); ++i) {
    const BallFigures& b = figures.balls[i];
    const std::string name = ball_name(figures, i);
    table.add({name + ": probing error, form (PF)", plain_mm(b.fit.form_m)});
    table.add({name + ": probing error, form, 95 % of the points", plain_mm(b.fit.form95_m)});
    table.add({name + ": probing error, size (PS)", mm(b.size_error_m)});
    table.add({name + ": standard deviation", plain_mm(b.fit.sigma_m)});
  }
}

void add_spacing(workflow::TextTable& table, const SpacingFigures& spacing) {
  table.add({"distance of the centres", plain_mm(spacing.measured_m)});
  if (spacing.error_m) table.add({"sphere spacing error (SD)", mm(*spacing.error_m)});
  if (spacing.error_fixed_diameter_m)
    table.add({"the same with the calibrated diameter", mm(*spacing.error_fixed_diameter_m)});
}

}  // namespace

std::string artefact_text(const ArtefactFigures& figures) {
  workflow::TextTable table({0});
  table.add({"VDI/VDE 2634 part 2", "mm"});
  add_balls(table, figures);
  if (figures.spacing) add_spacing(table, *figures.spacing);
  if (figures.plate) {
    table.add({"flatness error (F)", plain_mm(figures.plate->fit.form_m)});
    table.add({"flatness error, 95 % of the points", plain_mm(figures.plate->fit.form95_m)});
    table.add({"standard deviation", plain_mm(figures.plate->fit.sigma_m)});
  }
  std::string text = table.text();
  for (std::size_t i = 0; i < figures.balls.size(); ++i) {
    const BallFigures& b = figures.balls[i];
    const std::string what =
        fmt::format("{} of {:.3f} mm, {:.0f} % of its surface seen", ball_name(figures, i),
                    b.diameter_m * 1e3, 100.0 * b.covered);
    text += points_text(what, b.fit);
  }
  if (figures.plate)
    text += points_text(fmt::format("plate, {:.0f} x {:.0f} mm of it used",
                                    figures.plate->length_m * 1e3, figures.plate->width_m * 1e3),
                        figures.plate->fit);
  return text;
}

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
  std::string text = errors.text() + deviation_text(e) + scores.text();
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
