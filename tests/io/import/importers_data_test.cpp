// Real data sets, where they are there.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/search/closest_point.hpp>
#include <turnscan/geometry/search/knn.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/turntable/table_frame.hpp>

#include "tests/io/import/foreign_data.hpp"
#include "tests/support/shared_data.hpp"

namespace turnscan {
namespace {

using testing::frame_of;
using ::testing::HasSubstr;
using testing::open;
using testing::refusal;
using testing::shared_data;

FramePoints points_at(const FrameSequence& sequence, std::size_t position) {
  const Frame frame = frame_of(sequence, position);
  const SensorInfo& sensor = sequence.header().sensors[frame.info.sensor];
  auto points = points_of(frame, sensor, RayTable(sensor.intrinsics));
  EXPECT_TRUE(points) << points.error().text();
  return points.value_or(FramePoints{});
}

/// Distances from each point to the nearest of the others, sorted.
std::vector<double> nearest_distances(const std::vector<Vec3f>& points, const KdTree& tree) {
  std::vector<double> distances;
  for (const Vec3f& p : points) {
    std::uint32_t index = 0;
    float squared = 0.0f;
    if (tree.knn(p, 1, &index, &squared) == 1) distances.push_back(std::sqrt(squared));
  }
  std::sort(distances.begin(), distances.end());
  return distances;
}

TEST(BunnyData, AllScansTogetherFitThePublishedReconstruction) {
  const auto folder = shared_data("stanford_bunny");
  TURNSCAN_NEEDS_DATA(folder);
  const auto mesh = read_mesh(folder / "reconstruction/bun_zipper.ply");
  ASSERT_TRUE(mesh) << mesh.error().text();
  const MeshDistance reference(*mesh);
  const auto sequence = open(folder);
  ASSERT_EQ(sequence->frames().size(), 10u);
  std::vector<double> distances;
  for (std::size_t i = 0; i < sequence->frames().size(); ++i) {
    const FramePoints scan = points_at(*sequence, i);
    EXPECT_EQ(scan.width, 512);
    EXPECT_GT(scan.cloud.size(), 20000u);
    const Pose T = *sequence->frames()[i].T_table_sensor;
    std::vector<double> own(scan.cloud.size());
    parallel_for(own.size(), 256, [&](std::size_t k) {
      own[k] = reference.closest(T * scan.cloud.points[k].cast<double>()).distance;
    });
    distances.insert(distances.end(), own.begin(), own.end());
  }
  std::sort(distances.begin(), distances.end());
  const auto quantile = [&](double q) {
    return distances[static_cast<std::size_t>(q * static_cast<double>(distances.size()))];
  };
  // The data's README has 0.107, 0.236 and 0.605 mm against points on the mesh; to the surface
  // itself it is 0.064, 0.220 and 0.599. With the rotation not transposed it is centimetres.
  EXPECT_LT(quantile(0.5), 0.068e-3);
  EXPECT_LT(quantile(0.9), 0.23e-3);
  EXPECT_LT(quantile(0.99), 0.61e-3);
}

/// The part of a view within 5 cm of the axis and above the platter, in the table frame.
std::vector<Vec3f> bear_view(const FrameSequence& sequence, std::size_t position, double sign) {
  const Pose T_table_sensor = *table_from_sensor(*sequence.header().turntable);
  const double angle = *sequence.frames()[position].angle_rad;
  const Pose T = rotation_about_y(-sign * angle) * T_table_sensor;
  std::vector<Vec3f> out;
  for (const Vec3f& p : points_at(sequence, position).cloud.points) {
    const Vec3d q = T * p.cast<double>();
    if (q.y() > 0.005 && std::hypot(q.x(), q.z()) < 0.05) out.push_back(q.cast<float>());
  }
  return out;
}

double median_between_views(const FrameSequence& sequence, std::size_t a, std::size_t b,
                            double sign) {
  const auto distances =
      nearest_distances(bear_view(sequence, a, sign), KdTree(bear_view(sequence, b, sign)));
  return distances.empty() ? 1.0 : distances[distances.size() / 2];
}

ImportOptions bear_options() {
  ImportOptions options;
  options.platter_height_m = 0.1e-3;
  options.turntable_radius_m = 0.12;
  return options;
}

TEST(BearData, NeighbouringViewsMeetWhenTheyAreTurnedBackByTheirAngles) {
  const auto folder = shared_data("d435_bear");
  TURNSCAN_NEEDS_DATA(folder);
  const auto sequence = open(folder, bear_options());
  ASSERT_EQ(sequence->frames().size(), 8u);
  EXPECT_LT(*sequence->frames()[1].angle_rad, -0.98);  // the platter turns clockwise from above
  EXPECT_LT(sequence->header().turntable->axis.y(), -0.8);
  for (const auto& [a, b] : {std::pair(2, 3), std::pair(3, 4), std::pair(6, 7)}) {
    EXPECT_LT(median_between_views(*sequence, a, b, 1.0), 1.5e-3) << a;
    EXPECT_GT(median_between_views(*sequence, a, b, -1.0), 5e-3) << a;
  }
}

TEST(BearData, PlatterLiesAtHeightZero) {
  const auto folder = shared_data("d435_bear");
  TURNSCAN_NEEDS_DATA(folder);
  const auto sequence = open(folder, bear_options());
  const Pose T = *table_from_sensor(*sequence->header().turntable);
  std::vector<double> heights;
  for (std::size_t i = 0; i < 8; ++i) {
    for (const Vec3f& p : points_at(*sequence, i).cloud.points) {
      const Vec3d q = T * p.cast<double>();
      const double r = std::hypot(q.x(), q.z());
      if (r > 0.08 && r < 0.12 && std::abs(q.y()) < 0.01) heights.push_back(q.y());
    }
  }
  std::sort(heights.begin(), heights.end());
  ASSERT_GT(heights.size(), 100000u);
  EXPECT_NEAR(heights[heights.size() / 2], 0.0, 0.3e-3);
}

TEST(BearData, WithoutThePlattersHeightItSaysSo) {
  const auto folder = shared_data("d435_bear");
  TURNSCAN_NEEDS_DATA(folder);
  const auto sequence = open(folder);
  EXPECT_THAT(sequence->header().source, HasSubstr("--platter-height"));
  EXPECT_EQ(frame_of(*sequence, 7).color.width, 640);
}

TEST(RoomData, FramesOverlapWhenTheyArePutByTheirPoses) {
  const auto folder = shared_data("kinect1_room");
  TURNSCAN_NEEDS_DATA(folder);
  EXPECT_EQ(refusal(folder).code, ErrorCode::kMissingData);
  ImportOptions options;
  options.depth_unit_m = 1e-3;
  const auto sequence = open(folder, options);
  ASSERT_EQ(sequence->frames().size(), 50u);
  EXPECT_EQ(sequence->frames()[0].index, 150u);
  std::vector<std::vector<Vec3f>> clouds;
  for (const std::size_t i : {0u, 5u}) {
    clouds.emplace_back();
    const Pose T = *sequence->frames()[i].T_table_sensor;
    for (const Vec3f& p : points_at(*sequence, i).cloud.points)
      clouds.back().push_back((T * p.cast<double>()).cast<float>());
  }
  const auto distances = nearest_distances(clouds[0], KdTree(clouds[1]));
  EXPECT_LT(distances[distances.size() / 2], 0.02);
}

}  // namespace
}  // namespace turnscan
