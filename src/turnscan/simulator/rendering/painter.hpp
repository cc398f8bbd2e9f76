#pragma once
// Renders lit meshes row by row.

#include <span>
#include <turnscan/geometry/rays/scene.hpp>
#include <turnscan/simulator/rendering/picture.hpp>
#include <turnscan/simulator/rendering/picture_camera.hpp>
#include <turnscan/simulator/rendering/picture_surface.hpp>
#include <vector>

namespace turnscan::rendering {

/// Meshes prepared for any number of pictures; refers to them.
struct Subject {
  Scene scene;
  std::vector<PictureSurface> surfaces;
  std::vector<Vec3f> points;  ///< vertices of triangles

  /// Fails with kInvalidOption, and as Scene::create() does.
  static Result<Subject> create(std::span<const TriangleMesh> meshes, const PictureOptions& options,
                                const RunContext& context);
};

struct ViewSetup {
  PictureCamera camera;
  Vec3f to_light;
};

/// The key light, from the upper left of a viewer at that azimuth.
Vec3f light_for(double azimuth_rad);

/// Renders a view of options.width columns into the image, starting at first_column. view: selects
/// the random numbers of its soft shadows. Progress counts rows; a cancelled view is left
/// incomplete.
void paint_view(const Subject& subject, const PictureOptions& options, const ViewSetup& setup,
                int view, std::size_t first_column, ColorImage& image, const RunContext& context);

}  // namespace turnscan::rendering
