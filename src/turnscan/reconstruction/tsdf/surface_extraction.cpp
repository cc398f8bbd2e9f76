#include <turnscan/reconstruction/tsdf/no_return_hull.hpp>
#include <turnscan/reconstruction/tsdf/surface_extraction.hpp>

namespace turnscan::tsdf {

UnseenSpace::UnseenSpace(const Volume& volume)
    : origin_m_(volume.origin_m),
      cell_m_(volume.cell_m),
      bricks_(volume.bricks),
      samples_(unseen_samples(volume)) {}

bool UnseenSpace::contains(const Vec3f& p) const {
  const Vec3d at = (p.cast<double>() - origin_m_) / cell_m_;
  const GridCoords& bricks = bricks_.size();
  GridCoords first;
  for (int k = 0; k < 3; ++k) {
    if (!(at[k] >= 0.0) || at[k] >= double(bricks[std::size_t(k)] * kBrickSide - 1)) return false;
    first[std::size_t(k)] = int(at[k]);
  }
  double share = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    GridCoords s;
    double weight = 1.0;
    for (int k = 0; k < 3; ++k) {
      const int next = corner >> k & 1;
      s[std::size_t(k)] = first[std::size_t(k)] + next;
      const double along = at[k] - double(first[std::size_t(k)]);
      weight *= next == 1 ? along : 1.0 - along;
    }
    const std::size_t c = sample_in_brick(s[0], s[1], s[2]);
    const BrickBits& brick = samples_.brick(bricks_.at({s[0] >> 3, s[1] >> 3, s[2] >> 3}));
    if (tsdf::contains(brick, c)) share += weight;
  }
  return share >= 0.5;
}

Result<ExtractedSurface> extract_surface(const Integrator& integrator, const VolumeScale& scale,
                                         std::span<const views::DepthView> views, Box box,
                                         std::vector<StageTime>& times, const RunContext& context) {
  const double rim = scale.truncation_m + 4.0 * scale.cell_m;
  box.min.array() -= rim;
  box.max.array() += rim;
  if (scale.floor_m) box.min.y() = -0.25 * scale.cell_m;  // the lowest layer is at -0.5
  TURNSCAN_ASSIGN(Volume volume, timed(times, "distances",
                                       [&] { return integrator.extract_volume(box, context); }));
  TURNSCAN_ASSIGN(const SampleBits hull, timed(times, "no return", [&] {
                    return no_return_hull(volume, views, context);
                  }));
  ClusterScale marched;
  marched.origin_m = volume.origin_m;
  marched.cell_m = volume.cell_m;
  if (scale.floor_m || !scale.platters.empty()) marched.flat_m = 0.0f;
  ExtractedSurface out{{}, marched, UnseenSpace(volume), {}};
  const auto close = [&]() -> Result<> {
    TURNSCAN_TRY(smooth(volume, 1, context));
    set_inside(volume, hull);
    if (scale.floor_m) {
      const int floor = floor_layer(volume, *scale.floor_m);
      out.foot = {TaperedFoot(volume, floor), MeasuredFloors(volume, floor)};
    }
    return close_holes(volume, scale, out.foot, context);
  };
  TURNSCAN_TRY(timed(times, "closing", close));
  TURNSCAN_TRY(context.check());
  const auto march = [&]() -> Result<TriangleMesh> {
    TURNSCAN_ASSIGN(const BrickGrid grid, to_grid(volume, std::size_t(2) << 30));
    return isosurface(grid, MarchingCells::kTetrahedra, context);
  };
  TURNSCAN_ASSIGN(out.mesh, timed(times, "extraction", march));
  return out;
}

}  // namespace turnscan::tsdf
