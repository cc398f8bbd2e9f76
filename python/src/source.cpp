#include <pybind11/stl.h>

#include <turnscan/capture/source/frame_source.hpp>

#include "bindings.hpp"
#include "call.hpp"

namespace turnscan::python {

namespace {

constexpr double kSignalPause_s = 0.05;
constexpr double kPatience_s = 10.0;

/// A sensor, whose frames come one by one.
class SourceObject {
 public:
  explicit SourceObject(const std::string& uri)
      : source_(call(py::none(),
                     [&](const RunContext& context) { return open_source(uri, context); })) {}

  const SourceInfo& info() const { return source_->info(); }

  Frame next() {
    if (!started_) unwrap(source_->start());
    started_ = true;
    for (double waited_s = 0.0; waited_s < kPatience_s; waited_s += kSignalPause_s) {
      Delivery delivery = unwrap(taken());
      if (delivery.kind == Delivery::Kind::kFrame) return std::move(delivery.frame);
      if (delivery.kind == Delivery::Kind::kEnd) throw py::stop_iteration();
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    }
    raise({ErrorCode::kDeviceLost, fmt::format("no frame came for {} s", kPatience_s), ""});
  }

  void stop() { source_->stop(); }

 private:
  Result<Delivery> taken() {
    const py::gil_scoped_release free;
    return source_->next(kSignalPause_s, RunContext());
  }

  std::unique_ptr<FrameSource> source_;
  bool started_ = false;
};

}  // namespace

void bind_source(py::module_& module) {
  py::class_<SourceObject>(module, "Source")
      .def(py::init<const std::string&>(), py::arg("uri"))
      .def("__iter__", [](const py::object& self) { return self; })
      .def("__next__", &SourceObject::next)
      .def("stop", &SourceObject::stop)
      .def_property_readonly("sensors",
                             [](const SourceObject& s) { return s.info().header.sensors; })
      .def_property_readonly("turntable",
                             [](const SourceObject& s) { return s.info().header.turntable; });
}

}  // namespace turnscan::python
