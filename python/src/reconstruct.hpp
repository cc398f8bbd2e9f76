#pragma once

#include <turnscan/reconstruction/result.hpp>
#include <vector>

#include "errors.hpp"
#include "meshes.hpp"

namespace turnscan::python {

void bind_reconstruct(py::module_& module);

/// Copies.
std::vector<MeshObject> meshes_of(const Reconstruction& reconstruction);

}  // namespace turnscan::python
