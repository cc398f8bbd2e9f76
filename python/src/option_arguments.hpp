#pragma once
// Keyword arguments that are options by name: voxel_size="1.5mm" or voxel_size=0.0015.

#include <pybind11/pybind11.h>

#include <turnscan/api/options.hpp>
#include <vector>

#include "errors.hpp"

namespace turnscan::python {

/// Names with hyphens in place of underscores. Texts are as on the command line; numbers of options
/// with a unit are metres, radians, seconds; None is "auto", a list is a repeatable option.
Options options_from(const std::vector<OptionDescription>& known, const py::dict& arguments);

/// name, help, unit, choices, default, minimum and maximum of each option.
py::list described(const std::vector<OptionDescription>& options);

}  // namespace turnscan::python
