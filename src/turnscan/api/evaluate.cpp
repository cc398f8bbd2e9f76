#include <turnscan/api/evaluate.hpp>
#include <turnscan/api/named_options.hpp>
#include <turnscan/evaluation/evaluate.hpp>
#include <turnscan/workflow/inspection/element_file.hpp>
#include <turnscan/workflow/inspection/element_output.hpp>

namespace turnscan {

Result<Evaluation> evaluate(const TriangleMesh& mesh, const TriangleMesh& reference,
                            const Options& options, const RunContext& context) {
  EvaluateOptions chosen;
  TURNSCAN_TRY(api::set_fields(describe(chosen), options));
  return evaluate(mesh, reference, chosen, {}, context);
}

std::vector<OptionDescription> evaluate_options() {
  EvaluateOptions chosen;
  return api::describe_fields(describe(chosen));
}

Result<std::string> inspect(const TriangleMesh& mesh, std::string_view elements,
                            const RunContext& context) {
  TURNSCAN_ASSIGN(const ElementPlan plan, workflow::parse_elements(elements, context));
  TURNSCAN_ASSIGN(const ElementReport report, measure_elements(mesh, plan, context));
  return workflow::elements_json(report);
}

}  // namespace turnscan
