#include "errors.hpp"

namespace turnscan::python {

namespace {

py::object& error_class(bool option) {
  static auto* classes = new std::array<py::object, 2>();  // outlives the interpreter
  return (*classes)[option ? 1 : 0];
}

}  // namespace

void bind_errors(py::module_& module) {
  error_class(false) = module.attr("Error");
  error_class(true) = module.attr("OptionError");
}

void raise(const Error& error) {
  const py::object& type = error_class(error.code == ErrorCode::kInvalidOption);
  const py::object exception = type(error.text(), std::string(name_of(error.code)), error.path);
  PyErr_SetObject(type.ptr(), exception.ptr());
  throw py::error_already_set();
}

}  // namespace turnscan::python
