#pragma once
// Shaded pictures of meshes for display.

#include <optional>
#include <span>
#include <turnscan/core/image.hpp>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan {

struct PictureOptions {
  int width = 900;                             ///< pixels of one view
  int height = 900;                            ///< pixels
  double azimuth_rad = 0.6108652381980153;     ///< 35 deg: from +Z towards +X; 0 looks at the front
  double elevation_rad = 0.29670597283903605;  ///< 17 deg above the horizontal
  int views = 1;  ///< side by side, with azimuths evenly spread over the full circle
  double field_of_view_rad = 0.4363323129985824;  ///< 25 deg, vertical
  double zoom = 1.0;           ///< above 1: closer than needed to show all of the meshes
  bool ground = true;          ///< a floor below the meshes that receives their shadow
  bool smooth = true;          ///< interpolated normals; edges above 40 deg stay sharp
  bool use_colors = true;      ///< textures, or vertex colours, if a mesh has them
  Rgb surface{204, 196, 184};  ///< of meshes without colours
  Rgb background{255, 255, 255};
  int ambient_samples = 8;  ///< rays per sample (four samples per pixel) for ambient occlusion
};

OptionTable describe(PictureOptions& options);

/// A perspective view that frames all meshes, +Y up, key light from the upper left of the viewer,
/// soft ambient light, 2 x 2 samples per pixel; views * width by height pixels. Without any
/// triangle the picture is the background. Byte-identical for any number of threads. Fails with
/// kInvalidOption, kCancelled, and as Scene::create does.
Result<ColorImage> render_picture(std::span<const TriangleMesh> meshes,
                                  const PictureOptions& options,
                                  const RunContext& context = RunContext());

/// The images in a row, top aligned, with the remainder filled.
ColorImage side_by_side(std::span<const ColorImage> images, Rgb fill = {255, 255, 255});

}  // namespace turnscan
