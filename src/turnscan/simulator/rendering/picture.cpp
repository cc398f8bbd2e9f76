#include <algorithm>
#include <numbers>
#include <turnscan/core/angles.hpp>
#include <turnscan/simulator/rendering/painter.hpp>
#include <turnscan/simulator/rendering/picture.hpp>

namespace turnscan {

namespace {

std::vector<rendering::ViewSetup> views_around(const std::vector<Vec3f>& points,
                                               const PictureOptions& o) {
  std::vector<rendering::ViewSetup> views;
  for (int i = 0; i < o.views; ++i) {
    const double azimuth = o.azimuth_rad + kTurn * i / o.views;
    views.push_back({rendering::camera_around(points, azimuth, o.elevation_rad, o.field_of_view_rad,
                                              double(o.width) / o.height, o.zoom),
                     rendering::light_for(azimuth)});
  }
  return views;
}

}  // namespace

OptionTable describe(PictureOptions& o) {
  constexpr double kPi = std::numbers::pi;
  OptionTable table;
  table.number("picture-width", o.width, {1, 16384}, "Width of one view of the picture in pixels.")
      .number("picture-height", o.height, {1, 16384}, "Height of the picture in pixels.")
      .number("picture-azimuth", o.azimuth_rad, Quantity::kAngle, {-2 * kPi, 2 * kPi},
              "Where the picture is seen from: 0 is the front (+Z), 90 deg the +X side.")
      .number("picture-elevation", o.elevation_rad, Quantity::kAngle, {-kPi / 2, kPi / 2},
              "Height above the horizontal that the picture is seen from.")
      .number("picture-views", o.views, {1, 64}, "Views side by side, spread over the full circle.")
      .number("picture-field-of-view", o.field_of_view_rad, Quantity::kAngle, {0.01, 2.5},
              "Vertical field of view of the picture.")
      .number("picture-zoom", o.zoom, Quantity::kNone, {0.05, 100.0},
              "Zoom: above 1 the picture shows less than the whole object.")
      .flag("picture-ground", o.ground, "A floor in the picture that catches shadows.")
      .flag("picture-smooth", o.smooth, "Interpolated normals in the picture.")
      .flag("picture-colours", o.use_colors, "Textures and vertex colours in the picture.")
      .number("picture-samples", o.ambient_samples, {0, 1024},
              "Rays of ambient occlusion for each of a pixel's four samples.");
  return table;
}

Result<ColorImage> render_picture(std::span<const TriangleMesh> meshes,
                                  const PictureOptions& options, const RunContext& context) {
  TURNSCAN_ASSIGN(const rendering::Subject subject,
                  rendering::Subject::create(meshes, options, context));
  ColorImage image(options.width * options.views, options.height, options.background);
  if (subject.scene.object_box().empty()) return image;
  const std::vector<rendering::ViewSetup> views = views_around(subject.points, options);
  context.begin_phase("render picture", std::uint64_t(options.height) * views.size());
  for (int v = 0; v < options.views; ++v)
    rendering::paint_view(subject, options, views[std::size_t(v)], v,
                          std::size_t(v) * std::size_t(options.width), image, context);
  TURNSCAN_TRY(context.check());
  return image;
}

ColorImage side_by_side(std::span<const ColorImage> images, Rgb fill) {
  int width = 0, height = 0;
  for (const ColorImage& image : images) {
    width += image.width;
    height = std::max(height, image.height);
  }
  ColorImage out(width, height, fill);
  int left = 0;
  for (const ColorImage& image : images) {
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) out.at(left + x, y) = image.at(x, y);
    left += image.width;
  }
  return out;
}

}  // namespace turnscan
