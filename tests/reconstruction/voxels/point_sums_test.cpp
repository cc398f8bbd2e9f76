#include <gtest/gtest.h>

#include <map>
#include <tests/support/synthetic_cloud.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/voxels/point_sums.hpp>
#include <turnscan/reconstruction/voxels/sub_voxel_line.hpp>

namespace turnscan::points {
namespace {

constexpr double kVoxel = 0.002;

CandidateOptions sub_voxels() {
  CandidateOptions options;
  options.method = CandidateMethod::kSubVoxel;
  return options;
}

void expect_same(const voxels::MeasuredCells& a, const voxels::MeasuredCells& b) {
  EXPECT_EQ(a.columns, b.columns);
  EXPECT_EQ(a.colors, b.colors);
  EXPECT_EQ(a.peak_points, b.peak_points);
  ASSERT_EQ(a.grid.voxels().size(), b.grid.voxels().size());
  for (std::size_t v = 0; v < a.grid.voxels().size(); ++v) {
    EXPECT_EQ(a.grid.voxels()[v].index, b.grid.voxels()[v].index);
    EXPECT_EQ(a.grid.voxels()[v].points, b.grid.voxels()[v].points);
  }
}

TEST(PointSums, CountAndAverageLikeAMapFromCellsToPoints) {
  const voxels::MergedCloud merged = testing::noisy_plane(20000, 0.01, 0.001);
  struct Sum {
    Vec3d place = Vec3d::Zero(), towards = Vec3d::Zero();
    int count = 0;
  };
  std::map<std::array<int, 3>, Sum> oracle;
  for (std::size_t i = 0; i < merged.cloud.size(); ++i) {
    const Vec3d p = merged.cloud.points[i].cast<double>();
    const Vec3d cell = (p / (0.5 * kVoxel)).array().floor();
    Sum& sum = oracle[{int(cell.x()), int(cell.y()), int(cell.z())}];
    sum.place += p;
    sum.towards += merged.towards_sensor(i).cast<double>();
    ++sum.count;
  }
  const voxels::MeasuredCells m = testing::measured(merged, kVoxel);
  ASSERT_EQ(m.size(), oracle.size());
  for (std::size_t i = 0; i < m.size(); ++i) {
    const Vec3d cell = (m.point(i).cast<double>() / (0.5 * kVoxel)).array().floor();
    const auto found = oracle.find({int(cell.x()), int(cell.y()), int(cell.z())});
    ASSERT_NE(found, oracle.end());
    const Sum& sum = found->second;
    EXPECT_EQ(m.count(i), float(sum.count));
    EXPECT_LT((m.point(i).cast<double>() - sum.place / sum.count).norm(), 2.5e-7);
    EXPECT_LT((m.towards_sensor(i).cast<double>() - sum.towards / sum.count).norm(), 5e-4);
  }
}

TEST(PointSums, VoxelsAreThoseOfTheGridOfAllPoints) {
  const voxels::MergedCloud merged = testing::noisy_sphere(20000, 0.03, 0.001);
  const auto grid = voxels::VoxelGrid::build(merged.cloud.points, kVoxel, RunContext());
  const voxels::MeasuredCells m = testing::measured(merged, kVoxel);
  ASSERT_EQ(m.grid.voxels().size(), grid->voxels().size());
  for (std::size_t v = 0; v < m.grid.voxels().size(); ++v) {
    const voxels::VoxelGrid::Voxel& voxel = m.grid.voxels()[v];
    EXPECT_EQ(voxel.index, grid->voxels()[v].index);
    EXPECT_EQ(voxel.count(), grid->voxels()[v].count());
    double count = 0.0;
    for (std::uint32_t i = voxel.begin; i < voxel.end; ++i) count += m.count(i);
    EXPECT_EQ(count, voxel.count());
  }
}

TEST(PointSums, DependNeitherOnTheOrderOfFramesNorOnCallsNorOnThreads) {
  voxels::MergedCloud merged = testing::noisy_sphere(20000, 0.03, 0.001);
  for (std::size_t i = 0; i < merged.cloud.size(); ++i)
    merged.cloud.colors.push_back({std::uint8_t(i), std::uint8_t(i / 3), 7});
  const voxels::MeasuredCells once = testing::measured(merged, kVoxel, sub_voxels());
  EXPECT_FALSE(once.colors.empty());
  const testing::Frames frames(merged);
  const std::vector<voxels::PointsSeen> seen = frames.seen();
  for (const int threads : {1, 2, 8}) {
    set_thread_count(threads);
    voxels::PointSums sums(kVoxel, sub_voxels());
    for (std::size_t f = seen.size(); f-- > 0;) ASSERT_TRUE(sums.add({&seen[f], 1}));
    const auto again = sums.collect(1, RunContext());
    ASSERT_TRUE(again);
    expect_same(once, *again);
  }
  set_thread_count(0);
}

TEST(PointSums, JoinedVoxelsAreThoseOfThatSize) {
  const voxels::MergedCloud merged = testing::noisy_sphere(20000, 0.03, 0.001);
  const testing::Frames frames(merged);
  voxels::PointSums sums(kVoxel, {});
  ASSERT_TRUE(sums.add(frames.seen()));
  const auto joined = sums.collect(3, RunContext());
  ASSERT_TRUE(joined);
  EXPECT_DOUBLE_EQ(joined->grid.size_m(), 3 * kVoxel);
  const auto grid = voxels::VoxelGrid::build(merged.cloud.points, 3 * kVoxel, RunContext());
  ASSERT_EQ(joined->grid.voxels().size(), grid->voxels().size());
  for (std::size_t v = 0; v < grid->voxels().size(); ++v) {
    EXPECT_EQ(joined->grid.voxels()[v].index, grid->voxels()[v].index);
    EXPECT_EQ(joined->grid.voxels()[v].count(), grid->voxels()[v].count());
  }
}

TEST(PointSums, PeaksAreTheSubVoxelsThatMostRaysMeet) {
  const voxels::MergedCloud merged = testing::noisy_plane(3000, 0.008, 0.001);
  const voxels::MeasuredCells m = testing::measured(merged, kVoxel, sub_voxels());
  const auto grid = voxels::VoxelGrid::build(merged.cloud.points, kVoxel, RunContext());
  ASSERT_EQ(m.peaks.size(), grid->voxels().size());
  std::size_t same = 0;
  for (std::size_t v = 0; v < m.peaks.size(); ++v) {
    const voxels::VoxelGrid::Voxel& voxel = grid->voxels()[v];
    std::vector<int> counts(64, 0);
    for (std::uint32_t k = voxel.begin; k < voxel.end; ++k) {
      const std::uint32_t i = grid->order()[k];
      const Vec3d p =
          (merged.cloud.points[i].cast<double>() - voxel.index.cast<double>() * kVoxel) *
          (4.0 / kVoxel);
      voxels::walk_sub_voxels(
          p, merged.towards_sensor(i).cast<double>(), 4, true,
          [&](int x, int y, int z) { ++counts[std::size_t((z * 4 + y) * 4 + x)]; });
    }
    const int highest = *std::max_element(counts.begin(), counts.end());
    const auto tied = std::count(counts.begin(), counts.end(), highest);
    same += tied == m.peaks[v].end - m.peaks[v].begin ? 1 : 0;
  }
  // Places and directions are rounded: a ray through an edge may count on its other side.
  EXPECT_GT(double(same), 0.97 * double(m.peaks.size()));
}

TEST(PointSums, SubVoxelsHoldThePeaksAndEveryLine) {
  const voxels::MergedCloud merged = testing::noisy_plane(3000, 0.008, 0.001);
  const testing::Frames frames(merged);
  voxels::PointSums sums(kVoxel, sub_voxels());
  ASSERT_TRUE(sums.add(frames.seen()));
  const PointCloud counted = sums.sub_voxels();
  double lines = 0.0;
  std::map<std::array<float, 3>, float> at;
  for (std::size_t i = 0; i < counted.size(); ++i) {
    const Vec3f& p = counted.points[i];
    EXPECT_TRUE(at.emplace(std::array{p.x(), p.y(), p.z()}, counted.weights[i]).second);
    lines += counted.weights[i];
  }
  EXPECT_GT(lines, double(merged.cloud.size()));  // each meets one sub-voxel at least
  const auto m = sums.collect(1, RunContext());
  for (const voxels::Peak& peak : m->peaks)
    for (std::uint32_t k = peak.begin; k < peak.end; ++k) {
      const Vec3f& p = m->peak_points[k];
      const float highest = at[{p.x(), p.y(), p.z()}];
      EXPECT_EQ(highest, (at[{m->peak_points[peak.begin].x(), m->peak_points[peak.begin].y(),
                              m->peak_points[peak.begin].z()}]));
      EXPECT_GE(highest, 1.0f);
    }
  EXPECT_TRUE(voxels::PointSums(kVoxel, {}).sub_voxels().empty());
}

TEST(PointSums, AnotherOriginMovesTheGridAndNoPoint) {
  const Vec3d origin(0.0007, -0.0013, 0.0004);
  voxels::MergedCloud merged = testing::noisy_sphere(5000, 0.03, 0.001);
  const auto at_zero = testing::measured(merged, kVoxel);
  for (Vec3f& p : merged.cloud.points) p += origin.cast<float>();
  for (Viewpoint& v : merged.viewpoints) v.value += origin;
  const testing::Frames frames(merged);
  voxels::PointSums sums(kVoxel, {}, origin);
  ASSERT_TRUE(sums.add(frames.seen()));
  const auto moved = sums.collect(1, RunContext());
  // Rounding of the moved points may put one of them into the cell beside its own.
  ASSERT_NEAR(double(moved->size()), double(at_zero.size()), 5.0);
  Vec3d mean = Vec3d::Zero();
  for (std::size_t i = 0; i < moved->size(); ++i)
    mean += moved->count(i) * moved->point(i).cast<double>() / double(merged.cloud.size());
  for (std::size_t i = 0; i < at_zero.size(); ++i)
    mean -= at_zero.count(i) * at_zero.point(i).cast<double>() / double(merged.cloud.size());
  EXPECT_LT((mean - origin).norm(), 1e-6);
  for (const voxels::VoxelGrid::Voxel& voxel : moved->grid.voxels()) {
    EXPECT_EQ(moved->grid.index_of(moved->grid.center(voxel)), voxel.index);
    for (std::uint32_t i = voxel.begin; i < voxel.end; ++i)
      ASSERT_EQ(moved->grid.index_of(moved->point(i).cast<double>()), voxel.index);
  }
}

TEST(PointSums, TakeNoMoreMemoryForMoreFrames) {
  const voxels::MergedCloud merged = testing::noisy_plane(20000, 0.02, 0.0);
  const testing::Frames frames(merged);
  voxels::PointSums sums(kVoxel, {});
  ASSERT_TRUE(sums.add(frames.seen()));
  const std::size_t bytes = sums.bytes();
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(sums.add(frames.seen()));
  EXPECT_EQ(sums.bytes(), bytes);
  EXPECT_EQ(sums.points(), 6 * merged.cloud.size());
}

TEST(PointSums, RefusePointsFarAwayAndKeepWhatTheyHad) {
  voxels::PointSums sums(kVoxel, {});
  const std::vector<Vec3f> near{Vec3f(0.1f, 0.2f, 0.3f)}, far{Vec3f(0, 0, 0), Vec3f(1e5f, 0, 0)},
      none{Vec3f(std::nanf(""), 0, 0)};
  const std::vector<voxels::PointsSeen> good{{near, {}, {}}};
  ASSERT_TRUE(sums.add(good));
  for (const auto& bad : {far, none}) {
    const std::vector<voxels::PointsSeen> seen{{bad, {}, {}}};
    EXPECT_EQ(sums.add(seen).error().code, ErrorCode::kInvalidOption);
  }
  EXPECT_EQ(sums.points(), 1u);
  EXPECT_EQ(sums.collect(1, RunContext())->size(), 1u);
}

TEST(PointSums, GiveNothingWhenEmptyOrCancelled) {
  voxels::PointSums sums(kVoxel, {});
  EXPECT_EQ(sums.collect(1, RunContext()).error().code, ErrorCode::kTooFewPoints);
  const std::vector<Vec3f> points{Vec3f::Zero()};
  const std::vector<voxels::PointsSeen> seen{{points, {}, {}}};
  ASSERT_TRUE(sums.add(seen));
  const RunContext context;
  context.cancel();
  EXPECT_EQ(sums.collect(1, context).error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan::points
