#include <gtest/gtest.h>

#include <set>
#include <tests/support/synthetic_cloud.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/points/candidates.hpp>
#include <turnscan/reconstruction/voxels/sub_voxel_line.hpp>

namespace turnscan::points {
namespace {

using Cell = std::array<int, 3>;

std::vector<Cell> walk(const Vec3d& p, const Vec3d& d, int s, bool chord) {
  std::vector<Cell> cells;
  voxels::walk_sub_voxels(p, d, s, chord, [&](int x, int y, int z) { cells.push_back({x, y, z}); });
  return cells;
}

/// Cells of which the line meets the inside, by clipping it against each cell's slabs.
std::set<Cell> slow_cells(const Vec3d& p, const Vec3d& d, int s, bool chord, double shrink) {
  std::set<Cell> cells;
  for (int z = 0; z < s; ++z)
    for (int y = 0; y < s; ++y)
      for (int x = 0; x < s; ++x) {
        double t0 = chord ? -1e30 : 0.0, t1 = 1e30;
        const Vec3d low = Vec3d(x, y, z).array() + shrink;
        for (int a = 0; a < 3; ++a) {
          const double high = low[a] + 1.0 - 2 * shrink;
          const double u = (low[a] - p[a]) / d[a], v = (high - p[a]) / d[a];
          t0 = std::max(t0, std::min(u, v));
          t1 = std::min(t1, std::max(u, v));
        }
        if (t1 > t0) cells.insert({x, y, z});
      }
  return cells;
}

TEST(SubVoxelLine, VisitsExactlyTheCellsThatTheLineMeets) {
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const int s = 1 + int(i % 6);
    Vec3d p, d;
    for (std::uint64_t a = 0; a < 3; ++a) {
      p[int(a)] = s * uniform01(hash_key(1, i, a));
      d[int(a)] = standard_normal(hash_key(2, i, a));
    }
    for (const bool chord : {true, false}) {
      const auto cells = walk(p, d, s, chord);
      const std::set<Cell> visited(cells.begin(), cells.end());
      EXPECT_EQ(visited.size(), cells.size()) << "a cell was visited twice";
      // What is met well inside must be visited; what is visited must at least be touched.
      for (const Cell& c : slow_cells(p, d, s, chord, 1e-9)) EXPECT_TRUE(visited.count(c));
      const auto touched = slow_cells(p, d, s, chord, -1e-9);
      for (const Cell& c : visited) EXPECT_TRUE(touched.count(c));
    }
  }
}

TEST(SubVoxelLine, ALineAlongAnAxisVisitsOneRow) {
  const auto cells = walk(Vec3d(0.5, 2.5, 3.5), Vec3d(0, -1, 0), 4, true);
  EXPECT_EQ(cells, (std::vector<Cell>{{0, 3, 3}, {0, 2, 3}, {0, 1, 3}, {0, 0, 3}}));
}

TEST(SubVoxelLine, TowardsTheSensorBeginsAtThePoint) {
  const auto cells = walk(Vec3d(0.5, 1.5, 0.5), Vec3d(0, 1, 0), 4, false);
  EXPECT_EQ(cells, (std::vector<Cell>{{0, 1, 0}, {0, 2, 0}, {0, 3, 0}}));
}

TEST(SubVoxelLine, WithoutADirectionOnlyThePointsCellIsVisited) {
  EXPECT_EQ(walk(Vec3d(1.5, 1.5, 1.5), Vec3d::Zero(), 4, true).size(), 1u);
}

Result<Candidates> candidates_of(const voxels::MergedCloud& merged, double size,
                                 const CandidateOptions& options) {
  const voxels::MeasuredCells measured = testing::measured(merged, size, options);
  return find_candidates(measured, measured.grid, RunContext());
}

TEST(Centroids, AreTheMeansOfTheirVoxels) {
  const voxels::MergedCloud merged = testing::noisy_plane(5000, 0.01, 0.001);
  const auto grid = voxels::VoxelGrid::build(merged.cloud.points, 0.002, RunContext());
  ASSERT_TRUE(grid);
  const auto c = candidates_of(merged, 0.002, {});
  ASSERT_TRUE(c);
  ASSERT_EQ(c->cloud.size(), grid->voxels().size());
  for (std::size_t v = 0; v < c->cloud.size(); ++v) {
    Vec3d sum = Vec3d::Zero();
    const auto& voxel = grid->voxels()[v];
    for (std::uint32_t k = voxel.begin; k < voxel.end; ++k)
      sum += merged.cloud.points[grid->order()[k]].cast<double>();
    EXPECT_LT((c->cloud.points[v].cast<double>() - sum / voxel.count()).norm(), 2.2e-7);
    EXPECT_EQ(c->cloud.weights[v], float(voxel.count()));
  }
}

TEST(SubVoxelCounting, GivesEveryTiedSubVoxelAsACandidate) {
  // One point seen from straight above: its column of four sub-voxels ties.
  voxels::MergedCloud merged;
  merged.viewpoints = {{Vec3d::UnitY(), true}};
  merged.cloud.points = {Vec3f(0.0011f, 0.0013f, 0.0001f)};
  merged.cloud.frame = {0};
  CandidateOptions options;
  options.method = CandidateMethod::kSubVoxel;
  const auto c = candidates_of(merged, 0.004, options);
  ASSERT_TRUE(c);
  ASSERT_EQ(c->cloud.size(), 4u);
  for (int k = 0; k < 4; ++k) {
    EXPECT_LT(
        (c->cloud.points[std::size_t(k)] - Vec3f(0.0015f, 0.001f * float(k) + 0.0005f, 0.0005f))
            .norm(),
        1e-6f);
    EXPECT_FLOAT_EQ(c->cloud.weights[std::size_t(k)], 0.25f);
  }
}

TEST(SubVoxelCounting, PicksTheCellInWhichRaysFromDifferentSidesCross) {
  voxels::MergedCloud merged;
  merged.viewpoints = {{Vec3d::UnitX(), true}, {Vec3d::UnitY(), true}, {Vec3d::UnitZ(), true}};
  const Vec3f crossing(0.0025f, 0.0015f, 0.0035f);
  for (std::uint32_t f = 0; f < 3; ++f) {
    Vec3f p = crossing;
    p[int(f)] = 0.0005f;  // each is off along its own ray
    merged.cloud.points.push_back(p);
    merged.cloud.frame.push_back(f);
  }
  CandidateOptions options;
  options.method = CandidateMethod::kSubVoxel;
  const auto c = candidates_of(merged, 0.004, options);
  ASSERT_TRUE(c);
  ASSERT_EQ(c->cloud.size(), 1u);
  EXPECT_LT((c->cloud.points[0] - crossing).norm(), 1e-6f);
}

double mean_height(const Candidates& c) {
  double sum = 0.0;
  for (const Vec3f& p : c.cloud.points) sum += p.y();
  return sum / double(c.cloud.size());
}

TEST(SubVoxelCounting, TheWholeChordLeavesANoisyPlaneWhereItIs) {
  // The plane lies inside a voxel's layer, off its middle; 1.67 mm voxels, 1.5 mm noise.
  const voxels::MergedCloud merged = testing::noisy_plane(400000, 0.03, 0.0015, 0.0004);
  CandidateOptions options;
  options.method = CandidateMethod::kSubVoxel;
  const auto chord = candidates_of(merged, 0.00167, options);
  options.line = SubVoxelLine::kTowardsSensor;
  const auto one_sided = candidates_of(merged, 0.00167, options);
  ASSERT_TRUE(chord && one_sided);
  EXPECT_GT(mean_height(*one_sided) - mean_height(*chord), 0.0002);
}

TEST(Candidates, AreTheSameForOneAndTwoThreads) {
  const voxels::MergedCloud merged = testing::noisy_plane(100000, 0.02, 0.001);
  CandidateOptions options;
  options.method = CandidateMethod::kSubVoxel;
  set_thread_count(1);
  const auto one = candidates_of(merged, 0.0008, options);
  set_thread_count(2);
  const auto two = candidates_of(merged, 0.0008, options);
  set_thread_count(0);
  ASSERT_TRUE(one && two);
  EXPECT_EQ(one->cloud.points, two->cloud.points);
}

TEST(Candidates, GiveNothingOnceCancelled) {
  const voxels::MergedCloud merged = testing::noisy_plane(1000, 0.02, 0.001);
  const voxels::MeasuredCells measured = testing::measured(merged, 0.001);
  const RunContext context;
  context.cancel();
  EXPECT_EQ(find_candidates(measured, measured.grid, context).error().code, ErrorCode::kCancelled);
}

TEST(Candidates, TakeTheMeanColourOfTheirPoints) {
  voxels::MergedCloud merged = testing::noisy_plane(2, 0.0001, 0.0);
  merged.cloud.points = {Vec3f(0.001f, 0.001f, 0.001f), Vec3f(0.002f, 0.001f, 0.001f)};
  merged.cloud.colors = {{10, 20, 30}, {20, 40, 60}};
  const auto c = candidates_of(merged, 0.01, {});
  ASSERT_TRUE(c);
  EXPECT_EQ(c->cloud.colors.at(0), (Rgb{15, 30, 45}));
}

TEST(CandidateOptions, RefuseValuesOutsideTheirRange) {
  CandidateOptions options;
  EXPECT_FALSE(describe(options).set("sub-voxels", "0"));
  EXPECT_FALSE(describe(options).set("sub-voxels", "17"));
  EXPECT_FALSE(describe(options).set("sub-voxels", "2.5"));
  EXPECT_FALSE(describe(options).set("candidates", "median"));
  EXPECT_TRUE(describe(options).set("candidates", "sub-voxel"));
  EXPECT_EQ(options.method, CandidateMethod::kSubVoxel);
}

}  // namespace
}  // namespace turnscan::points
