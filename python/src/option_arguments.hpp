#pragma once
// Keyword arguments that are options of the tables: voxel_size="1.5mm" or voxel_size=0.0015.

#include <pybind11/pybind11.h>

#include <turnscan/core/option_table.hpp>

#include "errors.hpp"

namespace turnscan::python {

/// Sets fields by name, hyphens written as underscores. Texts are as on the command line; numbers
/// of fields with a unit are metres, radians, seconds; None leaves a value to be found from the
/// data.
void set_options(const OptionTable& table, const py::dict& options);

/// name, help, unit, choices, default, minimum and maximum of each field.
py::list described(const OptionTable& table);

}  // namespace turnscan::python
