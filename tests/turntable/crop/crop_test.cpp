#include <gtest/gtest.h>

#include <turnscan/core/random.hpp>
#include <turnscan/turntable/crop/crop.hpp>
#include <turnscan/turntable/table_frame.hpp>

namespace turnscan {
namespace {

Vec3f random_point(std::uint64_t i) {
  return Vec3f(float(uniform01(hash_key(1, i, 0)) - 0.5), float(uniform01(hash_key(1, i, 1)) - 0.5),
               float(0.5 + uniform01(hash_key(1, i, 2))));
}

/// Thesis eq. 3.5 to 3.7, as printed.
bool thesis_keeps(const Vec3d& p, const TurntableInfo& t, double margin, double radius) {
  const Vec3d d = p - t.center_m;
  const double along = d.dot(t.axis);
  return along > margin && d.squaredNorm() - along * along < radius * radius;
}

TEST(Crop, KeepsWhatTheThesisEquationsKeep) {
  TurntableInfo table;
  table.axis = Vec3d(0.1, -0.9, -0.5).normalized();
  table.center_m = Vec3d(0.05, 0.1, 0.9);
  const Pose pose = *table_from_sensor(table);
  Cylinder cylinder;
  cylinder.margin_m = 0.01;
  cylinder.radius_m = 0.3;
  cylinder.height_m = 10.0;
  const SensorCrop crop(cylinder, pose);
  int kept = 0;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const Vec3f p = random_point(i);
    const bool expected = thesis_keeps(p.cast<double>(), table, 0.01, 0.3);
    kept += expected ? 1 : 0;
    EXPECT_EQ(crop.keeps(p), expected) << p.transpose();
  }
  EXPECT_GT(kept, 1000);
  EXPECT_LT(kept, 19000);
}

TEST(Crop, KeepsCellsAndColoursWithTheirPoints) {
  FramePoints points;
  points.width = 3;
  points.height = 1;
  for (int i = 0; i < 3; ++i) {
    points.cloud.points.emplace_back(0.0f, i == 1 ? -1.0f : 0.1f, 0.0f);
    points.cloud.colors.push_back({std::uint8_t(i), 0, 0});
    points.cell.push_back(i);
  }
  const FramePoints out = crop(points, SensorCrop(Cylinder(), Pose::Identity()));
  ASSERT_EQ(out.cloud.size(), 2u);
  EXPECT_EQ(out.cell, (std::vector<std::int32_t>{0, 2}));
  EXPECT_EQ(out.cloud.colors[1].r, 2);
}

TEST(CropOptions, RefuseNaNAndNegativeRadius) {
  CropOptions options;
  options.radius_m = std::nan("");
  EXPECT_FALSE(describe(options).check());
  options.radius_m = -1.0;
  EXPECT_FALSE(describe(options).check());
  options.radius_m = 0.1;
  EXPECT_TRUE(describe(options).check());
}

TEST(MeasurePlatter, FindsHeightAndSpreadUnderAnObject) {
  std::vector<Vec3f> points;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const float y = float(0.002 + 0.0005 * standard_normal(hash_key(2, i)));
    points.emplace_back(float(0.2 * uniform01(hash_key(3, i)) - 0.1), y, 0.0f);
  }
  for (int i = 0; i < 5000; ++i) points.emplace_back(0.0f, 0.003f * float(i) / 1000.0f, 0.0f);
  const PlatterReturns platter = measure_platter(points, 0.2);
  EXPECT_NEAR(platter.height_m, 0.002, 0.0002);
  EXPECT_NEAR(platter.sigma_m, 0.0005, 0.0001);
}

TEST(MeasurePlatter, SaysNothingWithoutReturns) {
  EXPECT_EQ(measure_platter({}, 0.2).count, 0u);
  EXPECT_EQ(measure_platter(std::vector<Vec3f>(100, Vec3f::Zero()), 0.2).count, 0u);
}

TEST(MeasurePlatter, TakesFeetAndWallsForNoPlatter) {
  for (const double lowest_m : {-0.015, -0.005, 0.0}) {
    std::vector<Vec3f> walls;
    for (std::uint64_t i = 0; i < 5000; ++i)
      walls.emplace_back(0.05f, float(lowest_m + 0.08 * uniform01(hash_key(11, i))), 0.0f);
    const PlatterReturns returns = measure_platter(walls, 0.2);
    EXPECT_GT(returns.count, 0u);
    EXPECT_FALSE(returns.plane()) << returns.dense_share;
    EXPECT_FALSE(find_platter_radius(walls, returns));
  }
}

TEST(MeasurePlatter, TakesAnObjectThatWidensUpwardsForNoPlatter) {
  std::vector<Vec3f> body;
  for (std::uint64_t i = 0; i < 5000; ++i) {
    const double up = std::sqrt(std::sqrt(uniform01(hash_key(13, i))));
    body.emplace_back(0.05f, float(-0.015 + 0.05 * up), 0.0f);
  }
  const PlatterReturns returns = measure_platter(body, 0.2);
  EXPECT_GT(returns.dense_share, 0.25);
  EXPECT_FALSE(returns.plane()) << returns.height_m << " " << returns.sigma_m;
}

TEST(MeasurePlatter, TakesAWideObjectThatIsCurvedForNoPlatter) {
  std::vector<Vec3f> body;
  for (std::uint64_t i = 0; i < 5000; ++i)
    body.emplace_back(0.05f, float(0.007 + 0.0035 * standard_normal(hash_key(14, i))), 0.0f);
  const PlatterReturns returns = measure_platter(body, 0.2);
  EXPECT_GT(returns.dense_share, 0.25);
  EXPECT_FALSE(returns.plane(0.002)) << returns.sigma_m;
  EXPECT_TRUE(returns.plane()) << "a platter that a distant sensor sees as thick";
}

TEST(MeasurePlatter, TakesANoisyPlatterForAPlane) {
  std::vector<Vec3f> points;
  for (std::uint64_t i = 0; i < 5000; ++i)
    points.emplace_back(0.05f, float(0.003 * standard_normal(hash_key(12, i))), 0.0f);
  EXPECT_TRUE(measure_platter(points, 0.2).plane());
}

/// A platter of 12 cm on a table that lies 2 cm lower.
std::vector<Vec3f> platter_on_a_table() {
  std::vector<Vec3f> points;
  for (std::uint64_t i = 0; i < 200000; ++i) {
    const double x = uniform01(hash_key(6, i, 0)) - 0.5, z = uniform01(hash_key(6, i, 1)) - 0.5;
    const double y = std::hypot(x, z) < 0.12 ? 0.0 : -0.02;
    points.emplace_back(float(x), float(y + 0.0005 * standard_normal(hash_key(7, i))), float(z));
  }
  return points;
}

TEST(FindPlatterRadius, FindsWhereThePlatterEnds) {
  const auto points = platter_on_a_table();
  const auto radius = find_platter_radius(points, measure_platter(points, 0.5));
  ASSERT_TRUE(radius);
  EXPECT_NEAR(*radius, 0.12, 0.005);
}

TEST(FindPlatterRadius, RefusesToGuessWithoutReturns) {
  EXPECT_FALSE(find_platter_radius({}, PlatterReturns()));
}

}  // namespace
}  // namespace turnscan
