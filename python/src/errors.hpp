#pragma once
// What fails becomes an exception: turnscan.Error with code and path; OptionError for wrong
// options.

#include <pybind11/pybind11.h>

#include <turnscan/core/result.hpp>

namespace turnscan::python {

namespace py = pybind11;

void bind_errors(py::module_& module);

/// Throws the exception of an error. With the GIL.
[[noreturn]] void raise(const Error& error);

/// The value, or the exception.
template <class T>
T unwrap(Result<T> result) {
  if (!result) raise(result.error());
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

}  // namespace turnscan::python
