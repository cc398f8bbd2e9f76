#include <turnscan/api/evaluate.hpp>
#include <turnscan/api/named_options.hpp>
#include <turnscan/evaluation/evaluate.hpp>

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

}  // namespace turnscan
