#pragma once
// Walls before a scanner that stands at the origin and looks along z, and what it measures.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <turnscan/geometry/rays/scene.hpp>
#include <turnscan/simulator/noise/noise.hpp>
#include <turnscan/simulator/sampling/samples.hpp>
#include <vector>

namespace turnscan::test {

/// A square of side 2 * half about (0, 0, z), turned by `tilt` about the y axis.
inline TriangleMesh wall(double z, double tilt = 0.0, double half = 20.0) {
  TriangleMesh mesh;
  for (const auto& [a, b] : {std::pair(-1.0, -1.0), {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}})
    mesh.vertices.emplace_back(float(a * half * std::cos(tilt)), float(b * half),
                               float(z + a * half * std::sin(tilt)));
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// The half of a wall left of x = edge + slope * y, upright.
inline TriangleMesh half_wall(double z, double edge, double slope = 0.0) {
  TriangleMesh mesh;
  mesh.vertices = {
      Vec3f(-20.0f, -20.0f, float(z)), Vec3f(float(edge - 20.0 * slope), -20.0f, float(z)),
      Vec3f(float(edge + 20.0 * slope), 20.0f, float(z)), Vec3f(-20.0f, 20.0f, float(z))};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

inline ScannerModel camera(int width, int height, double focal) {
  ScannerModel m;
  m.name = "test";
  m.camera.width = width;
  m.camera.height = height;
  m.camera.fx = m.camera.fy = focal;
  m.camera.cx = 0.5 * (width - 1);
  m.camera.cy = 0.5 * (height - 1);
  m.near_m = 0.1;
  m.far_m = 10.0;
  m.max_incidence_rad = 1.55;
  return m;
}

/// A scanner at the origin, walls, and the exact samples of them.
class Bench {
 public:
  Bench(const ScannerModel& model, const std::vector<TriangleMesh>& walls)
      : model_(model),
        scene_(Scene::create(walls).value()),
        tracer_(SampleTracer::create(model).value()),
        bodies_{{&scene_, Pose::Identity()}} {
    tracer_.trace(bodies_, pose_, exact_);
  }

  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  void set_albedo(const Albedo& albedo) { albedo_ = albedo; }
  SensorView view() const { return {tracer_, bodies_, pose_, albedo_ ? &albedo_ : nullptr}; }
  const SampleGrid& exact() const { return exact_; }
  const ScannerModel& model() const { return model_; }
  Vec3d direction(std::size_t i) const {
    const auto w = std::size_t(exact_.rect.width());
    return tracer_.direction(double(exact_.rect.left) + double(i % w),
                             double(exact_.rect.top) + double(i / w));
  }
  double incidence(std::size_t i) const {
    return tracer_.hit_of(bodies_, pose_, exact_, i, direction(i)).incidence_rad;
  }

  MeasuredGrid measure(const NoiseOptions& options, std::uint32_t frame = 0, std::uint64_t seed = 1,
                       std::uint32_t scanner = 0, bool with_sigma = false) const {
    const auto noise = SensorNoise::create(model_, options, seed, scanner);
    EXPECT_TRUE(noise) << (noise ? "" : noise.error().message);
    MeasuredGrid out;
    noise->apply(view(), exact_, frame, out, with_sigma);
    return out;
  }

 private:
  ScannerModel model_;
  Scene scene_;
  SampleTracer tracer_;
  std::vector<Body> bodies_;
  Pose pose_ = Pose::Identity();
  Albedo albedo_;
  SampleGrid exact_;
};

struct Spread {
  double mean = 0.0, sigma = 0.0;
  int n = 0;
};

/// Of value(i) over all i that have one (not NaN).
inline Spread spread_of(std::size_t n, const std::function<double(std::size_t)>& value) {
  double sum = 0.0, squares = 0.0;
  Spread s;
  for (std::size_t i = 0; i < n; ++i) {
    const double v = value(i);
    if (std::isnan(v)) continue;
    sum += v;
    squares += v * v;
    ++s.n;
  }
  s.mean = sum / s.n;
  s.sigma = std::sqrt(std::max(squares / s.n - s.mean * s.mean, 0.0));
  return s;
}

inline NoiseOptions noise_of(const char* text) { return parse_noise_options(text).value(); }

}  // namespace turnscan::test
