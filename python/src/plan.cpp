#include <pybind11/stl.h>

#include <turnscan/api/plan.hpp>

#include "bindings.hpp"
#include "call.hpp"
#include "option_arguments.hpp"

namespace turnscan::python {

namespace {

py::object planned(const std::vector<std::string>& objects, const py::object& progress,
                   const py::kwargs& arguments) {
  const Options options = options_from(plan_options(), arguments);
  const std::string plans = call(
      progress, [&](const RunContext& context) { return plan_rig(objects, options, context); });
  return py::module_::import("json").attr("loads")(plans);
}

}  // namespace

void bind_plan(py::module_& module) {
  module.def("plan", &planned, py::arg("objects"), py::arg("progress"));
  module.def("_plan_options", [] { return described(plan_options()); });
}

}  // namespace turnscan::python
