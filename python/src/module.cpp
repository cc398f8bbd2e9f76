#include <turnscan/core/parallel.hpp>
#include <turnscan/core/version.hpp>

#include "bindings.hpp"
#include "errors.hpp"
#include "frames.hpp"
#include "meshes.hpp"
#include "reconstruct.hpp"

PYBIND11_MODULE(_turnscan, module) {
  using namespace turnscan::python;
  pybind11::module_ errors = pybind11::module_::import("turnscan.errors");
  bind_errors(errors);
  bind_batch(module);
  bind_meshes(module);
  bind_frames(module);
  bind_reconstruct(module);
  bind_plan(module);
  bind_simulate(module);
  bind_source(module);
  bind_stream(module);
  module.attr("__version__") = turnscan::version();
  module.def(
      "set_threads", [](int count) { turnscan::set_thread_count(count); }, pybind11::arg("count"));
}
