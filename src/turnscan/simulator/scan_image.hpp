#pragma once
// Converts samples to frames.

#include <turnscan/core/frame.hpp>
#include <turnscan/simulator/noise/noise.hpp>
#include <turnscan/simulator/sampling/samples.hpp>

namespace turnscan::sampling {

/// z: over the grid's rect, metres, 0 for no return. Rounded to the unit; values that do not fit 16
/// bits become no return.
DepthImage depth_image(const SampleGrid& grid, std::span<const float> z, double unit_m);

/// Colour of a hit from the mesh's texture or its triangle's vertices; meshes[body][object]. Grey
/// without colours.
class Paint {
 public:
  explicit Paint(std::vector<std::span<const TriangleMesh>> meshes) : meshes_(std::move(meshes)) {}

  /// sRGB.
  Vec3f color(const Samples& samples, std::size_t i, const SampleHit& hit) const;

 private:
  std::vector<std::span<const TriangleMesh>> meshes_;
};

/// Albedo of the same meshes for a sensor's light.
Albedo albedo_of(const std::vector<std::span<const TriangleMesh>>& meshes);

/// Lit from the sensor. Colours everything that is hit, whether the sample counts or not.
ColorImage color_image(const SampleTracer& tracer, std::span<const Body> bodies,
                       const Pose& T_world_sensor, const SampleGrid& grid, const Paint& paint);

/// Mean of images of one size, rounded. Precondition: there is at least one.
ColorImage mean_image(std::span<const ColorImage> images);

/// The samples with a return, in the order of the grid; with colours if paint is given.
PointCloud scan_points(const SampleTracer& tracer, std::span<const Body> bodies,
                       const Pose& T_world_sensor, const SampleGrid& grid, std::span<const float> z,
                       const Paint* paint);

}  // namespace turnscan::sampling
