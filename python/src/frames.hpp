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

/// Sets depth and colour of a frame from numpy arrays; depth is of type uint16. Raises for what is
/// no image.
void set_images(Frame& frame, const py::object& depth, const py::object& color);

}  // namespace turnscan::python
