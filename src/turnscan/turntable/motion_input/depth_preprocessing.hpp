#pragma once
// From a raw depth image to the surface of the object in it.

#include <turnscan/turntable/motion_input/foreground.hpp>

namespace turnscan::motion {

/// The foreground of a depth image and the positions of its pixels in z, ascending.
struct DepthForeground {
  FrameSurface surface;
  std::vector<std::int32_t> pixels;
  std::vector<std::uint8_t> covered;  ///< as FrameSurface has it, of z's shape
};

/// Pixels of the foreground, in metres. All are empty when the image is not of the camera's size.
DepthForeground extract_foreground(const DepthImage& depth, const SensorInfo& sensor,
                                   const CameraIntrinsics& camera, const RayTable& rays,
                                   const Foreground& foreground);

/// Drops pixels that lie well behind a neighbour: they may be mixed of two surfaces.
void drop_mixed_pixels(DepthForeground& depth, double fx, double noise_m);

/// Noise moves points sideways in the other frames' images, where every convex surface then seems
/// to lie deeper. A quadratic surface through 5 x 5 pixels (Savitzky and Golay 1964) takes most of
/// it away and leaves curvature alone. Where the window is not whole the pixel stays.
void smooth_depth(DepthForeground& depth, double fx, double noise_m);

/// Between pixels find_correspondence() follows chords, which lie behind a convex surface: by a
/// twelfth of the second difference in the mean, in each direction. The pixels move by as much the
/// other way. Second differences are those of the quadratic surface through 5 x 5 pixels.
void correct_chord_sag(DepthForeground& depth, double fx, double noise_m);

/// A sensor that averages over 3 x 3 pixels (Kinect v2) shows curved surfaces displaced: by half
/// the variance of that window, two thirds of a pixel squared, times the second difference in each
/// direction. The pixels move back by as much.
void correct_filter_sag(DepthForeground& depth, double fx, double noise_m);

/// The surface without margins that show nothing. covered: depth.covered, for a surface that is to
/// keep it and the pixels that it marks; or empty.
FrameSurface trimmed(const DepthForeground& depth, const std::vector<std::uint8_t>& covered = {});

/// Sets surface.inner: not the pixels along outlines and depth steps, since what a pixel beside one
/// shows is mixed with what lies beyond. Behind a Kinect v2's filter over 3 x 3 pixels depth there
/// is off by a third of its noise in the mean, everywhere to the same side. A second row of pixels
/// is left out where enough remain.
void mark_inner(FrameSurface& surface, double fx, double noise_m);

/// Drops the pixels that are not inner ones.
void drop_outline(DepthForeground& depth, double fx, double noise_m);

}  // namespace turnscan::motion
