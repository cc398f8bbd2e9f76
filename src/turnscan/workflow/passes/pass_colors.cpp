#include <turnscan/workflow/passes/pass_colors.hpp>

#include <algorithm>
#include <map>
#include <turnscan/core/frame_samples.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/reconstruction/frame_batch.hpp>
#include <turnscan/reconstruction/passes/surface_colors.hpp>

namespace turnscan {

namespace {

/// Each point is then seen about a dozen times.
constexpr std::size_t kMaxFrames = 36;
constexpr double kAround_m = 0.01;  // margin around the objects that is considered

Box box_around(const std::vector<passes::PassSurface>& objects) {
  Box box;
  for (const passes::PassSurface& object : objects)
    for (const Vec3f& p : object.points) box.add(p.cast<double>());
  box.min.array() -= kAround_m;
  box.max.array() += kAround_m;
  return box;
}

class ColoredViews {
 public:
  ColoredViews(const FrameSequence& frames, const Box& box)
      : frames_(frames), box_(box), rays_(ray_tables(frames.header())) {}

  Result<std::vector<views::DepthView>> read(const RunContext& context) const {
    const auto chosen = evenly_spread(usable_frames(frames_), kMaxFrames);
    std::vector<views::DepthView> out(chosen.size());
    const auto make = [&](std::size_t k, const Frame& frame) -> Result<> {
      TURNSCAN_ASSIGN(out[k], view(frame));
      return {};
    };
    TURNSCAN_TRY(read_frames(frames_, chosen, context, make));
    std::erase_if(out, [](const views::DepthView& view) { return view.colors.empty(); });
    return out;
  }

 private:
  Result<views::DepthView> view(const Frame& frame) const {
    if (frame.color.empty() && frame.points.colors.empty()) return views::DepthView();
    const std::size_t sensor = frame.info.sensor;
    const Pose T = frame.info.T_table_sensor.value_or(Pose::Identity());
    views::ViewScale scale;
    scale.colored = true;
    return views::make_view(
        frame, frames_.header().sensors[sensor], rays_[sensor], T, scale, [&](const Vec3f& p) {
          const Vec3d at = T * p.cast<double>();
          return (at.array() >= box_.min.array()).all() && (at.array() <= box_.max.array()).all();
        });
  }

  const FrameSequence& frames_;
  Box box_;
  std::vector<RayTable> rays_;
};

}  // namespace

Result<> color_surfaces(const SequencePass& pass, std::vector<passes::PassSurface>& objects,
                        const RunContext& context) {
  if (objects.empty()) return {};
  TURNSCAN_ASSIGN(const SequenceView frames, join_passes({pass}));
  TURNSCAN_ASSIGN(const auto views, ColoredViews(frames, box_around(objects)).read(context));
  for (passes::PassSurface& object : objects) {
    TURNSCAN_ASSIGN(object.colors, passes::surface_colors(object, views, context));
  }
  return {};
}

}  // namespace turnscan
