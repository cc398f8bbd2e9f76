#pragma once
// Images of the colour camera of a virtual depth camera.

#include <span>
#include <turnscan/core/image.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/simulator/color/color_camera.hpp>
#include <turnscan/simulator/sampling/samples.hpp>

namespace turnscan::sampling {

/// sRGB of a point on a mesh: from its texture, its vertices, or grey.
Vec3f surface_color(const TriangleMesh& mesh, std::uint32_t triangle, float u, float v);
/// sRGB of the platter.
Vec3f platter_color();

/// Immutable; all members may be called from several threads at once.
class ColorCamera {
 public:
  /// meshes[body][object] must outlive it. Precondition: options.width > 0.
  static Result<ColorCamera> create(const ColorCameraOptions& options,
                                    std::vector<std::span<const TriangleMesh>> meshes);

  /// Linear light at one moment, without exposure and noise; 2 x 2 samples per pixel. Lamp and
  /// shadows are fixed in the world.
  Image<Vec3f> light(std::span<const Body> bodies, const Pose& T_world_sensor) const;

  /// The resulting image: exposure and white balance of the frame, vignetting, sRGB, noise. key: of
  /// the frame's random numbers.
  ColorImage exposed(const Image<Vec3f>& light, std::uint64_t key) const;

 private:
  ColorCamera(const ColorCameraOptions& options, SampleTracer tracer,
              std::vector<std::span<const TriangleMesh>> meshes);
  struct SeenBody;
  struct LampSample;
  LampSample sample_of(std::span<const Body> bodies, std::span<const SeenBody> seen,
                       const SampleGrid& grid, std::size_t i, const Vec3d& direction) const;
  void cast_shadows(std::span<const Body> bodies, std::span<const SeenBody> seen,
                    std::vector<LampSample>& samples) const;
  Vec3f lit(const LampSample& sample, const Vec3f& eye_world) const;

  ColorCameraOptions options_;
  SampleTracer tracer_;
  std::vector<std::span<const TriangleMesh>> meshes_;
  Vec3f to_lamp_;
};

}  // namespace turnscan::sampling
