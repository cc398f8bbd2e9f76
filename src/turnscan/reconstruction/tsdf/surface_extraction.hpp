#pragma once

#include <turnscan/geometry/mesh/merge_clustered_vertices.hpp>
#include <turnscan/reconstruction/stage_timer.hpp>
#include <turnscan/reconstruction/tsdf/integrator.hpp>
#include <turnscan/reconstruction/tsdf/sample_bits.hpp>
#include <turnscan/reconstruction/tsdf/tapered_foot.hpp>

namespace turnscan::tsdf {

/// Where no view looked: neither surface nor free space, nor behind what was measured.
class UnseenSpace {
 public:
  /// Of a volume whose holes are not closed.
  explicit UnseenSpace(const Volume& volume);
  /// By most of the eight samples around; false beyond the volume.
  bool contains(const Vec3f& p) const;

 private:
  Vec3d origin_m_;
  double cell_m_;
  GridIndex bricks_;
  SampleBits samples_;
};

struct ExtractedSurface {
  TriangleMesh mesh;  ///< closed, 2-manifold, outward; may be empty
  ClusterScale grid;  ///< that it was marched on
  UnseenSpace unseen;
  TaperedFoot round;
};

/// The zero set of what was integrated in and around the box, but for forget_doubtful_surface(),
/// smoothed, its holes closed: what the
/// views looked at in vain is inside (no_return_hull()), the rest is close_holes()'s. Adds to
/// the seconds of the stages "distances", "closing" and "extraction". Fails with kResourceLimit,
/// kCancelled.
Result<ExtractedSurface> extract_surface(const Integrator& integrator, const VolumeScale& scale,
                                         std::span<const views::DepthView> views, Box box,
                                         std::vector<StageTime>& times, const RunContext& context);

}  // namespace turnscan::tsdf
