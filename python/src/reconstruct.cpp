#include "reconstruct.hpp"

#include <pybind11/stl.h>

#include <turnscan/api/calibrate.hpp>
#include <turnscan/recording/calibration_file.hpp>

#include "call.hpp"
#include "frames.hpp"
#include "meshes.hpp"
#include "option_arguments.hpp"

namespace turnscan::python {

namespace {

std::shared_ptr<ReconstructedScan> reconstruct_frames(
    const std::vector<std::shared_ptr<SequenceObject>>& recordings, const py::object& progress,
    const py::kwargs& arguments) {
  const Options options = options_from(reconstruct_options(), arguments);
  std::vector<NamedFrames> named;
  for (const auto& recording : recordings)
    named.push_back({recording->title(), &recording->sequence()});
  return std::make_shared<ReconstructedScan>(call(
      progress, [&](const RunContext& context) { return reconstruct(named, options, context); }));
}

std::vector<std::string> write_scan(const ReconstructedScan& self, const std::string& path,
                                    const std::string& report, const std::string& page,
                                    const std::string& up) {
  const OutputFiles files{path, report, page, mesh_options_of(up).up};
  return call(py::none(), [&](const RunContext& context) { return self.write(files, context); });
}

std::vector<std::string> verdicts_of(const ReconstructedScan& self) {
  std::vector<std::string> colours;
  for (const ObjectResult& object : self.objects())
    colours.emplace_back(object.verdict ? object.verdict->colour() : std::string_view());
  return colours;
}

std::shared_ptr<Calibration> calibrate_frames(const std::shared_ptr<SequenceObject>& recording,
                                              const py::object& progress,
                                              const py::kwargs& arguments) {
  const Options options = options_from(calibrate_options(), arguments);
  return std::make_shared<Calibration>(call(progress, [&](const RunContext& context) {
    return calibrate(recording->sequence(), options, context);
  }));
}

}  // namespace

std::vector<MeshObject> meshes_of(const std::shared_ptr<ReconstructedScan>& scan) {
  std::vector<MeshObject> meshes;
  for (const ObjectResult& object : scan->objects())
    meshes.push_back({std::shared_ptr<const TriangleMesh>(scan, &object.mesh)});
  return meshes;
}

void bind_reconstruct(py::module_& module) {
  py::class_<ReconstructedScan, std::shared_ptr<ReconstructedScan>>(module, "Reconstruction")
      .def_property_readonly("meshes", &meshes_of)
      .def_property_readonly("notes",
                             [](const ReconstructedScan& self) { return self.result().notes; })
      .def_property_readonly("verdicts", &verdicts_of)
      .def_property_readonly("report",
                             [](const ReconstructedScan& self) {
                               return py::module_::import("json").attr("loads")(self.report());
                             })
      .def("save", &write_scan, py::arg("path"), py::arg("report") = "", py::arg("page") = "",
           py::arg("up") = "auto");
  module.def("_reconstruct", &reconstruct_frames, py::arg("recordings"),
             py::arg("progress") = py::none());
  module.def("_reconstruct_options", [] { return described(reconstruct_options()); });
  module.def("_calibrate_options", [] { return described(calibrate_options()); });
  py::class_<Calibration, std::shared_ptr<Calibration>>(module, "Calibration")
      .def_property_readonly("turntable", [](const Calibration& c) { return c.table; })
      .def_readonly("angles", &Calibration::angles_rad)
      .def_readonly("notes", &Calibration::notes)
      .def_readonly("center_sigma", &Calibration::center_sigma_m)
      .def_readonly("axis_sigma", &Calibration::axis_sigma_rad)
      .def(
          "save",
          [](const Calibration& self, const std::string& path) {
            call(py::none(), [&](const RunContext&) { return write_calibration(path, self); });
          },
          py::arg("path"));
  module.def("calibrate", &calibrate_frames, py::arg("recording"),
             py::arg("progress") = py::none());
}

}  // namespace turnscan::python
