#pragma once
// Numpy's views of our vectors (no copy, read-only, alive as long as their owner), and its arrays
// for us.

#include <pybind11/numpy.h>

#include <array>
#include <cstdint>
#include <turnscan/core/image.hpp>
#include <turnscan/core/pose.hpp>
#include <type_traits>
#include <vector>

#include "errors.hpp"

namespace turnscan::python {

namespace py = pybind11;

static_assert(sizeof(Vec3f) == 3 * sizeof(float) && sizeof(Rgb) == 3);

/// T: the array's element; rows of `shape` behind data, owned by `owner`.
template <class T>
py::array view_of(const T* data, std::vector<py::ssize_t> shape, const py::handle& owner) {
  py::array_t<T> array(std::move(shape), data, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

inline py::array view_of(const std::vector<Vec3f>& points, const py::handle& owner) {
  return view_of(reinterpret_cast<const float*>(points.data()),
                 {static_cast<py::ssize_t>(points.size()), 3}, owner);
}
inline py::array view_of(const std::vector<Rgb>& colors, const py::handle& owner) {
  return view_of(reinterpret_cast<const std::uint8_t*>(colors.data()),
                 {static_cast<py::ssize_t>(colors.size()), 3}, owner);
}
inline py::array view_of(const DepthImage& image, const py::handle& owner) {
  return view_of(image.pixels.data(), {image.height, image.width}, owner);
}
inline py::array view_of(const ColorImage& image, const py::handle& owner) {
  return view_of(reinterpret_cast<const std::uint8_t*>(image.pixels.data()),
                 {image.height, image.width, 3}, owner);
}

template <class T>
using Packed = py::array_t<T, py::array::c_style | py::array::forcecast>;

/// The array's numbers as T, one behind the other. Raises turnscan.Error where numpy would cast
/// silently: text, complex numbers, and what an integer T does not hold.
template <class T>
Packed<T> packed(const py::array& given, const char* name) {
  const char kind = given.dtype().kind();
  if (kind == 'u' || kind == 'i' || kind == 'b' || kind == 'f') {
    Packed<T> out(given);
    if (std::is_floating_point_v<T> || given.dtype().is(py::dtype::of<T>()) ||
        py::cast<bool>(out.attr("__eq__")(given).attr("all")()))
      return out;
  }
  const char* const wanted = std::is_floating_point_v<T> ? "real numbers are needed"
                             : sizeof(T) == 1            ? "whole numbers from 0 to 255 are needed"
                                              : "whole numbers from 0 to 4294967295 are needed";
  raise({ErrorCode::kFormat, fmt::format("{}: {}", name, wanted), ""});
}

/// A pose as 4x4 matrix, and back; None is nullopt. Raises turnscan.Error for what is no pose.
py::object matrix_of(const std::optional<Pose>& pose);
std::optional<Pose> pose_of(const py::object& matrix);

}  // namespace turnscan::python
