#include <turnscan/simulator/noise/noise_apply.hpp>

#include <algorithm>
#include <cmath>
#include <turnscan/simulator/noise/kinect_v2.hpp>

namespace turnscan::noise {

namespace {

/// Sets every pixel within radius of a set one, along a line of n pixels `stride` apart.
void spread(std::uint8_t* line, int n, std::ptrdiff_t stride, int radius, Mask& scratch) {
  scratch.assign(static_cast<std::size_t>(n), 0);
  int last = -radius - 1;
  for (int i = 0; i < n; ++i) {
    if (line[i * stride] != 0) last = i;
    if (i - last <= radius) scratch[std::size_t(i)] = 1;
  }
  last = n + radius;
  for (int i = n - 1; i >= 0; --i) {
    if (line[i * stride] != 0) last = i;
    if (last - i <= radius) scratch[std::size_t(i)] = 1;
  }
  for (int i = 0; i < n; ++i) line[i * stride] = scratch[std::size_t(i)];
}

/// Whether the depth of a row or column bends at the middle one of three.
bool bends(const SampleGrid& exact, const Mask& counts, std::size_t before, std::size_t here,
           std::size_t after) {
  if (counts[before] != counts[here] || counts[after] != counts[here]) return true;
  if (counts[here] == 0) return false;
  return std::abs(exact.z[before] - 2.0f * exact.z[here] + exact.z[after]) > kBend_m;
}

}  // namespace

Key Job::key_of(std::uint64_t purpose) const {
  const std::uint64_t a = seed_of(purpose), b = mix64(a);
  return {std::uint32_t(a), std::uint32_t(a >> 32), std::uint32_t(b), std::uint32_t(b >> 32)};
}

Surfaces::Surfaces(const SensorView& view) : view_(view) {
  R_sensor_body_.reserve(view.bodies.size());
  for (const Body& body : view.bodies)
    R_sensor_body_.emplace_back(view.T_world_sensor.linear().transpose() *
                                body.T_world_body.linear());
}

Vec3d Surfaces::normal(const Samples& samples, std::size_t i) const {
  const std::uint32_t body = samples.body(i);
  if (samples.object(i) == kPlatter) return R_sensor_body_[body].col(1);
  const auto c = view_.bodies[body].scene->corners(samples.object(i), samples.triangle[i]);
  const Vec3d a = c[0].cast<double>();
  const Vec3d n = (c[1].cast<double>() - a).cross(c[2].cast<double>() - a);
  const double length2 = n.squaredNorm();
  if (!(length2 > 0.0)) return Vec3d::Zero();
  return R_sensor_body_[body] * n / std::sqrt(length2);
}

double Surfaces::facing(const Samples& samples, std::size_t i, double x, double y) const {
  const Vec3d d(x, y, 1.0);
  return std::min(std::abs(normal(samples, i).dot(d)) / d.norm(), 1.0);
}

double Surfaces::albedo(const Samples& samples, std::size_t i) const {
  if (view_.albedo == nullptr || !*view_.albedo) return kDefaultAlbedo;
  return (*view_.albedo)(samples.body(i), samples.object(i), samples.triangle[i]);
}

Mask steps_of(const SampleGrid& exact, const Mask& counts, int radius) {
  const int w = exact.rect.width(), h = exact.rect.height();
  const auto stride = static_cast<std::size_t>(w);
  Mask steps(exact.size(), 0);
  // Pixels outside the rectangle see nothing, and so do its outermost pixels, unless it ends with
  // the image.
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      const std::size_t i = std::size_t(y) * stride + std::size_t(x);
      const bool across = x > 0 && x + 1 < w && bends(exact, counts, i - 1, i, i + 1);
      const bool along = y > 0 && y + 1 < h && bends(exact, counts, i - stride, i, i + stride);
      steps[i] = across || along ? 1 : 0;
    }
  }
  if (radius <= 0) return steps;
  Mask scratch;
  for (int y = 0; y < h; ++y) spread(&steps[std::size_t(y) * stride], w, 1, radius, scratch);
  for (int x = 0; x < w; ++x) spread(&steps[std::size_t(x)], h, w, radius, scratch);
  return steps;
}

void SubSamples::add(const Setup& setup, int column, int row, std::size_t index_in_grid, int side,
                     double footprint_px, double du, double dv) {
  index.push_back(static_cast<std::uint32_t>(index_in_grid));
  each = std::size_t(side) * std::size_t(side);
  // Directions change linearly within a few pixels.
  const CameraIntrinsics& camera = setup.model.camera;
  const int left = std::clamp(column, 0, std::max(camera.width - 2, 0));
  const int top = std::clamp(row, 0, std::max(camera.height - 2, 0));
  const std::vector<float>&rx = setup.rays.x(), &ry = setup.rays.y();
  const std::size_t here = setup.pixel(column, row), corner = setup.pixel(left, top);
  const std::size_t right = setup.pixel(std::min(left + 1, camera.width - 1), top);
  const std::size_t below = setup.pixel(left, std::min(top + 1, camera.height - 1));
  // A line scanner has one column: its focal length gives the step across it.
  const double xu = right != corner ? double(rx[right]) - rx[corner] : 1.0 / camera.fx;
  const double yv = below != corner ? double(ry[below]) - ry[corner] : 1.0 / camera.fy;
  const double yu = right != corner ? double(ry[right]) - ry[corner] : 0.0;
  const double xv = below != corner ? double(rx[below]) - rx[corner] : 0.0;
  for (int j = 0; j < side; ++j) {
    for (int k = 0; k < side; ++k) {
      const double u = du + footprint_px * ((k + 0.5) / side - 0.5);
      const double v = dv + footprint_px * ((j + 0.5) / side - 0.5);
      x.push_back(static_cast<float>(rx[here] + u * xu + v * xv));
      y.push_back(static_cast<float>(ry[here] + u * yu + v * yv));
    }
  }
}

double predicted_sigma_m(const Setup& s, double z_m, double incidence_rad, double albedo) {
  if (s.options.kind == NoiseKind::kNone) return 0.0;
  if (s.options.kind == NoiseKind::kGaussian) return s.options.sigma_m;
  if (s.options.kind == NoiseKind::kPhysics && s.model.noise.physics == SensorPhysics::kKinectV2)
    return kinect_v2::sigma_m(s.model.noise, z_m, incidence_rad, albedo);
  return turnscan::predicted_sigma_m(s.model.noise, s.focal_baseline, z_m, incidence_rad, albedo);
}

void predict(Job& job) {
  const PixelRect& r = job.exact.rect;
  const Surfaces surfaces(job.view);
  job.out.sigma_m.assign(job.exact.size(), 0.0f);
  for (int v = r.top; v < r.bottom; ++v) {
    for (int u = r.left; u < r.right; ++u) {
      const std::size_t i = job.exact.index(u, v), pixel = job.setup.pixel(u, v);
      if (!job.exact.counts(i)) continue;
      const double facing =
          surfaces.facing(job.exact, i, job.setup.rays.x()[pixel], job.setup.rays.y()[pixel]);
      const double sigma = predicted_sigma_m(job.setup, job.exact.z[i], std::acos(facing),
                                             surfaces.albedo(job.exact, i));
      job.out.sigma_m[i] = std::isfinite(sigma) ? static_cast<float>(sigma) : 0.0f;
    }
  }
}

}  // namespace turnscan::noise
