#include <cmath>
#include <numbers>
#include <tests/reconstruction/passes/lumpy_object.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/reconstruction/views/depth_window.hpp>
#include <turnscan/reconstruction/views/view_drawing.hpp>

namespace turnscan::testing {

namespace {

constexpr int kRows = 90, kColumns = 180;

views::DepthView view_of(const TriangleMesh& placed, double azimuth_rad) {
  const double elevation = 25.0 * std::numbers::pi / 180.0;
  const Vec3d to_sensor(std::cos(elevation) * std::cos(azimuth_rad), std::sin(elevation),
                        std::cos(elevation) * std::sin(azimuth_rad));
  const Vec3d sensor = Vec3d(0.0, 0.05, 0.0) + 0.8 * to_sensor;
  Pose T_table_view = Pose::Identity();
  T_table_view.linear().col(2) = -to_sensor;
  T_table_view.linear().col(0) = Vec3d::UnitY().cross(to_sensor).normalized();
  T_table_view.linear().col(1) = T_table_view.linear().col(2).cross(T_table_view.linear().col(0));
  T_table_view.translation() = sensor;
  views::DepthView view;
  view.fx = view.fy = 400.0f;
  view.width = view.height = 202;
  view.cx = view.cy = 101.0f;
  views::set_pose(view, T_table_view);
  const views::ViewDrawing drawing(view, placed);
  views::RawWindow raw(200, 200);
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) {
      const auto got = drawing.received(x + 1, y + 1);
      raw.at(x, y) =
          got.light > 0.0f ? std::uint16_t(std::lround(got.mean() / view.unit_m)) : kOutsideCrop;
    }
  }
  views::pack_window(raw, 0.012, view);
  return view;
}

}  // namespace

double lumpy_radius(const Vec3d& d) {
  return 0.06 + 0.012 * std::sin(3.1 * d.x() + 1.0) + 0.01 * std::cos(4.3 * d.y() - 2.0 * d.z()) +
         0.006 * std::sin(7.0 * d.z() + 3.0 * d.x());
}

double ball_radius(const Vec3d&) { return 0.06; }

double vase_radius(const Vec3d& d) { return 0.06 + 0.012 * std::cos(4.3 * d.y()) + 0.008 * d.y(); }

TriangleMesh star_mesh(const RadiusOf& radius) {
  TriangleMesh mesh;
  for (int r = 0; r <= kRows; ++r) {
    const double polar = std::numbers::pi * r / kRows;
    for (int c = 0; c < kColumns; ++c) {
      const double around = 2.0 * std::numbers::pi * c / kColumns;
      const Vec3d d(std::sin(polar) * std::cos(around), std::cos(polar),
                    std::sin(polar) * std::sin(around));
      mesh.vertices.push_back((radius(d) * d).cast<float>());
    }
  }
  for (std::uint32_t r = 0; r < kRows; ++r) {
    for (std::uint32_t c = 0; c < kColumns; ++c) {
      const std::uint32_t next = (c + 1) % kColumns, row = r * kColumns, below = row + kColumns;
      mesh.triangles.push_back({row + c, row + next, below + c});
      mesh.triangles.push_back({row + next, below + next, below + c});
    }
  }
  return mesh;
}

Pose set_down(const TriangleMesh& object, const Eigen::Matrix3d& rotation) {
  double lowest = 1e9;
  for (const Vec3f& p : object.vertices)
    lowest = std::min(lowest, (rotation * p.cast<double>()).y());
  Pose out = Pose::Identity();
  out.linear() = rotation;
  out.translation() = Vec3d(0.004, -lowest, -0.007);
  return out;
}

passes::PassSurface pass_of(const TriangleMesh& object, const Pose& T_table_object, double noise_m,
                            std::uint64_t seed) {
  TriangleMesh placed = object;
  for (Vec3f& p : placed.vertices) p = (T_table_object * p.cast<double>()).cast<float>();
  ObjectResult all;
  all.mesh = placed;
  passes::PassSurface out = passes::measured_surface(all), seen;
  for (std::size_t i = 0; i < out.points.size(); ++i) {
    if (out.normals[i].y() < -0.35f || out.points[i].y() < 0.004f) continue;
    const auto noise = float(noise_m * standard_normal(hash_key(seed, i)));
    seen.points.push_back(out.points[i] + noise * out.normals[i]);
    seen.normals.push_back(out.normals[i]);
    seen.areas.push_back(out.areas[i]);
    seen.weights.push_back(1.0f);
  }
  auto views = std::make_shared<std::vector<views::DepthView>>();
  for (int k = 0; k < 10; ++k) views->push_back(view_of(placed, 2.0 * std::numbers::pi * k / 10));
  seen.views = std::move(views);
  seen.floor_m = 0.0;
  seen.noise_m = 0.001;
  return seen;
}

}  // namespace turnscan::testing
