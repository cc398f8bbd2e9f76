#include <pybind11/stl.h>

#include <turnscan/workflow/plan/plan.hpp>

#include "bindings.hpp"
#include "call.hpp"
#include "option_arguments.hpp"

namespace turnscan::python {

namespace {

OptionTable plan_table(PlanRequest& request) {
  OptionTable all = describe(request.options);
  for (SceneTable& table : plan_scene_tables(request.scene)) all.append(std::move(table.options));
  return all;
}

py::object planned(const std::vector<std::string>& objects,
                   const std::vector<std::string>& scanners, const std::string& out,
                   const std::string& unit, const py::object& progress, const py::kwargs& options) {
  PlanRequest request;
  request.objects = objects;
  request.scanners = unwrap(parse_plan_scanners(scanners));
  request.folder = out;
  request.unit = unit;
  set_options(plan_table(request), options);
  const PlanOutcome outcome =
      call(progress, [&](const RunContext& context) { return run_plan(request, context); });
  return py::module_::import("json").attr("loads")(plan_json(request, outcome));
}

}  // namespace

void bind_plan(py::module_& module) {
  module.def("plan", &planned, py::arg("objects"), py::arg("scanners"), py::arg("out"),
             py::arg("unit"), py::arg("progress"));
  module.def("_plan_options", [] {
    PlanRequest request;
    return described(plan_table(request));
  });
}

}  // namespace turnscan::python
