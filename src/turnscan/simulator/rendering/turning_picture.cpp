#include <turnscan/core/angles.hpp>
#include <turnscan/simulator/rendering/painter.hpp>
#include <turnscan/simulator/rendering/turning_picture.hpp>

namespace turnscan {

namespace {

/// The camera moves clockwise where the object turns counter-clockwise.
std::vector<rendering::ViewSetup> views_of_turn(const std::vector<Vec3f>& points,
                                                const PictureOptions& o, int frames) {
  Box box;
  for (const Vec3f& p : points) box.add(p.cast<double>());
  const Vec3d axis = box.center();
  const rendering::PictureCamera first =
      rendering::camera_around(rendering::swept_about(points, axis), o.azimuth_rad, o.elevation_rad,
                               o.field_of_view_rad, double(o.width) / o.height, o.zoom);
  std::vector<rendering::ViewSetup> views;
  for (int i = 0; i < frames; ++i) {
    const double angle = -kTurn * i / frames;
    views.push_back(
        {rendering::turned_about(first, axis, angle), rendering::light_for(o.azimuth_rad + angle)});
  }
  return views;
}

}  // namespace

OptionTable describe(TurnOptions& o) {
  OptionTable table;
  table.number("turn-frames", o.frames, {2, 3600}, "Pictures of one turn.")
      .number("turn-time", o.time_s, Quantity::kTime, {0.1, 3600.0}, "Time that one turn takes.");
  return table;
}

Result<> render_turn(std::span<const TriangleMesh> meshes, const PictureOptions& options,
                     const TurnOptions& turn, const std::function<Result<>(ColorImage)>& take,
                     const RunContext& context) {
  TurnOptions copy = turn;
  TURNSCAN_TRY(describe(copy).check());
  if (options.views != 1)
    return fail(ErrorCode::kInvalidOption,
                "picture-views: {} is more than the one view of an animation", options.views);
  TURNSCAN_ASSIGN(const rendering::Subject subject,
                  rendering::Subject::create(meshes, options, context));
  const std::vector<rendering::ViewSetup> views =
      views_of_turn(subject.points, options, turn.frames);
  context.begin_phase("render turn", std::uint64_t(options.height) * views.size());
  for (const rendering::ViewSetup& view : views) {
    ColorImage image(options.width, options.height, options.background);
    // The same random numbers for each picture, so that static parts of the floor do not flicker.
    if (!subject.scene.object_box().empty())
      rendering::paint_view(subject, options, view, 0, 0, image, context);
    TURNSCAN_TRY(context.check());
    TURNSCAN_TRY(take(std::move(image)));
  }
  return {};
}

}  // namespace turnscan
