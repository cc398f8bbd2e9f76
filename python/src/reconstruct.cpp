#include "reconstruct.hpp"

#include <pybind11/stl.h>

#include <turnscan/reconstruction/report.hpp>
#include <turnscan/recording/calibration_file.hpp>
#include <turnscan/workflow/calibration/calibrate_run.hpp>
#include <turnscan/workflow/mesh_output.hpp>
#include <turnscan/workflow/reconstruct_run.hpp>

#include "call.hpp"
#include "frames.hpp"
#include "meshes.hpp"
#include "option_arguments.hpp"

namespace turnscan::python {

namespace {

/// What reconstruct() gives.
struct RunObject {
  ReconstructRun run;
  ReconstructOptions options;
};

ReconstructFiles files_for(const std::string& mesh, const std::string& report,
                           const std::string& page, const std::string& up) {
  ReconstructFiles files;
  files.mesh = mesh;
  files.mesh_options = mesh_options_of(up);
  files.report = report;
  files.page = page;
  return files;
}

std::shared_ptr<RunObject> reconstruct_frames(
    const std::vector<std::shared_ptr<SequenceObject>>& recordings, const std::string& calibration,
    const std::string& turntable, bool allow_open, const py::object& progress,
    const py::kwargs& options) {
  if (recordings.empty())
    raise({ErrorCode::kInvalidOption, "recordings: there is none; give one", ""});
  ReconstructRequest request;
  set_options(describe(request.options), options);
  request.calibration = calibration;
  request.turntable = turntable;
  request.allow_open = allow_open;
  std::vector<NamedSequence> named;
  for (const auto& recording : recordings)
    named.push_back({recording->title(), &recording->sequence()});
  auto made = std::make_shared<RunObject>();
  made->run = call(progress, [&](const RunContext& context) {
    return run_reconstruction(named, request, context);
  });
  made->options = request.options;
  unwrap(check_joined(made->run.apart));
  return made;
}

std::vector<MeshObject> meshes_of_run(const std::shared_ptr<RunObject>& self) {
  std::vector<MeshObject> meshes;
  for (const ObjectResult& object : self->run.reconstruction.objects)
    meshes.push_back({std::shared_ptr<const TriangleMesh>(self, &object.mesh)});
  return meshes;
}

std::shared_ptr<Calibration> calibrate_frames_(const std::shared_ptr<SequenceObject>& recording,
                                               const std::string& way, const py::object& progress,
                                               const py::kwargs& options) {
  CalibrateRequest request;
  const std::vector<std::string> ways{"auto", "points", "platter", "motion"};
  const auto found = std::find(ways.begin(), ways.end(), way);
  if (found == ways.end() || way == "points")
    raise({ErrorCode::kInvalidOption,
           fmt::format("way: there is no '{}'; use auto, platter or motion", way), ""});
  request.way = static_cast<CalibrationWay>(found - ways.begin());
  OptionTable table = describe(request.average);
  table.append(describe(request.detect)).append(describe(request.motion));
  set_options(table, options);
  return std::make_shared<Calibration>(call(progress, [&](const RunContext& context) {
    return run_calibration(recording->sequence(), request, context);
  }));
}

}  // namespace

std::vector<MeshObject> meshes_of(const Reconstruction& reconstruction) {
  std::vector<MeshObject> meshes;
  for (const ObjectResult& object : reconstruction.objects)
    meshes.push_back({std::make_shared<TriangleMesh>(object.mesh)});
  return meshes;
}

void bind_reconstruct(py::module_& module) {
  py::class_<RunObject, std::shared_ptr<RunObject>>(module, "Reconstruction")
      .def_property_readonly("meshes", &meshes_of_run)
      .def_property_readonly("notes",
                             [](const RunObject& self) { return self.run.reconstruction.notes; })
      .def_property_readonly(
          "verdicts",
          [](const RunObject& self) {
            std::vector<std::string> colours;
            for (const ObjectResult& object : self.run.reconstruction.objects)
              colours.emplace_back(object.verdict ? object.verdict->colour() : std::string_view());
            return colours;
          })
      .def_property_readonly("report",
                             [](const RunObject& self) {
                               return py::module_::import("json").attr("loads")(
                                   report_json(self.run.reconstruction, self.options));
                             })
      .def(
          "save",
          [](const RunObject& self, const std::string& path, const std::string& report,
             const std::string& page, const std::string& up) {
            const ReconstructFiles files = files_for(path, report, page, up);
            return call(py::none(), [&](const RunContext& context) {
              const auto fine = check_outputs(files);
              if (!fine) return Result<std::vector<std::string>>(tl::unexpected(fine.error()));
              return write_outputs(files, self.run, self.options, context);
            });
          },
          py::arg("path"), py::arg("report") = "", py::arg("page") = "", py::arg("up") = "auto");
  module.def("_reconstruct", &reconstruct_frames, py::arg("recordings"),
             py::arg("calibration") = "auto", py::arg("turntable") = "",
             py::arg("allow_open") = false, py::arg("progress") = py::none());
  module.def("_reconstruct_options", [] {
    ReconstructOptions options;
    return described(describe(options));
  });
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
  module.def("calibrate", &calibrate_frames_, py::arg("recording"), py::arg("way") = "auto",
             py::arg("progress") = py::none());
}

}  // namespace turnscan::python
