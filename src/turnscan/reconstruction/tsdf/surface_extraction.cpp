#include <turnscan/reconstruction/tsdf/surface_extraction.hpp>

namespace turnscan::tsdf {

Result<ExtractedSurface> extract_surface(const Integrator& integrator, const VolumeScale& scale,
                                         Box box, std::vector<StageTime>& times,
                                         const RunContext& context) {
  const double rim = scale.truncation_m + 4.0 * scale.cell_m;
  box.min.array() -= rim;
  box.max.array() += rim;
  if (scale.floor_m) box.min.y() = -0.25 * scale.cell_m;  // the lowest layer is at -0.5
  TURNSCAN_ASSIGN(Volume volume, timed(times, "distances",
                                       [&] { return integrator.extract_volume(box, context); }));
  ExtractedSurface out;
  out.grid.origin_m = volume.origin_m;
  out.grid.cell_m = volume.cell_m;
  if (scale.floor_m) out.grid.flat_m = 0.0f;
  const auto close = [&]() -> Result<> {
    TURNSCAN_TRY(smooth(volume, 1, context));
    return close_holes(volume, scale, context);
  };
  TURNSCAN_TRY(timed(times, "closing", close));
  TURNSCAN_TRY(context.check());
  const auto march = [&]() -> Result<TriangleMesh> {
    TURNSCAN_ASSIGN(const BrickGrid grid, to_grid(volume, std::size_t(2) << 30));
    return isosurface(grid, IsosurfaceOptions(), context);
  };
  TURNSCAN_ASSIGN(out.mesh, timed(times, "extraction", march));
  return out;
}

}  // namespace turnscan::tsdf
