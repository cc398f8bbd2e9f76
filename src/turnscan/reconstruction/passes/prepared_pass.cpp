#include <cmath>
#include <numeric>
#include <turnscan/reconstruction/passes/prepared_pass.hpp>

namespace turnscan::passes {

namespace {

constexpr std::size_t kVoting = 350, kCoarse = 500, kMedium = 4000;
/// What lies nearer than this in front of a surface may be its noise, or the mesh's smoothing.
constexpr double kFreeSigmas = 3.0, kFreeLeast = 0.001;

double extent(const PassSurface& surface) { return bounds(surface.points).size().norm(); }

}  // namespace

SurfaceLevel::SurfaceLevel(const PassSurface& surface, std::size_t count, int side,
                           double reach_share)
    : samples(thinned(surface, count)),
      reach_m(reach_share * extent(surface)),
      nearest(samples, side, reach_m) {}

PreparedPass::PreparedPass(const PassSurface& pass)
    : surface(&pass),
      extent_m(extent(pass)),
      area_m2(std::accumulate(pass.areas.begin(), pass.areas.end(), 0.0)),
      votes(pass, kVoting, 1, 0.0),
      coarse(pass, kCoarse, 48, 0.12),
      medium(pass, kMedium, 72, 0.03),
      free(pass, kFreeSigmas * pass.noise_m + kFreeLeast),
      tree(pass.points),
      beside_m(float(1.3 * std::sqrt(area_m2 / double(pass.points.size())))) {}

}  // namespace turnscan::passes
