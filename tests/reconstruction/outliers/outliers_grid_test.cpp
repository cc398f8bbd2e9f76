// The search in the grid against a search through all points, on every instruction set.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <turnscan/core/random.hpp>
#include <turnscan/reconstruction/outliers/outliers_grid.hpp>
#include <turnscan/reconstruction/outliers/outliers_tree.hpp>

#include "tests/reconstruction/outliers/depth_frames.hpp"
#include "tests/support/sanitizers.hpp"

namespace turnscan::outliers {
namespace {

using testing::Defects;

/// By definition: all squared distances sorted, the first (the point itself) left out.
std::vector<float> brute_force(const std::vector<Vec3f>& points, int k) {
  std::vector<float> mean;
  std::vector<float> squared(points.size());
  for (const Vec3f& q : points) {
    for (std::size_t j = 0; j < points.size(); ++j) {
      const float dx = q.x() - points[j].x(), dy = q.y() - points[j].y();
      const float dz = q.z() - points[j].z();
      squared[j] = dx * dx + dy * dy + dz * dz;
    }
    std::partial_sort(squared.begin(), squared.begin() + k + 1, squared.end());
    double sum = 0.0;
    for (int i = 1; i <= k; ++i) sum += std::sqrt(double(squared[i]));
    mean.push_back(static_cast<float>(sum / k));
  }
  return mean;
}

const std::vector<InstructionSet> kSets = {InstructionSet::kPortable, InstructionSet::kAvx2,
                                           InstructionSet::kAvx512};

/// Uses each instruction set that this machine has, then the widest again.
class EachSet {
 public:
  template <class Test>
  static void run(const Test& test) {
    for (const InstructionSet set : kSets) {
      if (!OutlierKernels::find(set)) continue;
      SCOPED_TRACE(static_cast<int>(set));
      OutlierKernels::use(set);
      test();
    }
  }
};

/// As a run of numbers that differ in bits, not values; and the grid must not have given up.
void expect_exact(const FramePoints& frame, int k) {
  const std::vector<float> expected = brute_force(frame.cloud.points, k);
  EachSet::run([&] {
    std::vector<float> mean(expected.size(), -1.0f);
    ASSERT_TRUE(grid_mean_distances(frame, k, mean));
    EXPECT_EQ(std::memcmp(mean.data(), expected.data(), mean.size() * sizeof(float)), 0)
        << "k " << k;
  });
}

FramePoints small_frame(const testing::DepthAt& depth, int width = 70, int height = 50,
                        double f = 60.0) {
  CameraIntrinsics camera;
  camera.width = width, camera.height = height;
  camera.fx = camera.fy = f;
  camera.cx = width / 2.0, camera.cy = height / 2.0;
  return testing::render(camera, depth);
}

double random_at(std::uint64_t seed, int column, int row) {
  return uniform01(hash_key(seed, std::uint64_t(column), std::uint64_t(row)));
}

TEST(GridSearch, GivesTheMeanDistancesOfBruteForce) {
  for (int seed = 1; seed <= testing::repetitions(3); ++seed) {
    Defects defects;
    defects.seed = std::uint64_t(seed);
    const FramePoints frame = testing::object_frame(testing::kinect_v2(), defects);
    for (const int k : {1, 7, 10, 33}) expect_exact(frame, k);
  }
}

TEST(GridSearch, FollowsADistortingLens) {
  Defects defects;
  defects.holes = 0.97;  // of the whole frame, as its margins are bent most
  expect_exact(testing::room_frame(testing::distorted_kinect_v2(), defects), 10);
  const FramePoints frame = testing::object_frame(testing::distorted_kinect_v2());
  for (const int k : {3, 10}) expect_exact(frame, k);
}

TEST(GridSearch, FollowsLinesOfTheGridThatAreBent) {
  // A wide lens on a small image: lines of pixels bend by several pixels.
  CameraIntrinsics camera;
  camera.width = 90, camera.height = 70;
  camera.fx = camera.fy = 60.0, camera.cx = 45.0, camera.cy = 35.0;
  camera.distortion = {-0.12, 0.0, 0.002, -0.003, 0.0};
  const FramePoints frame = testing::render(camera, [](int column, int row, double x, double y) {
    return 1.0 + 0.2 * x - 0.3 * y + 0.02 * random_at(18, column, row);
  });
  PointGrid grid;
  ASSERT_TRUE(grid.build(frame));
  EXPECT_TRUE(grid.grid().bent);
  for (const int k : {1, 10, 50}) expect_exact(frame, k);
}

TEST(GridSearch, WidensTheWindowAsFarAsNeeded) {
  // Random depths: neighbours in space are many pixels apart.
  for (const double spread : {0.1, 1.0, 10.0}) {
    const FramePoints frame = small_frame([spread](int column, int row, double, double) {
      return 0.5 + spread * random_at(11, column, row);
    });
    for (const int k : {1, 10, 40, 128}) expect_exact(frame, k);
  }
}

TEST(GridSearch, FindsNeighboursAcrossHoles) {
  for (const double holes : {0.5, 0.9}) {
    const FramePoints frame = small_frame([holes](int column, int row, double x, double) {
      return random_at(12, column, row) < holes ? 0.0 : 1.0 + 0.2 * x;
    });
    for (const int k : {1, 10, 50}) expect_exact(frame, k);
  }
}

TEST(GridSearch, SeesPastAForegroundThatHidesTheNeighbours) {
  // Single pixels far behind a wall of slats: their neighbours lie behind the next slats.
  const FramePoints frame = small_frame([](int column, int row, double, double) {
    return (column * 5 + row * 3) % 11 == 0 ? 2.0 + 0.01 * random_at(13, column, row) : 0.5;
  });
  for (const int k : {1, 10, 25}) expect_exact(frame, k);
}

TEST(GridSearch, CanUseAnySizeOfGrid) {
  for (const int width : {1, 2, 3, 15, 16, 17, 31, 33})
    for (const int height : {1, 2, 9, 20}) {
      const FramePoints frame =
          small_frame([](int column, int row, double,
                         double) { return 1.0 + 0.1 * random_at(14, column, row); },
                      width, height);
      const int points = width * height;
      for (const int k : {1, 10, 24, 100})
        if (points > k) expect_exact(frame, k);
    }
}

TEST(GridSearch, HandlesParallelAndSlantedScans) {
  for (const double shear : {0.0, 0.4, 2.0}) {
    FramePoints frame;
    frame.width = 60, frame.height = 45;
    frame.viewpoint = {Vec3d::UnitZ(), true};
    for (int cell = 0; cell < 60 * 45; ++cell) {
      const double z = 0.03 * random_at(15, cell % 60 / 9, cell / 60 / 7) + 1e-4 * (cell % 7);
      frame.cell.push_back(cell);
      frame.cloud.points.emplace_back(float(0.0005 * (cell % 60)),
                                      float(-0.0005 * (cell / 60) + shear * z), float(z));
    }
    for (const int k : {1, 10, 40}) expect_exact(frame, k);
  }
}

TEST(GridSearch, FindsNeighboursFromTheFirstColumnToTheLastOfARoundScan) {
  FramePoints frame;
  frame.width = 100, frame.height = 24;
  for (int cell = 0; cell < 100 * 24; ++cell) {
    const double angle = 2.0 * M_PI / 100.0 * (cell % 100);
    const double radius = 0.1 + 0.002 * random_at(19, cell % 100, cell / 100);
    frame.cell.push_back(cell);
    frame.cloud.points.emplace_back(float(radius * std::cos(angle)), float(0.004 * (cell / 100)),
                                    float(radius * std::sin(angle)));
  }
  for (const int k : {1, 10, 30}) expect_exact(frame, k);
}

TEST(GridSearch, FindsNeighboursFarAwayInBothColumnsAndRows) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  // One block of cells lies between the points of another.
  FramePoints frame;
  frame.width = 80, frame.height = 80;
  frame.viewpoint.parallel = true;
  for (int cell = 0; cell < 80 * 80; ++cell) {
    const int column = cell % 80, row = cell / 80;
    const bool moved = column >= 60 && column < 75 && row >= 60 && row < 75;
    const double shift = moved ? -55.0 + 0.4 : 0.0;
    frame.cell.push_back(cell);
    frame.cloud.points.emplace_back(float(0.001 * (column + shift)), float(0.001 * (row + shift)),
                                    float(0.0002 * random_at(20, column, row)));
  }
  for (const int k : {1, 4, 10, 30}) expect_exact(frame, k);
}

TEST(GridSearch, TakesPointsInAnyOrder) {
  expect_exact(testing::shuffled(testing::object_frame(testing::kinect_v2()), 4), 10);
}

TEST(GridSearch, HandlesAnySensorPose) {
  for (int turn = 0; turn < 8; ++turn) {
    FramePoints frame = small_frame([](int column, int row, double x, double y) {
      return 1.0 + 0.5 * x + 0.3 * y + 0.01 * random_at(16, column, row);
    });
    const Pose T = Eigen::Translation3d(turn, 0.5 * turn, -1.0) *
                   Eigen::AngleAxisd(0.8 * turn, Vec3d(1.0, turn, -0.5).normalized());
    for (Vec3f& p : frame.cloud.points) p = (T * p.cast<double>()).cast<float>();
    frame.viewpoint = frame.viewpoint.transformed(T);
    expect_exact(frame, 10);
    frame.viewpoint = Viewpoint();
    expect_exact(frame, 10);
  }
}

TEST(GridSearch, IsExactWhereCoordinatesAreCoarse) {
  // 1 km away a step of float32 is 0.06 mm, a tenth of the spacing.
  for (const double f : {2e6, 2e5}) {
    FramePoints frame = small_frame(
        [](int column, int row, double, double) { return 1.0 + 1e-4 * random_at(17, column, row); },
        40, 30, f);
    for (Vec3f& p : frame.cloud.points) p *= 1000.0f;
    expect_exact(frame, 10);
  }
}

TEST(GridSearch, GivesUpOnPointsLostInAHugeGrid) {
  FramePoints frame;
  frame.width = frame.height = 40000;
  for (int i = 0; i < 30; ++i) {
    frame.cell.push_back(i * 50000000);
    frame.cloud.points.emplace_back(float(i), 0.0f, 1.0f);
  }
  std::vector<float> mean(frame.cell.size());
  EXPECT_FALSE(grid_mean_distances(frame, 10, mean));
}

TEST(GridSearch, GivesUpOnSharedCells) {
  FramePoints frame = small_frame([](int, int, double, double) { return 1.0; });
  frame.cell[1] = frame.cell[0];
  std::vector<float> mean(frame.cell.size());
  EXPECT_FALSE(grid_mean_distances(frame, 10, mean));
}

TEST(GridSearch, LeavesMoreNeighboursToATree) {
  const FramePoints frame = small_frame([](int, int, double, double) { return 1.0; });
  std::vector<float> mean(frame.cell.size());
  EXPECT_TRUE(grid_mean_distances(frame, kMaxK, mean));
  EXPECT_FALSE(grid_mean_distances(frame, kMaxK + 1, mean));
}

/// Where a point lies in the grid.
struct Cell {
  int column, row;
};

/// How far the points of another column or row must be at least, as the kernels reckon it.
double bound(const Grid& grid, const Borders& borders, std::int32_t at, const Cell& q,
             const Cell& other) {
  const auto to = [&](const Border& border, int line, int band, const float* across) {
    const std::ptrdiff_t i = line + (band / kBand) * border.band_stride;
    return border.a[i] * double(grid.w[at]) + border.b[i] * double(across[at]) + border.offset[i];
  };
  double nearest = 0.0;
  if (other.column < q.column)
    nearest = to(borders.before_column, other.column, q.row, grid.u);
  else if (other.column > q.column)
    nearest = to(borders.beyond_column, other.column, q.row, grid.u);
  if (other.row < q.row)
    nearest = std::max(nearest, to(borders.before_row, other.row, q.column, grid.v));
  else if (other.row > q.row)
    nearest = std::max(nearest, to(borders.beyond_row, other.row, q.column, grid.v));
  return nearest - grid.margin - 1e-6;
}

void expect_valid_bounds(const FramePoints& frame, bool bent) {
  PointGrid built;
  ASSERT_TRUE(built.build(frame));
  const Grid& grid = built.grid();
  EXPECT_EQ(grid.bent, bent);
  const auto cell = [&grid](std::int32_t at) {
    const std::int64_t from_origin = at + kPad * grid.stride + kPad;
    return Cell{int(from_origin % grid.stride) - kPad, int(from_origin / grid.stride) - kPad};
  };
  std::size_t violations = 0;
  for (std::size_t i = 0; i < frame.cell.size(); i += 97) {
    for (std::size_t j = 0; j < frame.cell.size(); j += 13) {
      const std::int32_t at = built.position()[i];
      const Cell q = cell(at), other = cell(built.position()[j]);
      const double distance =
          (frame.cloud.points[i].cast<double>() - frame.cloud.points[j].cast<double>()).norm();
      violations += bound(grid, grid.whole, at, q, other) > distance;
      const bool in_bands =
          std::abs(q.column - other.column) <= kBand && std::abs(q.row - other.row) <= kBand;
      violations += bent && in_bands && bound(grid, grid.bands, at, q, other) > distance;
    }
  }
  EXPECT_EQ(violations, 0u);
}

TEST(GridSearch, BoundsNeverExceedTheDistance) {
  Defects few;
  few.holes = 0.8;
  expect_valid_bounds(testing::room_frame(testing::kinect_v2(), few), false);
  expect_valid_bounds(testing::room_frame(testing::distorted_kinect_v2(), few), true);
}

TEST(GridSearch, BoundsOfOtherViewpointsAreValidToo) {
  Defects few;
  few.holes = 0.8;
  FramePoints frame = testing::room_frame(testing::distorted_kinect_v2(), few);
  frame.viewpoint.value = Vec3d(0.01, 0.02, -0.3);
  expect_valid_bounds(frame, true);
  frame.viewpoint = {-Vec3d::UnitZ(), true};
  expect_valid_bounds(frame, true);
}

TEST(BoundFrames, FollowTheRaysAsTheGridHasThem) {
  FramePoints frame = testing::object_frame(testing::distorted_kinect_v2());
  EXPECT_EQ(choose_bound_frame(frame).kind, BoundFrame::Kind::kPinhole);
  FramePoints mirrored = frame;
  for (std::int32_t& cell : mirrored.cell) cell += frame.width - 1 - 2 * (cell % frame.width);
  EXPECT_EQ(choose_bound_frame(mirrored).kind, BoundFrame::Kind::kCentral);
  EXPECT_LT(choose_bound_frame(mirrored).u.x(), -0.99);
  EXPECT_GT(choose_bound_frame(mirrored).v.y(), 0.99);
  expect_exact(mirrored, 10);
  frame.viewpoint.parallel = true;
  EXPECT_EQ(choose_bound_frame(frame).kind, BoundFrame::Kind::kLinear);
  frame.viewpoint = {Vec3d(0.0, 0.0, 0.9), false};  // in the middle of the object
  EXPECT_EQ(choose_bound_frame(frame).kind, BoundFrame::Kind::kLinear);
}

TEST(OutlierTree, EveryInstructionSetGivesTheSameDistances) {
  const FramePoints frame = testing::room_frame(testing::kinect_v2());
  for (const std::size_t n : {std::size_t(12), std::size_t(16), std::size_t(17), std::size_t(257),
                              std::size_t(5000), std::size_t(40001)}) {
    const std::span<const Vec3f> points(frame.cloud.points.data(), n);
    std::vector<float> plain(n), wide(n);
    for (const int k : {1, 10, 11}) {
      OutlierKernels::use(InstructionSet::kPortable);
      ASSERT_TRUE(tree_mean_distances(points, k, RunContext(), plain));
      for (const InstructionSet set : kSets) {
        if (!OutlierKernels::find(set)) continue;
        OutlierKernels::use(set);
        ASSERT_TRUE(tree_mean_distances(points, k, RunContext(), wide));
        EXPECT_EQ(wide, plain) << n << " points, k " << k;
      }
    }
  }
}

TEST(InstructionSets, PortableIsAlwaysThereAndUnknownOnesAreRefused) {
  EXPECT_NE(OutlierKernels::find(InstructionSet::kPortable), nullptr);
  for (const InstructionSet set : kSets) {
    if (!OutlierKernels::find(set)) {
      EXPECT_THROW(OutlierKernels::use(set), std::invalid_argument);
    }
  }
}

}  // namespace
}  // namespace turnscan::outliers
