#include <turnscan/api/named_options.hpp>
#include <turnscan/api/plan.hpp>
#include <turnscan/workflow/plan/plan.hpp>

namespace turnscan {

namespace {

OptionTable table_of(PlanRequest& request) {
  OptionTable all = describe(request.options);
  for (SceneTable& table : plan_scene_tables(request.scene)) all.append(std::move(table.options));
  all.text("out", request.folder, "Folder for scenes and pictures; none: no files are written")
      .text("unit", request.unit, "Unit of the mesh files if they do not say it: mm, m, ...");
  return all;
}

}  // namespace

Result<std::string> plan_rig(const std::vector<std::string>& objects, const Options& options,
                             const RunContext& context) {
  PlanRequest request;
  request.objects = objects;
  Options fields = options;
  TURNSCAN_ASSIGN(request.scanners, parse_plan_scanners(api::take(fields, "scanner")));
  TURNSCAN_TRY(api::set_fields(table_of(request), fields));
  TURNSCAN_ASSIGN(const PlanOutcome outcome, run_plan(request, context));
  return plan_json(request, outcome);
}

std::vector<OptionDescription> plan_options() {
  PlanRequest request;
  return api::describe_fields(table_of(request),
                              {{"scanner", "Presets or files of scanners at hand"}});
}

}  // namespace turnscan
