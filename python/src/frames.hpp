#pragma once
// Sequences of frames: recordings, simulated scans, and numpy arrays in a list.

#include <memory>
#include <turnscan/core/frame.hpp>

#include "errors.hpp"

namespace turnscan::python {

/// A sequence as Python holds it.
struct SequenceObject {
  virtual ~SequenceObject() = default;
  virtual const FrameSequence& sequence() const = 0;
  virtual std::string title() const = 0;
};

void bind_frames(py::module_& module);

/// What a program hands over of a frame. Its depth is of type uint16.
struct FrameParts {
  py::object depth;
  std::optional<double> angle, time;
  py::object pose, color;
};
/// Raises for what are no images of this camera, no pose, and angles and times that are no numbers;
/// a time that is not known may be NaN.
Frame frame_of(const FrameParts& parts, const CameraIntrinsics& camera);

}  // namespace turnscan::python
