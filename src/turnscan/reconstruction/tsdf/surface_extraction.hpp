#pragma once

#include <turnscan/geometry/mesh/merge_clustered_vertices.hpp>
#include <turnscan/reconstruction/stage_timer.hpp>
#include <turnscan/reconstruction/tsdf/integrator.hpp>
#include <turnscan/reconstruction/tsdf/platter_columns.hpp>
#include <turnscan/reconstruction/tsdf/sample_bits.hpp>

namespace turnscan::tsdf {

/// Unobserved space: neither surface nor free space, nor behind a measured surface.
class UnseenSpace {
 public:
  /// volume: its holes must not be closed yet.
  explicit UnseenSpace(const Volume& volume);
  /// Decided by the majority of the eight samples around p; false beyond the volume.
  bool contains(const Vec3f& p) const;

 private:
  Vec3d origin_m_;
  double cell_m_;
  GridIndex bricks_;
  SampleBits samples_;
};

struct ExtractedSurface {
  TriangleMesh mesh;  ///< closed, 2-manifold, outward; may be empty
  ClusterScale grid;  ///< grid on which it was marched
  UnseenSpace unseen;
  Foot foot;
};

/// The zero set of the integrated data in and around the box, after forget_doubtful_surface(),
/// smoothed, with its holes closed: space that the views observed without a return is inside
/// (no_return_hull()), the rest is left to close_holes(). Adds to the seconds of the stages
/// "distances", "closing" and "extraction". Fails with kResourceLimit, kCancelled.
Result<ExtractedSurface> extract_surface(const Integrator& integrator, const VolumeScale& scale,
                                         std::span<const views::DepthView> views, Box box,
                                         std::vector<StageTime>& times, const RunContext& context);

}  // namespace turnscan::tsdf
