#pragma once
// Why a picture of a textured object errs: what kind of place each pixel shows.

#include <turnscan/core/image.hpp>
#include <turnscan/simulator/virtual_scan.hpp>

namespace turnscan::bench {

enum class PixelKind : std::uint8_t {
  kNone,    ///< nothing of the object, or not looked at: every third pixel of every third row is
  kRim,     ///< 2 pixels about a step in depth or the silhouette
  kUnseen,  ///< no frame saw the place
  kFlat,    ///< none more upright than 60 deg
  kWell
};
inline constexpr std::size_t kPixelKinds = 5;

/// Colour cameras in the frame of an object at angle 0.
std::vector<Pose> color_cameras(const VirtualScan& scan, const ColorCameraOptions& camera);

/// Of a picture that such a camera takes of scan's objects; eyes: of the frames that the texture
/// was made from, in the same frame.
Image<PixelKind> pixel_kinds(const VirtualScan& scan, const ColorCameraOptions& camera,
                             const Pose& T_object_camera, const std::vector<Vec3d>& eyes);

}  // namespace turnscan::bench
