#include <pybind11/stl.h>

#include <turnscan/api/batch.hpp>

#include "bindings.hpp"
#include "call.hpp"

namespace turnscan::python {

namespace {

using Sweep = std::vector<std::pair<std::string, std::vector<std::string>>>;

py::dict batch_of(const std::vector<std::string>& inputs, const std::string& folder,
                  const std::string& command, const Options& options, const Sweep& sweep,
                  const Options& engine, const std::string& program, const py::object& progress) {
  const Batch batch{inputs, command, options, sweep, engine, program, {}};
  const BatchResult made =
      call(progress, [&](const RunContext& context) { return run_batch(batch, folder, context); });
  py::dict figures;
  figures["tasks"] = made.tasks;
  figures["done"] = made.done;
  figures["failed"] = made.failed;
  figures["files"] = made.files;
  return figures;
}

}  // namespace

void bind_batch(py::module_& module) { module.def("_batch", &batch_of); }

}  // namespace turnscan::python
