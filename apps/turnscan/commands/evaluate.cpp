#include <algorithm>
#include <turnscan/core/figure_text.hpp>
#include <turnscan/evaluation/evaluate.hpp>
#include <turnscan/evaluation/inspection/deviations.hpp>
#include <turnscan/evaluation/inspection/thickness.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/io/text/json_bytes.hpp>
#include <turnscan/recording/recording.hpp>

#include <turnscan/workflow/artefact_input.hpp>
#include <turnscan/workflow/inspection/element_file.hpp>
#include <turnscan/workflow/inspection/element_output.hpp>
#include <turnscan/workflow/output_file.hpp>
#include <turnscan/workflow/progress/phase_plans.hpp>
#include <turnscan/workflow/simulation/seen_by.hpp>
#include <turnscan/workflow/text/evaluation_text.hpp>
#include "cli/command_line.hpp"
#include "cli/commands.hpp"

namespace turnscan::cli {

namespace {

struct ErrorMapOptions {
  std::optional<double> scale_m, thickness_scale_m;
};

OptionTable describe(ErrorMapOptions& o) {
  OptionTable table;
  table.number(
      "error-scale", o.scale_m, Quantity::kLength, {1e-6, 1.0},
      "Error at the end of the colour scale of the error map; auto: the largest threshold");
  table.number("thickness-scale", o.thickness_scale_m, Quantity::kLength, {1e-6, 10.0},
               "Thickness at the end of the colour scale of the thickness map; auto: the thickest "
               "wall");
  return table;
}

Result<std::optional<double>> unit_of(const std::string& text) {
  if (text.empty()) return std::optional<double>();
  TURNSCAN_ASSIGN(const double scale, metres_per(text));
  return std::optional<double>(scale);
}

class EvaluateCommand : public Command {
 public:
  void declare(CommandLine& line) override {
    line.positional("MESH", mesh_,
                    "Mesh to evaluate; with --artefact also a point cloud (.ply, .pcd)");
    line.option("--reference", "MESH", reference_,
                "The true surface. Required without --artefact, --elements or "
                "--thickness-map");
    line.option("--seen-from", "RECORDING", seen_from_,
                "Evaluate completeness only where the frames of this recording saw the reference, "
                "which must lie in the recording's table frame");
    line.option("--elements", "FILE.json", elements_,
                "Fit the spheres, cylinders, cones, planes, circles and lines of this file to the "
                "mesh, after --align if given, and measure their distances and angles");
    line.option("--elements-csv", "FILE.csv", elements_csv_,
                "Write the figures of --elements as a table");
    line.option("--thickness-map", "FILE.ply", thickness_map_,
                "Write the mesh coloured by the thickness of its walls; thin ones are yellow");
    line.option("--json", "FILE.json", json_, "Write the figures as JSON");
    line.option("--error-map", "FILE.ply", error_map_, "Write the mesh coloured by its error");
    line.option("--unit", "UNIT", unit_, "Unit of MESH if its file does not say it: mm, m, ...");
    line.option("--reference-unit", "UNIT", reference_unit_, "The same for the reference");
    line.allow_config();
    line.group("evaluation", "Evaluation", describe(options_));
    line.group("error-map", "Maps", describe(map_options_));
    line.group("artefact", "Artefact", describe(artefact_));
    line.common({"reference", "align", "seen-from", "thresholds", "error-map", "json", "unit",
                 "reference-unit", "samples", "tolerance", "artefact", "elements"});
  }

  FileRoles files() const override {
    return {{mesh_, reference_, seen_from_, elements_},
            {json_, error_map_, elements_csv_, thickness_map_}};
  }

  Result<> run(Session& session) override {
    TURNSCAN_TRY(check_output_file(json_, ".json"));
    TURNSCAN_TRY(check_output_file(error_map_, ".ply"));
    TURNSCAN_TRY(check_output_file(elements_csv_, ".csv"));
    TURNSCAN_TRY(check_output_file(thickness_map_, ".ply"));
    TURNSCAN_ASSIGN(const auto unit, unit_of(unit_));
    if (artefact_.artefact != Artefact::kNone) return run_artefact(unit, session);
    TURNSCAN_TRY(check_combination());
    ElementPlan elements;
    if (!elements_.empty()) {
      TURNSCAN_ASSIGN(elements, workflow::read_elements(elements_, session.context()));
    }
    session.plan(phases());
    TURNSCAN_ASSIGN(TriangleMesh mesh, read_mesh(mesh_, {unit}, session.context()));
    std::string text, json;
    if (!reference_.empty()) TURNSCAN_TRY(compare(mesh, text, json, session.context()));
    if (!elements_.empty()) TURNSCAN_TRY(measure(mesh, elements, text, json, session.context()));
    if (!thickness_map_.empty())
      TURNSCAN_TRY(map_thickness(std::move(mesh), text, session.context()));
    if (!json_.empty()) TURNSCAN_TRY(write_file_atomically(json_, json));
    session.print("{}", text);
    for (const std::string& file : {json_, error_map_, elements_csv_, thickness_map_}) {
      if (!file.empty()) session.print("Wrote {}\n", file);
    }
    return {};
  }

 private:
  Result<> run_artefact(std::optional<double> unit, Session& session) const {
    for (const auto& [name, value] :
         {std::pair("--reference", &reference_), std::pair("--seen-from", &seen_from_),
          std::pair("--error-map", &error_map_), std::pair("--elements", &elements_),
          std::pair("--thickness-map", &thickness_map_)}) {
      if (!value->empty())
        return fail(ErrorCode::kInvalidOption,
                    "evaluate: {} cannot be combined with --artefact, which needs no reference; "
                    "leave one of them out",
                    name);
    }
    session.plan({{"artefact"}});
    TURNSCAN_ASSIGN(const PointCloud cloud, read_artefact(mesh_, unit, session.context()));
    TURNSCAN_ASSIGN(const ArtefactFigures figures,
                    measure_artefact(cloud, artefact_, session.context()));
    if (!json_.empty()) TURNSCAN_TRY(write_file_atomically(json_, to_json(figures)));
    session.print("{}", artefact_text(figures));
    if (!json_.empty()) session.print("Wrote {}\n", json_);
    return {};
  }

  Result<> check_combination() const {
    if (artefact_.diameter_m || artefact_.spacing_m)
      return fail(ErrorCode::kInvalidOption,
                  "evaluate: --ball-diameter and --ball-spacing describe an artefact; choose one "
                  "with --artefact ball or ball-bar");
    if (!elements_csv_.empty() && elements_.empty())
      return fail(ErrorCode::kInvalidOption,
                  "evaluate: --elements-csv has nothing to write; give --elements");
    if (!reference_.empty()) return {};
    if (elements_.empty() && thickness_map_.empty())
      return fail(ErrorCode::kInvalidOption,
                  "evaluate: there is nothing to compare with; give --reference, --elements, "
                  "--thickness-map, or --artefact for the scan of a ball, ball bar or plate");
    for (const auto& [name, value] :
         {std::pair("--seen-from", &seen_from_), std::pair("--error-map", &error_map_)})
      if (!value->empty())
        return fail(ErrorCode::kInvalidOption, "evaluate: {} needs --reference", name);
    if (options_.align != Align::kNone)
      return fail(ErrorCode::kInvalidOption, "evaluate: --align needs --reference");
    return {};
  }

  PhasePlan phases() const {
    PhasePlan plan;
    if (!reference_.empty()) plan = evaluate_phases(options_);
    if (!seen_from_.empty()) plan = joined({plan, seen_phases()});
    if (!elements_.empty()) plan.push_back({"elements"});
    if (!thickness_map_.empty()) plan.push_back({"thickness"});
    return plan;
  }

  /// Compares with the reference, and moves the mesh onto it.
  Result<> compare(TriangleMesh& mesh, std::string& text, std::string& json,
                   const RunContext& context) const {
    TURNSCAN_ASSIGN(const auto reference_unit, unit_of(reference_unit_));
    TURNSCAN_ASSIGN(const TriangleMesh reference, read_mesh(reference_, {reference_unit}, context));
    TURNSCAN_ASSIGN(const Evaluation result, judge(mesh, reference, context));
    if (result.aligned) mesh = transformed(mesh, result.T_reference_mesh);
    if (!error_map_.empty()) TURNSCAN_TRY(write_error_map(mesh, reference, result, context));
    text += evaluation_text(result);
    json = to_json(result);
    return {};
  }

  Result<> measure(const TriangleMesh& mesh, const ElementPlan& plan, std::string& text,
                   std::string& json, const RunContext& context) const {
    TURNSCAN_ASSIGN(const ElementReport report, measure_elements(mesh, plan, context));
    text += workflow::elements_text(report);
    const std::string own = workflow::elements_json(report);
    json = json.empty() ? own : text::with_json_member(std::move(json), "inspection", own);
    if (!elements_csv_.empty())
      TURNSCAN_TRY(write_file_atomically(elements_csv_, workflow::elements_csv(report)));
    return {};
  }

  Result<> map_thickness(TriangleMesh mesh, std::string& text, const RunContext& context) const {
    TURNSCAN_ASSIGN(const std::vector<float> thickness, wall_thicknesses(mesh, context));
    const DeviationFigures figures = deviation_figures(thickness, surface_shares(mesh), 0.0);
    if (figures.count == 0)
      return fail(ErrorCode::kMissingData,
                  "evaluate: no wall of the mesh has two sides; close its holes first");
    text += fmt::format("Walls: {} thin at least, {} in the mean, {} at most\n",
                        length_text(figures.lowest_m), length_text(figures.mean_m),
                        length_text(figures.highest_m));
    return write_mesh(
        thickness_map_,
        color_by_thickness(std::move(mesh), thickness,
                           map_options_.thickness_scale_m.value_or(figures.highest_m)));
  }

  Result<Evaluation> judge(const TriangleMesh& mesh, const TriangleMesh& reference,
                           const RunContext& context) const {
    if (seen_from_.empty()) return evaluate(mesh, reference, options_, {}, context);
    TURNSCAN_ASSIGN(const Recording recording, Recording::open(seen_from_, context));
    TURNSCAN_ASSIGN(const Scene scene,
                    Scene::create(std::span(&reference, 1), std::nullopt, context));
    return evaluate(mesh, reference, options_, seen_by(scene, recording, context), context);
  }

  Result<> write_error_map(TriangleMesh mesh, const TriangleMesh& reference,
                           const Evaluation& result, const RunContext& context) const {
    double scale = map_options_.scale_m.value_or(0.0);
    for (const ThresholdScore& score : result.scores) {
      if (!map_options_.scale_m) scale = std::max(scale, score.threshold_m);
    }
    mesh.normals.clear();
    TURNSCAN_ASSIGN(const TriangleMesh colored, color_by_error(mesh, reference, scale, context));
    return write_mesh(error_map_, colored);
  }

  std::string mesh_, reference_, seen_from_, json_, error_map_, unit_, reference_unit_;
  std::string elements_, elements_csv_, thickness_map_;
  EvaluateOptions options_;
  ErrorMapOptions map_options_;
  ArtefactOptions artefact_;
};

}  // namespace

std::unique_ptr<Command> make_evaluate_command() { return std::make_unique<EvaluateCommand>(); }

}  // namespace turnscan::cli
