#include "frames.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <turnscan/api/recording.hpp>
#include <turnscan/recording/recording.hpp>

#include "arrays.hpp"
#include "call.hpp"
#include "option_arguments.hpp"
#include "packed_depth.hpp"

namespace turnscan::python {

py::object matrix_of(const std::optional<Pose>& pose) {
  if (!pose) return py::none();
  py::array_t<double> matrix({4, 4});
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      matrix.mutable_at(row, column) = pose->matrix()(row, column);
  return matrix;
}

std::optional<Pose> pose_of(const py::object& matrix) {
  if (matrix.is_none()) return std::nullopt;
  const py::array given(matrix);
  if (given.ndim() != 2 || given.shape(0) != 4 || given.shape(1) != 4)
    raise({ErrorCode::kFormat, "pose: a matrix of four rows of four is needed", ""});
  const auto array = packed<double>(given, "pose");
  Eigen::Matrix4d values;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) values(row, column) = array.at(row, column);
  return unwrap(pose_from(values));
}

namespace {

Vec3d vector_of(const std::array<double, 3>& values) { return {values[0], values[1], values[2]}; }
std::array<double, 3> array_of(const Vec3d& v) { return {v.x(), v.y(), v.z()}; }

struct RecordingObject : SequenceObject {
  RecordingObject(std::string named, OpenedFrames frames)
      : path(std::move(named)), opened(std::move(frames)) {}
  const FrameSequence& sequence() const override { return *opened.frames; }
  std::string title() const override { return path; }
  std::string path;
  OpenedFrames opened;
};

std::shared_ptr<RecordingObject> open_recording(const std::string& path, const py::kwargs& given) {
  const Options options = options_from(import_options(), given);
  return std::make_shared<RecordingObject>(
      path, call(py::none(), [&](const RunContext&) { return open_frames(path, options); }));
}

/// Frames that a program hands over one after the other.
class ListedFrames : public FrameSequence {
 public:
  const SequenceHeader& header() const override { return header_; }
  const std::vector<FrameInfo>& frames() const override { return infos_; }
  Result<Frame> read(std::size_t position) const override {
    const Kept& kept = frames_.at(position);
    Frame frame = kept.rest;
    frame.info = infos_.at(position);
    frame.depth = kept.depth.unpacked();
    return frame;
  }
  void add(Frame frame) {
    frame.info.index = static_cast<std::uint32_t>(frames_.size());
    infos_.push_back(frame.info);
    PackedDepth depth(frame.depth);
    frame.depth = DepthImage();
    frames_.push_back({std::move(frame), std::move(depth)});
  }
  SequenceHeader header_;

 private:
  struct Kept {
    Frame rest;  ///< without its depth
    PackedDepth depth;
  };
  std::vector<FrameInfo> infos_;
  std::vector<Kept> frames_;
};

struct FramesObject : SequenceObject {
  const FrameSequence& sequence() const override { return frames; }
  std::string title() const override { return "frames"; }
  ListedFrames frames;
};

void bind_camera(py::module_& module) {
  using Intrinsics = CameraIntrinsics;
  py::class_<Intrinsics>(module, "Intrinsics")
      .def(py::init([](int width, int height, double fx, double fy, double cx, double cy,
                       const py::sequence& distortion) {
             Intrinsics made{width, height, fx, fy, cx, cy, {}};
             // Counted before they are copied: an array may have thousands of millions.
             const std::size_t count = py::len(distortion);
             if (count != 5 && count != made.distortion.size())
               throw py::value_error("distortion: it has " + std::to_string(count) +
                                     " numbers, not 5 (k1 k2 p1 p2 k3) or 8 (and k4 k5 k6)");
             std::vector<double> numbers;
             try {
               numbers = distortion.cast<std::vector<double>>();
             } catch (const py::cast_error&) {
               throw py::type_error("distortion: it is not a list of numbers");
             }
             std::copy(numbers.begin(), numbers.end(), made.distortion.begin());
             unwrap(made.check());
             return made;
           }),
           py::arg("width"), py::arg("height"), py::arg("fx"), py::arg("fy"), py::arg("cx"),
           py::arg("cy"), py::arg("distortion") = std::vector<double>(5, 0.0))
      .def_readonly("width", &Intrinsics::width)
      .def_readonly("height", &Intrinsics::height)
      .def_readonly("fx", &Intrinsics::fx)
      .def_readonly("fy", &Intrinsics::fy)
      .def_readonly("cx", &Intrinsics::cx)
      .def_readonly("cy", &Intrinsics::cy)
      .def_property_readonly("distortion", [](const Intrinsics& self) {
        const auto& d = self.distortion;
        return std::vector<double>(d.begin(), self.rational() ? d.end() : d.begin() + 5);
      });
  py::class_<SensorInfo>(module, "Sensor")
      .def(py::init([](const Intrinsics& intrinsics, double depth_unit, const py::object& pose,
                       const std::string& model) {
             if (!(depth_unit > 0.0 && depth_unit <= 1.0))
               raise({ErrorCode::kInvalidOption,
                      fmt::format("depth_unit: {} m is not within 0 to 1 m", depth_unit), ""});
             SensorInfo made;
             made.intrinsics = intrinsics;
             made.depth_unit_m = depth_unit;
             made.T_table_sensor = pose_of(pose);
             made.model = model;
             return made;
           }),
           py::arg("intrinsics"), py::arg("depth_unit") = 1e-4, py::arg("pose") = py::none(),
           py::arg("model") = "")
      .def_readonly("intrinsics", &SensorInfo::intrinsics)
      .def_readonly("depth_unit", &SensorInfo::depth_unit_m)
      .def_readonly("depth_bias", &SensorInfo::depth_bias_m)
      .def_readonly("model", &SensorInfo::model)
      .def_property_readonly("pose",
                             [](const SensorInfo& s) { return matrix_of(s.T_table_sensor); });
  py::class_<TurntableInfo>(module, "Turntable")
      .def(py::init([](const std::array<double, 3>& axis, const std::array<double, 3>& center,
                       std::optional<double> radius, std::optional<double> speed) {
             const Vec3d along = vector_of(axis);
             if (!(along.norm() > 0.0 && along.allFinite() && vector_of(center).allFinite()))
               raise({ErrorCode::kInvalidOption,
                      "turntable: axis and center must be finite, and the axis has a direction",
                      ""});
             TurntableInfo made;
             made.axis = along.normalized();
             made.center_m = vector_of(center);
             made.radius_m = radius;
             made.speed_rad_s = speed;
             return made;
           }),
           py::arg("axis"), py::arg("center"), py::arg("radius") = py::none(),
           py::arg("speed") = py::none())
      .def_property_readonly("axis", [](const TurntableInfo& t) { return array_of(t.axis); })
      .def_property_readonly("center", [](const TurntableInfo& t) { return array_of(t.center_m); })
      .def_readonly("radius", &TurntableInfo::radius_m)
      .def_readonly("speed", &TurntableInfo::speed_rad_s);
}

void bind_frame(py::module_& module) {
  const auto info = [](auto member) {
    return [member](const Frame& frame) { return frame.info.*member; };
  };
  py::class_<Frame>(module, "Frame")
      .def_property_readonly(
          "depth", [](const py::object& self) { return view_of(self.cast<Frame&>().depth, self); })
      .def_property_readonly(
          "color", [](const py::object& self) { return view_of(self.cast<Frame&>().color, self); })
      .def_property_readonly(
          "points",
          [](const py::object& self) { return view_of(self.cast<Frame&>().points.points, self); })
      .def_property_readonly("index", info(&FrameInfo::index))
      .def_property_readonly("time", info(&FrameInfo::time_s))
      .def_property_readonly("sensor", info(&FrameInfo::sensor))
      .def_property_readonly("pass_", info(&FrameInfo::pass))
      .def_property_readonly("turn", info(&FrameInfo::turn))
      .def_property_readonly("angle", info(&FrameInfo::angle_rad))
      .def_property_readonly("pose",
                             [](const Frame& f) { return matrix_of(f.info.T_table_sensor); })
      .def_property_readonly("dropped",
                             [](const Frame& f) { return f.info.status == FrameStatus::kDropped; });
}

Frame frame_at(const SequenceObject& self, py::ssize_t position) {
  const auto count = static_cast<py::ssize_t>(self.sequence().frames().size());
  if (position < 0) position += count;
  if (position < 0 || position >= count) throw py::index_error("there is no such frame");
  const py::gil_scoped_release free;
  auto frame = self.sequence().read(static_cast<std::size_t>(position));
  const py::gil_scoped_acquire gil;
  return unwrap(std::move(frame));
}

void add_frame(FramesObject& self, const py::object& depth, std::optional<double> angle,
               std::optional<double> time, std::uint32_t sensor, std::uint32_t pass,
               std::uint32_t turn, const py::object& pose, const py::object& color) {
  if (sensor >= self.frames.header_.sensors.size())
    raise({ErrorCode::kInvalidOption, fmt::format("sensor: there is no {}", sensor), ""});
  Frame frame =
      frame_of({depth, angle, time, pose, color}, self.frames.header_.sensors[sensor].intrinsics);
  frame.info.sensor = sensor;
  frame.info.pass = pass;
  frame.info.turn = turn;
  self.frames.add(std::move(frame));
}

}  // namespace

Frame frame_of(const FrameParts& parts, const CameraIntrinsics& camera) {
  const auto check_size = [&](const py::array& image, const char* name, py::ssize_t dimensions) {
    // Before it is copied: an array may pretend to be of any size.
    if (image.ndim() == dimensions && image.shape(0) == camera.height &&
        image.shape(1) == camera.width && (dimensions == 2 || image.shape(2) == 3))
      return;
    raise({ErrorCode::kFormat,
           fmt::format("{}: an array of {} rows of {} pixels{} is needed, as of its camera", name,
                       camera.height, camera.width, dimensions == 2 ? "" : " of three channels"),
           ""});
  };
  if (parts.angle && !std::isfinite(*parts.angle))
    raise({ErrorCode::kInvalidOption, "angle: it is not finite; leave it out if it is not known",
           ""});
  if (parts.time && std::isinf(*parts.time))
    raise({ErrorCode::kInvalidOption, "time: it is infinite; leave it out if it is not known", ""});
  Frame frame;
  const py::array depth(parts.depth);
  check_size(depth, "depth", 2);
  const auto image = packed<std::uint16_t>(depth, "depth");
  frame.depth.width = camera.width;
  frame.depth.height = camera.height;
  frame.depth.pixels.assign(image.data(), image.data() + image.size());
  if (!parts.color.is_none()) {
    const py::array color(parts.color);
    check_size(color, "color", 3);
    const auto colors = packed<std::uint8_t>(color, "color");
    frame.color = ColorImage(camera.width, camera.height);
    const std::uint8_t* from = colors.data();
    for (Rgb& pixel : frame.color.pixels) {
      pixel = {from[0], from[1], from[2]};
      from += 3;
    }
  }
  frame.info.angle_rad = parts.angle;
  if (parts.time) frame.info.time_s = *parts.time;
  frame.info.T_table_sensor = pose_of(parts.pose);
  return frame;
}

void bind_frames(py::module_& module) {
  module.def("_import_options", [] { return described(import_options()); });
  bind_camera(module);
  bind_frame(module);
  py::class_<SequenceObject, std::shared_ptr<SequenceObject>>(module, "Sequence")
      .def("__len__", [](const SequenceObject& self) { return self.sequence().frames().size(); })
      .def("__getitem__", &frame_at, py::arg("position"))
      .def_property_readonly(
          "sensors", [](const SequenceObject& self) { return self.sequence().header().sensors; })
      .def_property_readonly("turntable", [](const SequenceObject& self) {
        return self.sequence().header().turntable;
      });
  py::class_<RecordingObject, SequenceObject, std::shared_ptr<RecordingObject>>(module, "Recording")
      .def(py::init(&open_recording), py::arg("path"))
      .def_property_readonly("path", &RecordingObject::title)
      .def_property_readonly("notes", [](const RecordingObject& r) { return r.opened.notes; })
      .def_property_readonly("complete",
                             [](const RecordingObject& r) { return r.opened.complete; });
  py::class_<FramesObject, SequenceObject, std::shared_ptr<FramesObject>>(module, "_Frames")
      .def(py::init([](std::vector<SensorInfo> sensors, std::optional<TurntableInfo> turntable) {
             auto made = std::make_shared<FramesObject>();
             if (sensors.empty())
               raise({ErrorCode::kInvalidOption, "sensors: there is none; give one", ""});
             made->frames.header_.sensors = std::move(sensors);
             made->frames.header_.turntable = std::move(turntable);
             return made;
           }),
           py::arg("sensors"), py::arg("turntable") = py::none())
      .def("_add", &add_frame)
      .def(
          "save",
          [](const FramesObject& self, const std::string& path, const py::object& progress) {
            call(progress, [&](const RunContext& context) {
              return write_recording(path, self.frames, context);
            });
          },
          py::arg("path"), py::arg("progress") = py::none());
}

}  // namespace turnscan::python
