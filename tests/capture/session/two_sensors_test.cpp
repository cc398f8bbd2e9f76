#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>
#include <turnscan/capture/session/taken_frames.hpp>
#include <turnscan/capture/source/frame_source.hpp>
#include <turnscan/geometry/search/closest_point.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/turntable/crop/crop.hpp>
#include <turnscan/turntable/detection/average.hpp>
#include <turnscan/turntable/detection/detect.hpp>
#include <turnscan/turntable/table_frame.hpp>
#include "tests/support/sanitizers.hpp"

namespace turnscan {
namespace {

using Cell = std::tuple<int, int, int>;

Cell cell_of(const Vec3f& p, double size_m) {
  return {int(std::floor(p.x() / size_m)), int(std::floor(p.y() / size_m)),
          int(std::floor(p.z() / size_m))};
}

/// Positive outside, by the side of the nearest triangle.
double signed_distance(const MeshDistance& truth, const TriangleMesh& mesh, const Vec3d& p) {
  const MeshDistance::Hit hit = truth.closest(p);
  const auto& t = mesh.triangles[hit.triangle];
  const Vec3d a = mesh.vertices[t[0]].cast<double>(), b = mesh.vertices[t[1]].cast<double>(),
              c = mesh.vertices[t[2]].cast<double>();
  return (p - hit.point).dot((b - a).cross(c - a)) < 0.0 ? -hit.distance : hit.distance;
}

/// Points of each sensor in the table's frame at angle 0, by a calibration of its own.
struct Merged {
  std::vector<Vec3f> points[2];
};

Merged merged() {
  const std::string base =
      "virtual:doll?noise=gaussian:1mm&frames=60&angles=1&room=desk&aim-height=60mm";
  auto source = open_sources(
      {base + "&elevation=12deg", base + "&elevation=50deg&seed=2&serial=1&clock=3s"}, {});
  EXPECT_TRUE(source) << (source ? "" : source.error().text());
  const auto frames = take_frames(**source, 60, {});
  if (!frames) throw std::runtime_error(frames.error().text());
  Merged out;
  for (std::uint32_t k = 0; k < 2; ++k) {
    const auto scan =
        average_frames(**frames, spread_positions(**frames, k, 60), AverageOptions(), {});
    const auto platter = detect_platter(*scan, {}, {});
    EXPECT_TRUE(platter) << (platter ? "" : platter.error().text());
    const TurntableInfo table = calibration_of(*platter, *scan).table;
    const Pose T_table_sensor = table_from_sensor(table).value();
    const SensorInfo& sensor = (*frames)->header().sensors[k];
    const RayTable rays(sensor.intrinsics);
    const SensorCrop cylinder({0.006, 0.6, *table.radius_m - 0.005}, T_table_sensor);
    for (std::size_t i = 0; i < (*frames)->frames().size(); ++i) {
      const FrameInfo& info = (*frames)->frames()[i];
      if (info.sensor != k) continue;
      const Pose T = rotation_about_y(-*info.angle_rad) * T_table_sensor;
      const Frame frame = (*frames)->read(i).value();
      for (const Vec3f& p : crop(points_of(frame, sensor, rays).value(), cylinder).cloud.points)
        out.points[k].push_back((T * p.cast<double>()).cast<float>());
    }
  }
  return out;
}

TEST(TwoSensors, CoverMoreThanOneAndAgreeWhereBothSee) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const Merged both = merged();
  // What is covered: cells of 4 mm with three points.
  std::map<Cell, int> counts[3];
  for (int k = 0; k < 2; ++k)
    for (const Vec3f& p : both.points[k]) {
      ++counts[k][cell_of(p, 0.004)];
      ++counts[2][cell_of(p, 0.004)];
    }
  std::size_t covered[3] = {};
  for (int k = 0; k < 3; ++k)
    for (const auto& [cell, count] : counts[k]) covered[k] += count >= 3 ? 1 : 0;
  EXPECT_GT(double(covered[2]), 1.05 * double(std::max(covered[0], covered[1])));

  // Where both see the same 6 mm: how far their mean distances from the true surface differ.
  const TriangleMesh mesh = builtin_object("doll").value();
  const MeshDistance truth(mesh);
  struct Sum {
    double value[2] = {};
    int count[2] = {};
  };
  std::map<Cell, Sum> sums;
  for (int k = 0; k < 2; ++k)
    for (const Vec3f& p : both.points[k]) {
      const Cell cell = cell_of(p, 0.006);
      if ((std::get<0>(cell) + std::get<1>(cell) + std::get<2>(cell)) % 4 != 0) continue;  // enough
      Sum& sum = sums[cell];
      sum.value[k] += signed_distance(truth, mesh, p.cast<double>());
      ++sum.count[k];
    }
  std::vector<double> differences;
  for (const auto& [cell, sum] : sums)
    if (sum.count[0] >= 40 && sum.count[1] >= 40)
      differences.push_back(std::abs(sum.value[0] / sum.count[0] - sum.value[1] / sum.count[1]));
  ASSERT_GT(differences.size(), 100u);
  std::nth_element(differences.begin(), differences.begin() + long(differences.size() / 2),
                   differences.end());
  EXPECT_LT(differences[differences.size() / 2], 0.0005);
  RecordProperty("median_um", int(1e6 * differences[differences.size() / 2]));
  RecordProperty("covered_one", int(std::max(covered[0], covered[1])));
  RecordProperty("covered_both", int(covered[2]));
}

}  // namespace
}  // namespace turnscan
