#pragma once
// Long calls: without the GIL, on a thread of their own, while the caller's looks for Ctrl-C.

#include <pybind11/pybind11.h>

#include <functional>
#include <turnscan/core/run_context.hpp>

#include "errors.hpp"

namespace turnscan::python {

/// Runs work(context). progress, if not None, is called with phase and fraction; what it raises,
/// and what a signal raises (KeyboardInterrupt), cancels the work and is raised in its place.
void call_without_gil(const py::object& progress,
                      const std::function<void(const RunContext&)>& work);

/// The same for what returns a Result.
template <class Work>
auto call(const py::object& progress, const Work& work) {
  decltype(work(RunContext())) result = fail(ErrorCode::kCancelled, "cancelled");
  call_without_gil(progress, [&](const RunContext& context) { result = work(context); });
  return unwrap(std::move(result));
}

}  // namespace turnscan::python
