#pragma once
// From a raw depth image to the visible surface of the object.

#include <turnscan/turntable/motion_input/foreground.hpp>

namespace turnscan::motion {

/// The foreground of a depth image and the indices of its pixels in z, ascending.
struct DepthForeground {
  FrameSurface surface;
  std::vector<std::int32_t> pixels;
  std::vector<std::uint8_t> covered;  ///< as in FrameSurface, with z's shape
};

/// Pixels of the foreground, in metres. All members are empty if the image does not have the
/// camera's size.
DepthForeground extract_foreground(const DepthImage& depth, const SensorInfo& sensor,
                                   const CameraIntrinsics& camera, const RayTable& rays,
                                   const Foreground& foreground);

/// Drops pixels that are well behind a neighbour: they may be mixed from two surfaces.
void drop_mixed_pixels(DepthForeground& depth, double fx, double noise_m);

/// Noise moves points sideways in the other frames' images, where every convex surface then appears
/// deeper. A quadratic surface through 5 x 5 pixels (Savitzky and Golay 1964) removes most of it
/// and preserves curvature. Pixels without a complete window are unchanged.
void smooth_depth(DepthForeground& depth, double fx, double noise_m);

/// Between pixels find_correspondence() follows chords, which are behind a convex surface: on
/// average by a twelfth of the second difference in each direction. Moves the pixels by as much the
/// other way. Second differences are those of the quadratic surface through 5 x 5 pixels.
void correct_chord_sag(DepthForeground& depth, double fx, double noise_m);

/// A sensor that averages over 3 x 3 pixels (Kinect v2) displaces curved surfaces by half the
/// variance of that window, two thirds of a pixel squared, times the second difference in each
/// direction. Moves the pixels back by as much.
void correct_filter_sag(DepthForeground& depth, double fx, double noise_m);

/// The surface without empty margins. covered: depth.covered, for a surface that keeps it and the
/// pixels that it marks; or empty.
FrameSurface trimmed(const DepthForeground& depth, const std::vector<std::uint8_t>& covered = {});

/// Sets surface.inner, which excludes the pixels along outlines and depth steps, where a pixel
/// mixes the surface with what is beyond. Behind a Kinect v2's filter over 3 x 3 pixels, depth
/// there has a mean error of a third of its noise, everywhere towards the same side. A second row
/// of pixels is excluded if enough remain.
void mark_inner(FrameSurface& surface, double fx, double noise_m);

/// Drops the pixels that are not inner ones.
void drop_outline(DepthForeground& depth, double fx, double noise_m);

}  // namespace turnscan::motion
