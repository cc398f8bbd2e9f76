#include <turnscan/workflow/simulation/seen_by.hpp>

#include <turnscan/geometry/rays/coverage.hpp>

namespace turnscan {

SeenTest seen_by(const Scene& scene, const FrameSequence& sequence, const RunContext& context) {
  return
      [&scene, &sequence, context](std::span<const Vec3f> points, std::span<const Vec3f> normals) {
        return seen_mask(scene, sequence, points, normals, context);
      };
}

}  // namespace turnscan
