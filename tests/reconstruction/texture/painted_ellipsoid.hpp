#pragma once
// An ellipsoid with a pattern, and pictures of it by a formula of its own: no mesh, no drawing.

#include <functional>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan::testing {

/// Half axes, metres.
Vec3d ellipsoid_axes();
TriangleMesh ellipsoid_mesh(int around);
/// sRGB of its pattern at a place, 40 to 215.
Vec3f pattern_at(const Vec3d& p);

struct EllipsoidPictures {
  int frames = 24;
  Pose T_color_sensor = Pose::Identity();        ///< where the colour camera is
  Pose given_T_color_sensor = Pose::Identity();  ///< where the header says that it is
  /// By how much it has turned further when the picture is taken than the frame says, radians.
  std::function<double(int frame)> turned = [](int) { return 0.0; };
  /// Linear light times this, per frame and channel.
  std::function<Vec3f(int frame)> gain = [](int) { return Vec3f(1.0f, 1.0f, 1.0f); };
  std::function<Vec3f(const Vec3d& p)> pattern = pattern_at;
  /// Linear light times this, for a place with this normal, from the ellipsoid's middle; both along
  /// the sensor's axes.
  std::function<float(const Vec3d& normal, const Vec3d& p)> lamp = [](const Vec3d&, const Vec3d&) {
    return 1.0f;
  };
  /// Added to the linear light of a place with this normal, both in the sensor's frame.
  std::function<float(const Vec3d& normal, const Vec3d& to_eye)> mirrored =
      [](const Vec3d&, const Vec3d&) { return 0.0f; };
  /// Added to the sRGB colour of a place with this normal, both in the sensor's frame.
  std::function<float(const Vec3d& normal, const Vec3d& to_eye)> gloss =
      [](const Vec3d&, const Vec3d&) { return 0.0f; };
};

/// Frames of a turn about +Y, each with its pose.
MemoryFrames ellipsoid_frames(const EllipsoidPictures& pictures);

}  // namespace turnscan::testing
