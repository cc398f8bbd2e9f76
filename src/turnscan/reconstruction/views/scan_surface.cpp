#include <algorithm>
#include <cmath>
#include <numbers>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/search/knn.hpp>
#include <turnscan/reconstruction/views/depth_window.hpp>
#include <turnscan/reconstruction/views/scan_surface.hpp>

namespace turnscan::views {

namespace {

/// Rows x, y, z of a frame in which the viewpoint looks at `center` along z.
Eigen::Matrix3d facing(const Viewpoint& viewpoint, const Vec3d& center) {
  const Vec3d towards = viewpoint.direction_from(center);
  const Vec3d z = -(towards.norm() > 0.5 ? towards : Vec3d(0, 0, -1));
  const Vec3d x = z.unitOrthogonal();
  Eigen::Matrix3d rows;
  rows.row(0) = x, rows.row(1) = z.cross(x), rows.row(2) = z;
  return rows;
}

/// Rasterises the triangles of a range scan into a depth image with a z-buffer.
class ScanResampler {
 public:
  ScanResampler(const ScanSurface& surface, double pixel_m) : surface_(surface) {
    const Box box = bounds(surface.points);
    const Vec3d center = box.center();
    rotation_ = facing(surface.viewpoint, center);
    const Vec3d z = rotation_.row(2);
    parallel_ = surface.viewpoint.parallel;
    const double away = parallel_ ? 0.0 : (center - surface.viewpoint.value).norm();
    origin_ = parallel_ ? center - (box.size().norm() + 0.01) * z : surface.viewpoint.value;
    focal_ = parallel_ ? 1.0 / pixel_m : std::max(away, pixel_m) / pixel_m;
    project();
  }

  bool usable() const { return width_ > 0; }

  void draw(double edge_step_m) {
    z_ = Image<float>(width_, height_, 0.0f);
    count_ = Image<std::uint16_t>(width_, height_, 0);
    source_ = Image<std::uint32_t>(width_, height_, 0);
    for (const auto& [a, b, c] : surface_.triangles) triangle(a, b, c, edge_step_m);
    for (std::size_t i = 0; i < image_.size(); ++i) dot(std::uint32_t(i));
  }

  DepthView view(const Pose& T_table_sensor, double edge_step_m) const {
    DepthView view;
    view.parallel = parallel_;
    view.fx = view.fy = static_cast<float>(focal_);
    view.cx = static_cast<float>(1.0 - u0_);
    view.cy = static_cast<float>(1.0 - v0_);
    float low = 1e30f, high = 0.0f;
    for (const float z : z_.pixels) {
      if (z > 0.0f) low = std::min(low, z), high = std::max(high, z);
    }
    view.unit_m = std::max(high - low, 1e-4f) / 65000.0f;
    view.bias_m = low - view.unit_m;  // the nearest one has raw value 1
    RawWindow raw(width_, height_);
    for (std::size_t i = 0; i < raw.pixels.size(); ++i) {
      if (z_.pixels[i] > 0.0f)
        raw.pixels[i] = std::uint16_t(std::lround((z_.pixels[i] - view.bias_m) / view.unit_m));
    }
    Pose T_sensor_view = Pose::Identity();
    T_sensor_view.linear() = rotation_.transpose();
    T_sensor_view.translation() = origin_;
    set_pose(view, T_table_sensor * T_sensor_view);
    pack_window(raw, edge_step_m, view);
    if (!surface_.colors.empty()) take_colors(view);
    return view;
  }

 private:
  void take_colors(DepthView& view) const {
    view.colors.assign(view.pixels.size(), Rgb());
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        if (z_.at(x, y) > 0.0f)
          view.colors[std::size_t(y + 1) * std::size_t(view.width) + std::size_t(x + 1)] =
              surface_.colors[source_.at(x, y)];
      }
    }
  }

  static constexpr int kMaxSide = 4096;

  void project() {
    double u1 = -1e30, v1 = -1e30;
    for (const Vec3f& p : surface_.points) {
      const Vec3d q = rotation_ * (p.cast<double>() - origin_);
      const double scale = parallel_ ? focal_ : focal_ / q.z();
      const bool good = q.z() > 1e-6;
      image_.emplace_back(good ? q.x() * scale : 0.0, good ? q.y() * scale : 0.0,
                          good ? q.z() : 0.0);
      if (!good) continue;
      u0_ = std::min(u0_, std::floor(image_.back().x()));
      v0_ = std::min(v0_, std::floor(image_.back().y()));
      u1 = std::max(u1, image_.back().x());
      v1 = std::max(v1, image_.back().y());
    }
    if (!(u1 - u0_ < kMaxSide) || !(v1 - v0_ < kMaxSide) || u1 < u0_) return;
    width_ = int(u1 - u0_) + 2;
    height_ = int(v1 - v0_) + 2;
    for (Vec3d& q : image_) q.x() -= u0_, q.y() -= v0_;
  }

  void put(int x, int y, double z, double step_m, std::uint32_t source) {
    float& own = z_.at(x, y);
    std::uint16_t& count = count_.at(x, y);
    if (count == 0 || z < double(own) - step_m) {
      own = static_cast<float>(z);
      count = 1;
      source_.at(x, y) = source;
    } else if (z <= double(own) + step_m && count < 1000) {
      ++count;
      own += (static_cast<float>(z) - own) / float(count);
    }
  }

  void dot(std::uint32_t i) {
    const Vec3d& q = image_[i];
    const int x = int(std::lround(q.x())), y = int(std::lround(q.y()));
    if (q.z() > 0.0 && z_.at(x, y) == 0.0f) put(x, y, q.z(), 0.0, i);
  }

  void triangle(std::uint32_t ia, std::uint32_t ib, std::uint32_t ic, double step_m) {
    const Vec3d &a = image_[ia], &b = image_[ib], &c = image_[ic];
    const double low = std::min({a.z(), b.z(), c.z()}), high = std::max({a.z(), b.z(), c.z()});
    const double area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    if (low <= 0.0 || high - low > step_m || std::abs(area) < 1e-12) return;
    const int x0 = int(std::ceil(std::min({a.x(), b.x(), c.x()})));
    const int x1 = int(std::floor(std::max({a.x(), b.x(), c.x()})));
    const int y0 = int(std::ceil(std::min({a.y(), b.y(), c.y()})));
    const int y1 = int(std::floor(std::max({a.y(), b.y(), c.y()})));
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const double s = ((x - a.x()) * (c.y() - a.y()) - (y - a.y()) * (c.x() - a.x())) / area;
        const double t = ((b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x())) / area;
        if (s < 0.0 || t < 0.0 || s + t > 1.0) continue;
        // In perspective 1 / z is linear in the image.
        const double z = parallel_ ? a.z() + s * (b.z() - a.z()) + t * (c.z() - a.z())
                                   : 1.0 / ((1.0 - s - t) / a.z() + s / b.z() + t / c.z());
        put(x, y, z, step_m, 1.0 - s - t >= std::max(s, t) ? ia : s >= t ? ib : ic);
      }
    }
  }

  const ScanSurface& surface_;
  Eigen::Matrix3d rotation_;
  Vec3d origin_ = Vec3d::Zero();
  double focal_ = 1.0, u0_ = 1e30, v0_ = 1e30;
  bool parallel_ = false;
  int width_ = 0, height_ = 0;
  std::vector<Vec3d> image_;  // u, v from the window's corner, z
  Image<float> z_;
  Image<std::uint16_t> count_;   // of triangles
  Image<std::uint32_t> source_;  // the point nearest to the surface drawn first
};

/// Points projected to the plane through their centre that faces the viewpoint.
std::vector<Vec3f> image_plane_points(const ScanSurface& s) {
  const Vec3d center = bounds(s.points).center();
  const Eigen::Matrix3d rotation = facing(s.viewpoint, center);
  const Vec3d x = rotation.row(0), y = rotation.row(1), z = rotation.row(2);
  const double away = s.viewpoint.parallel ? 0.0 : (center - s.viewpoint.value).dot(z);
  std::vector<Vec3f> out;
  for (const Vec3f& p : s.points) {
    Vec3d d = p.cast<double>() - (s.viewpoint.parallel ? center : s.viewpoint.value);
    if (!s.viewpoint.parallel) d *= away / std::max(d.dot(z), 1e-6);
    out.emplace_back(float(x.dot(d)), float(y.dot(d)), 0.0f);
  }
  return out;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangle_fans(const ScanSurface& surface,
                                                        double longest_m) {
  constexpr std::size_t kAround = 12;
  const auto& p = surface.points;
  const std::vector<Vec3f> seen = image_plane_points(surface);
  const KdTree tree(seen);
  std::vector<std::vector<std::array<std::uint32_t, 3>>> own(p.size());
  parallel_for(p.size(), 256, [&](std::size_t i) {
    std::array<std::uint32_t, kAround + 1> index;
    std::array<float, kAround + 1> squared;
    const std::size_t found = tree.knn(seen[i], kAround + 1, index.data(), squared.data());
    std::vector<std::pair<float, std::uint32_t>> around;
    for (std::size_t n = 0; n < found; ++n) {
      const Vec3f d = seen[index[n]] - seen[i];
      if (index[n] == i || !(d.norm() > 0.0f) || (p[index[n]] - p[i]).norm() > float(longest_m))
        continue;
      around.emplace_back(std::atan2(d.y(), d.x()), index[n]);
    }
    std::sort(around.begin(), around.end());
    for (std::size_t n = 0; n < around.size() && around.size() > 1; ++n) {
      const auto& [angle, a] = around[n];
      const auto& [next, b] = around[(n + 1) % around.size()];
      const float turn =
          next - angle + (n + 1 == around.size() ? 2.0f * float(std::numbers::pi) : 0.0f);
      if (turn < 2.2f && (p[a] - p[b]).norm() <= float(longest_m))
        own[i].push_back({std::uint32_t(i), a, b});
    }
  });
  std::vector<std::array<std::uint32_t, 3>> out;
  for (const auto& fan : own) out.insert(out.end(), fan.begin(), fan.end());
  return out;
}

DepthView view_of_surface(const ScanSurface& surface, const Pose& T_table_sensor, double pixel_m,
                          double edge_step_m) {
  ScanResampler resampler(surface, pixel_m);
  if (!resampler.usable()) return {};
  resampler.draw(edge_step_m);
  return resampler.view(T_table_sensor, edge_step_m);
}

}  // namespace turnscan::views
