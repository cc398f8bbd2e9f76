#pragma once
// The surface of an object as spots that represent it when many sensor placements are evaluated.

#include <array>
#include <cstdint>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan::planning {

/// A point of a spot; frame of the mesh.
struct SpotPoint {
  Vec3f p = Vec3f::Zero(), normal = Vec3f::UnitY();  ///< unit, towards the open side
};

/// One cell of the coverage map (CoverageCell), sampled in proportion to its area.
struct Spot {
  SpotPoint middle;               ///< on its largest patch
  std::uint32_t first_other = 0;  ///< index of its further points in PlanSurface::others
  std::uint32_t others = 0;
  float cell_m2 = 0.0f;          ///< of the cell
  std::uint8_t albedo_step = 0;  ///< one of kAlbedoSteps
  /// Deviation of the surface from the mean of its neighbourhood, in radii kReliefRadii_m.
  std::array<float, 3> relief_m{};
};
inline constexpr std::array<double, 3> kReliefRadii_m{1.5e-3, 3e-3, 6e-3};
inline constexpr int kAlbedoLevels = 16;

struct PlanSurface {
  std::vector<Spot> spots;  ///< each represents the same area
  std::vector<SpotPoint> others;
  double area_m2 = 0.0;
  double cell_m = 0.0;
};

struct SurfaceSampling {
  double cell_m = 3e-3;      ///< as CoverageMapOptions::cell_m
  std::size_t spots = 3000;  ///< maximum; fewer if there are fewer cells
};

/// The mesh as it stands in the first pass. A spot faces the side from which it is visible; the
/// front if both sides or neither are. Deterministic. Fails with kTooFewPoints without a face, with
/// kCancelled, and as Scene::create().
Result<PlanSurface> sample_plan_surface(const TriangleMesh& mesh, const SurfaceSampling& sampling,
                                        const RunContext& context);

}  // namespace turnscan::planning
