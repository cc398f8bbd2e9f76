#include <pybind11/stl.h>

#include <turnscan/workflow/simulation/simulate.hpp>

#include "bindings.hpp"
#include "call.hpp"
#include "frames.hpp"
#include "meshes.hpp"
#include "option_arguments.hpp"

namespace turnscan::python {

namespace {

struct SimulationObject : SequenceObject {
  explicit SimulationObject(Simulation made) : simulation(std::move(made)) {}
  const FrameSequence& sequence() const override { return simulation.scan; }
  std::string title() const override { return simulation.scene.object; }
  Simulation simulation;
};

OptionTable table_of(SceneDescription& scene) {
  OptionTable all;
  for (SceneTable& table : describe(scene)) all.append(std::move(table.options));
  return all;
}

std::shared_ptr<SimulationObject> simulate_scene(const std::string& object,
                                                 const std::vector<std::string>& scanners,
                                                 const std::optional<std::string>& out,
                                                 const py::object& progress,
                                                 const py::kwargs& options) {
  SceneDescription scene;
  scene.object = object;
  for (const std::string& scanner : scanners)
    scene.scanners.push_back(unwrap(parse_scanner_entry(scanner)));
  set_options(table_of(scene), options);
  auto made = std::make_shared<SimulationObject>(call(
      progress, [&](const RunContext& context) { return prepare_simulation(scene, context); }));
  if (out) {
    call(progress, [&](const RunContext& context) {
      return record_simulation(made->simulation, *out, false, {}, context);
    });
  }
  return made;
}

}  // namespace

void bind_simulate(py::module_& module) {
  py::class_<SimulationObject, SequenceObject, std::shared_ptr<SimulationObject>>(module,
                                                                                  "Simulation")
      .def_property_readonly("truth", [](const SimulationObject& self) {
        std::vector<MeshObject> meshes;
        for (const PlacedObject& placed : self.simulation.placed)
          meshes.push_back({std::make_shared<TriangleMesh>(placed.mesh)});
        return meshes;
      });
  module.def("simulate", &simulate_scene, py::arg("object"),
             py::arg("scanners") = std::vector<std::string>(), py::arg("out") = py::none(),
             py::arg("progress") = py::none());
  module.def("_simulate_options", [] {
    SceneDescription scene;
    return described(table_of(scene));
  });
}

}  // namespace turnscan::python
