#include <pybind11/stl.h>

#include <turnscan/api/evaluate.hpp>
#include <turnscan/api/simulate.hpp>

#include "bindings.hpp"
#include "call.hpp"
#include "frames.hpp"
#include "meshes.hpp"
#include "option_arguments.hpp"

namespace turnscan::python {

namespace {

struct SimulationObject : SequenceObject {
  SimulationObject(std::string object, SimulatedScan made)
      : name(std::move(object)), scan(std::move(made)) {}
  const FrameSequence& sequence() const override { return scan.frames(); }
  std::string title() const override { return name; }
  std::string name;
  SimulatedScan scan;
};

using SimulationPointer = std::shared_ptr<SimulationObject>;

SimulationPointer simulate_object(const std::string& object, const std::optional<std::string>& out,
                                  const py::object& progress, const py::kwargs& arguments) {
  const Options options = options_from(simulate_options(), arguments);
  auto made = std::make_shared<SimulationObject>(
      object, call(progress,
                   [&](const RunContext& context) { return simulate(object, options, context); }));
  if (out)
    call(progress, [&](const RunContext& context) { return made->scan.record(*out, context); });
  return made;
}

std::vector<MeshObject> truth_of(const SimulationPointer& self) {
  std::vector<MeshObject> meshes;
  for (std::size_t pass = 0; pass < self->scan.passes(); ++pass)
    meshes.push_back({std::shared_ptr<const TriangleMesh>(self, &self->scan.truth(pass))});
  return meshes;
}

py::object evaluate_mesh_of(const SimulationPointer& self, const MeshObject& mesh,
                            const py::object& progress, const py::kwargs& arguments) {
  const Options options = options_from(evaluate_options(), arguments);
  const Evaluation result = call(progress, [&](const RunContext& context) {
    return self->scan.evaluate(*mesh.mesh, options, context);
  });
  return py::module_::import("json").attr("loads")(to_json(result));
}

}  // namespace

void bind_simulate(py::module_& module) {
  py::class_<SimulationObject, SequenceObject, SimulationPointer>(module, "Simulation")
      .def_property_readonly("truth", &truth_of)
      .def("evaluate", &evaluate_mesh_of, py::arg("mesh"), py::arg("progress") = py::none());
  module.def("simulate", &simulate_object, py::arg("object"), py::arg("out") = py::none(),
             py::arg("progress") = py::none());
  module.def("_simulate_options", [] { return described(simulate_options()); });
}

}  // namespace turnscan::python
