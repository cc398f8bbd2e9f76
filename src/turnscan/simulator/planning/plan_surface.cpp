#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/rays/scene.hpp>
#include <turnscan/simulator/coverage/coverage_patches.hpp>
#include <turnscan/simulator/planning/plan_surface.hpp>
#include <unordered_map>

namespace turnscan::planning {

namespace {

constexpr std::uint32_t kMaxOthers = 6;
constexpr float kOffSurface_m = 20e-6f;
constexpr int kSideRays = 32;
constexpr double kGoldenAngle = 2.399963229728653;

using coverage::CoveragePatches;

Vec3f middle_of_patch(const CoveragePatch& patch) {
  return (patch.corners[0] + patch.corners[1] + patch.corners[2]) / 3.0f;
}

double area_of_patch(const CoveragePatch& patch) {
  return 0.5 * double((patch.corners[1] - patch.corners[0])
                          .cross(patch.corners[2] - patch.corners[0])
                          .norm());
}

/// Cells of the spots: one at each step of the area, in the cells' order. A cell larger than a step
/// has several.
std::vector<std::uint32_t> drawn_cells(const CoveragePatches& surface, std::size_t most) {
  double area = 0.0;
  for (const CoverageCell& cell : surface.cells) area += cell.area_m2;
  const std::size_t n = std::max<std::size_t>(1, most);
  std::vector<std::uint32_t> cells;
  double sum = 0.0;
  for (std::uint32_t c = 0; c < surface.cells.size(); ++c) {
    sum += surface.cells[c].area_m2;
    while (cells.size() < n && (double(cells.size()) + 0.5) * area < sum * double(n))
      cells.push_back(c);
  }
  return cells;
}

/// Patches indexed by the cube of a grid that contains them.
class PatchGrid {
 public:
  PatchGrid(const CoveragePatches& surface, double step_m) : surface_(surface), step_m_(step_m) {
    for (std::uint32_t i = 0; i < surface.patches.size(); ++i)
      cubes_[key(middle_of_patch(surface.patches[i]))].push_back(i);
  }

  /// |distance along the normal between p and the mean of the surface that faces the same way
  /// within radius|, area-weighted.
  double relief(const SpotPoint& at, double radius_m) const {
    double sum = 0.0, area = 0.0;
    const int reach = int(std::ceil(radius_m / step_m_));
    for (int x = -reach; x <= reach; ++x)
      for (int y = -reach; y <= reach; ++y)
        for (int z = -reach; z <= reach; ++z) {
          const Vec3f q = at.p + float(step_m_) * Vec3f(float(x), float(y), float(z));
          const auto found = cubes_.find(key(q));
          if (found == cubes_.end()) continue;
          for (const std::uint32_t i : found->second) {
            const CoveragePatch& patch = surface_.patches[i];
            const Vec3f way = middle_of_patch(patch) - at.p;
            const Vec3f& normal = surface_.normal(patch.object, patch.face);
            if (way.squaredNorm() > float(radius_m * radius_m) ||
                std::abs(normal.dot(at.normal)) < 0.2f)
              continue;
            const double a = area_of_patch(patch);
            sum += a * double(way.dot(at.normal)), area += a;
          }
        }
    return area > 0.0 ? std::abs(sum / area) : 0.0;
  }

 private:
  std::uint64_t key(const Vec3f& p) const {
    const auto part = [&](float v) {
      return std::uint64_t(std::int64_t(std::floor(double(v) / step_m_)) + (1 << 20)) & 0x1fffff;
    };
    return part(p.x()) << 42 | part(p.y()) << 21 | part(p.z());
  }

  const CoveragePatches& surface_;
  double step_m_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cubes_;
};

/// Whether a ray of a spiral over the hemisphere leaves the object.
bool open_side(const Scene& scene, const Vec3f& p, const Vec3f& normal) {
  const Vec3f side = normal.unitOrthogonal(), up = normal.cross(side);
  for (int i = 0; i < kSideRays; ++i) {
    const double z = (i + 0.5) / kSideRays, r = std::sqrt(1.0 - z * z), a = kGoldenAngle * i;
    Ray ray;
    ray.origin = p + kOffSurface_m * normal;
    ray.direction = float(z) * normal + float(r * std::cos(a)) * side + float(r * std::sin(a)) * up;
    if (!scene.occluded(ray)) return true;
  }
  return false;
}

SpotPoint point_of(const CoveragePatches& surface, std::uint32_t patch) {
  const CoveragePatch& it = surface.patches[patch];
  return {middle_of_patch(it), surface.normal(it.object, it.face)};
}

}  // namespace

Result<PlanSurface> sample_plan_surface(const TriangleMesh& mesh, const SurfaceSampling& sampling,
                                        const RunContext& context) {
  if (mesh.empty()) return fail(ErrorCode::kTooFewPoints, "plan: the object has no faces");
  const auto objects = std::span(&mesh, 1);
  TURNSCAN_ASSIGN(const Scene scene, Scene::create(objects));
  const CoveragePatches patches(objects, sampling.cell_m);
  PlanSurface out;
  out.cell_m = patches.cell_m;
  for (const CoverageCell& cell : patches.cells) out.area_m2 += cell.area_m2;
  if (!(out.area_m2 > 0.0))
    return fail(ErrorCode::kTooFewPoints, "plan: the object's faces have no area");
  const std::vector<std::uint32_t> cells = drawn_cells(patches, sampling.spots);
  std::vector<std::vector<std::uint32_t>> of_cell(patches.cells.size());
  for (std::uint32_t i = 0; i < patches.patches.size(); ++i)
    of_cell[patches.patches[i].cell].push_back(i);
  for (const std::uint32_t c : cells) {
    Spot& spot = out.spots.emplace_back();
    const CoveragePatch& largest = patches.patches[patches.largest[c]];
    spot.middle = point_of(patches, patches.largest[c]);
    spot.cell_m2 = float(patches.cells[c].area_m2);
    spot.albedo_step = patches.albedo_step(largest.object, largest.face);
    spot.first_other = std::uint32_t(out.others.size());
    const auto& all = of_cell[c];
    const std::size_t step = std::max<std::size_t>(1, all.size() / kMaxOthers);
    for (std::size_t k = step / 2; k < all.size() && spot.others < kMaxOthers; k += step) {
      if (all[k] == patches.largest[c]) continue;
      out.others.push_back(point_of(patches, all[k]));
      ++spot.others;
    }
  }
  const PatchGrid grid(patches, kReliefRadii_m[1]);
  context.begin_phase("surface", out.spots.size());
  TURNSCAN_TRY(parallel_for(out.spots.size(), 64, context, [&](std::size_t i) {
    Spot& spot = out.spots[i];
    const SpotPoint at = spot.middle;
    if (!open_side(scene, at.p, at.normal) && open_side(scene, at.p, -at.normal)) {
      spot.middle.normal = -at.normal;
      for (std::uint32_t k = 0; k < spot.others; ++k) {
        Vec3f& normal = out.others[spot.first_other + k].normal;
        normal = -normal;
      }
    }
    for (std::size_t r = 0; r < kReliefRadii_m.size(); ++r)
      spot.relief_m[r] = float(grid.relief(spot.middle, kReliefRadii_m[r]));
    context.advance();
  }));
  return out;
}

}  // namespace turnscan::planning
