#include <algorithm>
#include <cmath>
#include <numeric>
#include <turnscan/simulator/coverage/coverage_count.hpp>
#include <turnscan/simulator/coverage/coverage_map.hpp>
#include <unordered_map>

namespace turnscan {

namespace {

constexpr std::array<std::string_view, kCoverageStateCount> kStateNames{"covered", "thin", "missed",
                                                                        "unreachable"};

Result<> check(const coverage::CoverageJob& job, std::span<const TriangleMesh> objects) {
  CoverageMapOptions copy = job.options;
  TURNSCAN_TRY(describe(copy).check());
  if (job.scanners.empty()) return fail(ErrorCode::kInvalidOption, "coverage: there is no scanner");
  for (const CoveragePose& pose : job.poses)
    if (pose.scanner >= job.scanners.size())
      return fail(ErrorCode::kInvalidOption, "coverage: there is no scanner {}, only {}",
                  pose.scanner, job.scanners.size());
  for (const CoveragePose& pose : job.poses)
    if (pose.pass >= job.passes.size())
      return fail(ErrorCode::kInvalidOption, "coverage: there is no pass {}, only {}", pose.pass,
                  job.passes.size());
  if (std::all_of(objects.begin(), objects.end(), [](const auto& m) { return m.empty(); }))
    return fail(ErrorCode::kTooFewPoints, "coverage: the objects have no faces");
  for (const CoveragePass& pass : job.passes)
    if (objects.size() > pass.scene->object_count())
      return fail(ErrorCode::kInvalidOption, "coverage: the scene has {} objects, not {}",
                  pass.scene->object_count(), objects.size());
  return {};
}

bool empty(const CoverageCell& cell) {
  return cell.state == CoverageState::kMissed || cell.state == CoverageState::kUnreachable;
}

/// Disjoint sets of adjacent cells.
class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// The smaller index remains the root.
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a), b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// Empty cells whose patches share a corner belong to one hole.
Sets joined(const CoverageMap& map) {
  struct Hash {
    std::size_t operator()(const std::array<float, 3>& p) const {
      std::size_t h = 0;
      for (const float x : p) h = (h ^ std::hash<float>()(x)) * 0x9e3779b97f4a7c15ULL;
      return h ^ (h >> 29);
    }
  };
  Sets sets(map.cells.size());
  std::unordered_map<std::array<float, 3>, std::uint32_t, Hash> at;
  for (const CoveragePatch& patch : map.patches) {
    if (!empty(map.cells[patch.cell])) continue;
    for (const Vec3f& p : patch.corners) {
      const auto [place, is_new] = at.try_emplace({p.x(), p.y(), p.z()}, patch.cell);
      if (!is_new) sets.join(place->second, patch.cell);
    }
  }
  return sets;
}

struct HoleSum {
  CoverageHole hole;
  Box box;
  std::array<double, kMissCount> reasons{};
  std::uint32_t root = 0;
};

std::vector<HoleSum> sums_of(const CoverageMap& map, Sets& sets) {
  std::vector<std::uint32_t> place(map.cells.size(), 0xffffffffu);
  std::vector<HoleSum> sums;
  for (std::uint32_t c = 0; c < map.cells.size(); ++c) {
    const CoverageCell& cell = map.cells[c];
    if (!empty(cell)) continue;
    const std::uint32_t root = sets.root(c);
    if (place[root] == 0xffffffffu) {
      place[root] = static_cast<std::uint32_t>(sums.size());
      sums.emplace_back().root = root;
    }
    HoleSum& sum = sums[place[root]];
    sum.hole.area_m2 += cell.area_m2;
    sum.hole.center += cell.area_m2 * cell.center;
    sum.reasons[static_cast<std::size_t>(cell.reason)] += cell.area_m2;
    if (cell.state == CoverageState::kUnreachable) sum.hole.unreachable_m2 += cell.area_m2;
  }
  for (const CoveragePatch& patch : map.patches) {
    if (!empty(map.cells[patch.cell])) continue;
    for (const Vec3f& p : patch.corners)
      sums[place[sets.root(patch.cell)]].box.add(p.cast<double>());
  }
  return sums;
}

void find_holes(CoverageMap& map, int most) {
  Sets sets = joined(map);
  std::vector<HoleSum> sums = sums_of(map, sets);
  map.hole_count = sums.size();
  std::stable_sort(sums.begin(), sums.end(), [](const HoleSum& a, const HoleSum& b) {
    return a.hole.area_m2 > b.hole.area_m2;
  });
  sums.resize(std::min(sums.size(), static_cast<std::size_t>(most)));
  std::unordered_map<std::uint32_t, std::uint32_t> listed;
  for (HoleSum& sum : sums) {
    if (sum.hole.area_m2 > 0.0) sum.hole.center /= sum.hole.area_m2;
    sum.hole.size_m = sum.box.size();
    const auto main = std::max_element(sum.reasons.begin(), sum.reasons.end());
    sum.hole.reason = static_cast<Miss>(main - sum.reasons.begin());
    listed.emplace(sum.root, static_cast<std::uint32_t>(map.holes.size()));
    map.holes.push_back(sum.hole);
  }
  for (std::uint32_t c = 0; c < map.cells.size(); ++c) {
    if (!empty(map.cells[c])) continue;
    if (const auto found = listed.find(sets.root(c)); found != listed.end())
      map.cells[c].hole = found->second;
  }
}

/// Interpolates between colours at equal steps.
Rgb ramp(double x) {
  constexpr std::array<Rgb, 4> kStops{
      {{49, 84, 170}, {38, 150, 150}, {80, 180, 70}, {240, 220, 60}}};
  const double at = std::clamp(x, 0.0, 1.0) * (kStops.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  const double part = at - double(i);
  const auto mixed = [part](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::lround((1.0 - part) * a + part * b));
  };
  const Rgb &a = kStops[i], &b = kStops[i + 1];
  return {mixed(a.r, b.r), mixed(a.g, b.g), mixed(a.b, b.b)};
}

Rgb color_of(const CoverageCell& cell, double thin_per_mm2) {
  constexpr double kSteps = 8.0;  // factors of two from the first colour to the last
  switch (cell.state) {
    case CoverageState::kThin:
      return {235, 140, 40};
    case CoverageState::kMissed:
      return {205, 30, 40};
    case CoverageState::kUnreachable:
      return {85, 85, 90};
    case CoverageState::kCovered:
      break;
  }
  const double floor = std::max(thin_per_mm2, 1e-3);
  return ramp(std::log2(std::max(1.0, cell.density_per_mm2() / floor)) / kSteps);
}

}  // namespace

OptionTable describe(CoverageMapOptions& o) {
  OptionTable table;
  table
      .number("coverage-cell", o.cell_m, Quantity::kLength, {1e-5, 10.0},
              "Size of the parts of the surface whose samples are counted.")
      .number("coverage-thin", o.thin_per_mm2, Quantity::kNone, {0.0, 1e6},
              "Samples on a square millimetre below which the surface counts as thinly covered.")
      .number("coverage-holes", o.holes, {0, 100000}, "How many of the largest holes are listed.");
  return table;
}

std::string_view name_of(CoverageState state) {
  return kStateNames.at(static_cast<std::size_t>(state));
}

double CoverageMap::covered() const {
  const double seen = state_m2[0] + state_m2[1];
  return area_m2 > 0.0 ? seen / area_m2 : 0.0;
}

double CoverageMap::covered_of_reachable() const {
  const double reachable =
      area_m2 - state_m2[static_cast<std::size_t>(CoverageState::kUnreachable)];
  return reachable > 0.0 ? (state_m2[0] + state_m2[1]) / reachable : 0.0;
}

Result<CoverageMap> coverage_map(const Scene& scene, std::span<const TriangleMesh> objects,
                                 std::span<const ScannerModel> scanners,
                                 std::span<const CoveragePose> poses,
                                 const CoverageMapOptions& options, const RunContext& context,
                                 const Scene* room, std::span<const CoveragePass> further_passes) {
  std::vector<CoveragePass> passes{{&scene, Pose::Identity()}};
  passes.insert(passes.end(), further_passes.begin(), further_passes.end());
  const coverage::CoverageJob job{std::move(passes), scanners, poses, options, room};
  TURNSCAN_TRY(check(job, objects));
  TURNSCAN_TRY(context.check());
  coverage::CoveragePatches surface(objects, options.cell_m);
  CoverageMap map;
  map.cell_m = surface.cell_m;
  TURNSCAN_ASSIGN(map.samples, coverage::count_samples(job, surface, context));
  TURNSCAN_TRY(coverage::explain_cells(job, surface, context));
  map.patches = std::move(surface.patches);
  map.cells = std::move(surface.cells);
  for (const CoverageCell& cell : map.cells) {
    map.area_m2 += cell.area_m2;
    map.state_m2[static_cast<std::size_t>(cell.state)] += cell.area_m2;
    if (empty(cell)) map.reason_m2[static_cast<std::size_t>(cell.reason)] += cell.area_m2;
  }
  find_holes(map, options.holes);
  return map;
}

TriangleMesh coverage_mesh(const CoverageMap& map, const CoverageMapOptions& options) {
  TriangleMesh mesh;
  mesh.name = "coverage";
  for (const CoveragePatch& patch : map.patches) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), patch.corners.begin(), patch.corners.end());
    mesh.colors.insert(mesh.colors.end(), 3, color_of(map.cells[patch.cell], options.thin_per_mm2));
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

}  // namespace turnscan
