#pragma once
// Traces packets of 16 rays, a kernel (core/simd/kernel_choice.hpp).

#include <cstddef>
#include <cstdint>
#include <turnscan/core/simd/kernel_choice.hpp>
#include <turnscan/geometry/rays/embree.hpp>
#include <turnscan/geometry/rays/triangle_clusters.hpp>

namespace turnscan::sampling {

inline constexpr std::uint32_t kObjectBits = 24;  ///< of a surface id; the body is above them
inline constexpr std::uint32_t kPlatterObject = 0xfffffe;

/// Pixels [left, right) x [top, bottom).
struct Window {
  int left = 0, top = 0, right = 0, bottom = 0;
};

/// A body as seen from one pose of the sensor.
struct BodyView {
  RTCScene scene = nullptr;
  const ObjectView* objects = nullptr;
  Clusters clusters;                     ///< for drawing; else empty
  std::uint32_t first_slot = 0;          ///< index of its first slot among those of all bodies
  float platter_radius_squared = -1.0f;  ///< negative: there is none
  std::uint32_t id = 0;                  ///< index in the bodies << kObjectBits
  Window frame;                          ///< outside of it no pixel sees the body
  float rotation[9] = {};                ///< body <- sensor, row by row
  float origin[3] = {};                  ///< of the rays, body frame
  float other[3] = {};                   ///< the other eye, body frame
};

/// Data that all packets of one pose share.
struct View {
  const BodyView* bodies = nullptr;
  int body_count = 0;
  bool two_eyed = false;
  float other[3] = {};  ///< the other eye, sensor frame
  int blocked = 0;      ///< the miss of samples that it does not see
  float near_m = 0.0f, far_m = 0.0f;
  float least_cosine = 0.0f;
  float size = 0.0f;  ///< largest coordinate of an origin

  // Where the other eye lies beside the origin along the rows or columns of an image without
  // distortion (see sample_occlusion.hpp); baseline = 0: elsewhere.
  float baseline = 0.0f;            ///< its coordinate there, m
  bool baseline_along_rows = true;  ///< or along the columns
  float pixel = 0.0f;               ///< spacing of the samples there, in directions
  float border_nearness = 0.0f;  ///< 1 / depth of the nearest surface beyond that border; 0: none

  // For drawing: the camera, without distortion.
  float fx = 0.0f, fy = 0.0f, cx = 0.0f, cy = 0.0f;
};

/// Directions (x, y, 1) of the pixels: x[v * x_row + u], y[v * y_row + u * y_column]. NaN: no ray.
struct Directions {
  const float *x = nullptr, *y = nullptr;
  std::ptrdiff_t x_row = 0, y_row = 0, y_column = 0;
};

/// See Samples.
struct Output {
  float* z = nullptr;
  std::uint32_t *surface = nullptr, *triangle = nullptr;
  std::uint8_t* miss = nullptr;
};

/// A group that may be in the image.
struct GroupView {
  std::uint32_t group = 0;
  float nearness = 0.0f;  ///< upper bound of 1 / depth of its nearest corner
  Window frame;           ///< outside of it no pixel sees any of it
};

/// Memory for drawing. Its frame contains the image's and may extend beyond it, where it only tells
/// what may occlude samples of the image from the other eye.
struct Canvas {
  Window frame;
  float* nearness = nullptr;       ///< 1 / depth; one per pixel and kLanes more
  std::uint32_t* slot = nullptr;   ///< the same number
  float* tiles = nullptr;          ///< one per tile of kTile x kTile and kLanes more
  GroupView* seen = nullptr;       ///< one per group of the largest body
  std::uint32_t* order = nullptr;  ///< the same number
};
inline constexpr int kTile = 8;

struct SampleKernel {
  /// The pixels of the frame, row by row without gaps, in packets of tile_width columns (1, 2, 4).
  void (*trace_image)(const View& view, const Directions& directions, const Window& frame,
                      int tile_width, const Output& out);
  /// n rays in the order given.
  void (*trace_list)(const View& view, const float* x, const float* y, std::size_t n,
                     const Output& out);
  /// As trace_image, but rasterises the triangles instead of tracing.
  void (*draw_image)(const View& view, const Directions& directions, const Window& frame,
                     const Canvas& canvas, const Output& out);
};
using SampleKernels = KernelChoice<SampleKernel>;

}  // namespace turnscan::sampling
