#pragma once

#include "errors.hpp"

namespace turnscan::python {

void bind_batch(py::module_& module);
void bind_plan(py::module_& module);
void bind_simulate(py::module_& module);
void bind_source(py::module_& module);
void bind_stream(py::module_& module);

}  // namespace turnscan::python
