#pragma once

#include <memory>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>

#include "errors.hpp"

namespace turnscan::python {

/// A mesh as Python holds it. It does not change once it is made: arrays look into it.
struct MeshObject {
  std::shared_ptr<const TriangleMesh> mesh;
};

/// Of the argument of save(); raises what the field's check says.
WriteMeshOptions mesh_options_of(const std::string& up);

void bind_meshes(py::module_& module);

}  // namespace turnscan::python
