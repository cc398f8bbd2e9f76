#pragma once

#include <turnscan/geometry/mesh/even_out.hpp>
#include <turnscan/reconstruction/stage_timer.hpp>
#include <turnscan/reconstruction/tsdf/integrator.hpp>

namespace turnscan::tsdf {

struct ExtractedSurface {
  TriangleMesh mesh;  ///< closed, 2-manifold, outward; may be empty
  EvenOutScale grid;  ///< that it was marched on
};

/// The zero set of what was integrated in and around the box, smoothed, its holes closed. Adds to
/// the seconds of the stages "distances", "closing" and "extraction". Fails with kResourceLimit,
/// kCancelled.
Result<ExtractedSurface> extract_surface(const Integrator& integrator, const VolumeScale& scale,
                                         Box box, std::vector<StageTime>& times,
                                         const RunContext& context);

}  // namespace turnscan::tsdf
