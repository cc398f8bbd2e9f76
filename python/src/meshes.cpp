#include "meshes.hpp"

#include <pybind11/stl.h>

#include <turnscan/api/evaluate.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>

#include "arrays.hpp"
#include "call.hpp"
#include "option_arguments.hpp"

namespace turnscan::python {

namespace {

template <class T>
Packed<T> rows_of(const py::array& array, const char* name, py::ssize_t count = -1) {
  if (array.ndim() == 2 && array.shape(1) == 3 && (count < 0 || array.shape(0) == count))
    return packed<T>(array, name);
  raise({ErrorCode::kFormat, fmt::format("{}: an array of N rows of three is needed", name), ""});
}

/// Arrays, or lists of rows; colors may be None.
MeshObject make_mesh(const py::object& given_vertices, const py::object& given_triangles,
                     const py::object& given_colors) {
  const auto vertices = rows_of<float>(py::array(given_vertices), "vertices");
  const auto triangles = rows_of<std::uint32_t>(py::array(given_triangles), "triangles");
  auto mesh = std::make_shared<TriangleMesh>();
  for (py::ssize_t i = 0; i < vertices.shape(0); ++i)
    mesh->vertices.emplace_back(vertices.at(i, 0), vertices.at(i, 1), vertices.at(i, 2));
  for (py::ssize_t i = 0; i < triangles.shape(0); ++i)
    mesh->triangles.push_back({triangles.at(i, 0), triangles.at(i, 1), triangles.at(i, 2)});
  if (!given_colors.is_none()) {
    const auto colors = rows_of<std::uint8_t>(py::array(given_colors), "colors", vertices.shape(0));
    for (py::ssize_t i = 0; i < colors.shape(0); ++i)
      mesh->colors.push_back({colors.at(i, 0), colors.at(i, 1), colors.at(i, 2)});
  }
  unwrap(validate_mesh(*mesh));
  return {mesh};
}

MeshObject load_mesh(const std::string& path, const std::optional<std::string>& unit) {
  ReadMeshOptions options;
  if (unit) options.metres_per_unit = unwrap(metres_per(*unit));
  TriangleMesh mesh = call(
      py::none(), [&](const RunContext& context) { return read_mesh(path, options, context); });
  return {std::make_shared<TriangleMesh>(std::move(mesh))};
}

py::object evaluate_mesh(const MeshObject& mesh, const MeshObject& reference,
                         const py::object& progress, const py::kwargs& options) {
  const Options chosen = options_from(evaluate_options(), options);
  const Evaluation result = call(progress, [&](const RunContext& context) {
    return evaluate(*mesh.mesh, *reference.mesh, chosen, context);
  });
  return py::module_::import("json").attr("loads")(to_json(result));
}

/// Takes and gives Python's objects for JSON.
py::object inspect_mesh(const MeshObject& mesh, const py::object& elements,
                        const py::object& progress) {
  const py::module_ json = py::module_::import("json");
  const auto text = json.attr("dumps")(elements).cast<std::string>();
  return json.attr("loads")(call(
      progress, [&](const RunContext& context) { return inspect(*mesh.mesh, text, context); }));
}

}  // namespace

WriteMeshOptions mesh_options_of(const std::string& up) {
  WriteMeshOptions options;
  unwrap(describe(options).set("up", up));
  return options;
}

void bind_meshes(py::module_& module) {
  py::class_<MeshObject>(module, "Mesh")
      .def(py::init(&make_mesh), py::arg("vertices"), py::arg("triangles"),
           py::arg("colors") = py::none())
      .def_static("load", &load_mesh, py::arg("path"), py::arg("unit") = py::none())
      .def(
          "save",
          [](const MeshObject& self, const std::string& path, const std::string& up) {
            const WriteMeshOptions options = mesh_options_of(up);
            call(py::none(),
                 [&](const RunContext&) { return write_mesh(path, *self.mesh, options); });
          },
          py::arg("path"), py::arg("up") = "auto")
      .def_property_readonly("vertices",
                             [](const py::object& self) {
                               return view_of(self.cast<MeshObject&>().mesh->vertices, self);
                             })
      .def_property_readonly("triangles",
                             [](const py::object& self) {
                               const auto& triangles = self.cast<MeshObject&>().mesh->triangles;
                               return view_of(
                                   reinterpret_cast<const std::uint32_t*>(triangles.data()),
                                   {static_cast<py::ssize_t>(triangles.size()), 3}, self);
                             })
      .def_property_readonly("normals",
                             [](const py::object& self) {
                               return view_of(self.cast<MeshObject&>().mesh->normals, self);
                             })
      .def_property_readonly("colors",
                             [](const py::object& self) {
                               return view_of(self.cast<MeshObject&>().mesh->colors, self);
                             })
      .def_property_readonly("name", [](const MeshObject& self) { return self.mesh->name; })
      .def("__repr__", [](const MeshObject& self) {
        return fmt::format("Mesh({} vertices, {} triangles)", self.mesh->vertices.size(),
                           self.mesh->triangles.size());
      });
  module.def("evaluate", &evaluate_mesh, py::arg("mesh"), py::arg("reference"),
             py::arg("progress") = py::none());
  module.def("inspect", &inspect_mesh, py::arg("mesh"), py::arg("elements"),
             py::arg("progress") = py::none());
  module.def("_evaluate_options", [] { return described(evaluate_options()); });
}

}  // namespace turnscan::python
