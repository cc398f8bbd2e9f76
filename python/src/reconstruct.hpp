#pragma once

#include <memory>
#include <turnscan/api/reconstruct.hpp>
#include <vector>

#include "errors.hpp"
#include "meshes.hpp"

namespace turnscan::python {

void bind_reconstruct(py::module_& module);

/// They share the scan.
std::vector<MeshObject> meshes_of(const std::shared_ptr<ReconstructedScan>& scan);

}  // namespace turnscan::python
