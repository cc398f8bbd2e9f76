#include <pybind11/stl.h>

#include <turnscan/api/stream.hpp>

#include "arrays.hpp"
#include "bindings.hpp"
#include "call.hpp"
#include "frames.hpp"
#include "meshes.hpp"
#include "option_arguments.hpp"
#include "reconstruct.hpp"

namespace turnscan::python {

namespace {

/// Frames of one camera, as any program delivers them.
class StreamObject {
 public:
  StreamObject(std::optional<TurntableInfo> turntable, double depth_unit, const py::object& pose,
               const py::kwargs& options) {
    if (!(depth_unit > 0.0 && depth_unit <= 1.0))
      raise({ErrorCode::kInvalidOption,
             fmt::format("depth_unit: {} m is not within 0 to 1 m", depth_unit), ""});
    header_.turntable = std::move(turntable);
    sensor_.depth_unit_m = depth_unit;
    sensor_.T_table_sensor = pose_of(pose);
    options_ = options_from(reconstruct_options(), options);
  }

  void add(const py::object& depth, const CameraIntrinsics& intrinsics, std::optional<double> angle,
           std::optional<double> time, const py::object& pose, const py::object& color) {
    if (!stream_) begin(intrinsics);
    check_camera(intrinsics);
    Frame frame = frame_of({depth, angle, time, pose, color}, intrinsics);
    frame.info.index = count_;
    call(py::none(), [&](const RunContext& context) { return stream_->add(frame, context); });
    ++count_;
  }

  MeshObject preview() const {
    if (!stream_) return {std::make_shared<TriangleMesh>()};
    TriangleMesh mesh =
        call(py::none(), [&](const RunContext& context) { return stream_->preview(context); });
    return {std::make_shared<TriangleMesh>(std::move(mesh))};
  }

  std::vector<MeshObject> finish(const py::object& progress) {
    if (!stream_)
      raise({ErrorCode::kTooFewPoints, "finish: no frame was added; add some first", ""});
    Stream stream = std::move(*stream_);
    stream_.reset();
    count_ = 0;
    return meshes_of(std::make_shared<ReconstructedScan>(
        call(progress, [&](const RunContext& context) { return stream.finish(context); })));
  }

  std::uint32_t count() const { return count_; }

 private:
  void begin(const CameraIntrinsics& intrinsics) {
    sensor_.intrinsics = intrinsics;
    header_.sensors = {sensor_};
    stream_.emplace(unwrap(Stream::create(header_, options_)));
  }

  void check_camera(const CameraIntrinsics& given) const {
    const CameraIntrinsics& c = header_.sensors.front().intrinsics;
    const bool same = c.width == given.width && c.height == given.height && c.fx == given.fx &&
                      c.fy == given.fy && c.cx == given.cx && c.cy == given.cy &&
                      c.distortion == given.distortion;
    if (!same)
      raise({ErrorCode::kInvalidOption,
             "intrinsics: they differ from those of the first frame; a stream has one camera", ""});
  }

  SequenceHeader header_;
  SensorInfo sensor_;
  Options options_;
  std::optional<Stream> stream_;
  std::uint32_t count_ = 0;
};

}  // namespace

void bind_stream(py::module_& module) {
  py::class_<StreamObject>(module, "_Stream")
      .def(py::init<std::optional<TurntableInfo>, double, const py::object&, const py::kwargs&>(),
           py::arg("turntable") = py::none(), py::arg("depth_unit") = 1e-4,
           py::arg("pose") = py::none())
      .def("_add", &StreamObject::add)
      .def("preview", &StreamObject::preview)
      .def("finish", &StreamObject::finish, py::arg("progress") = py::none())
      .def("__len__", &StreamObject::count);
}

}  // namespace turnscan::python
