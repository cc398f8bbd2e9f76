#include <algorithm>
#include <cmath>
#include <turnscan/reconstruction/depth_view.hpp>

namespace turnscan {

namespace {

/// Depths of a window as they come; what is not known is kNoReturn, what is only known to be empty
/// kOutsideCrop.
using RawWindow = Image<std::uint16_t>;

constexpr std::uint32_t kFar = 65534;  // stands for "empty as far as it matters"

bool measured(std::uint16_t raw) { return raw != kNoReturn && raw != kOutsideCrop; }

/// Whether a neighbour is so much farther that the pixel may hold a mixture of both.
bool beside_edge(const RawWindow& raw, int x, int y, int step) {
  const int own = raw.at(x, y);
  constexpr std::array<std::array<int, 2>, 4> kSides{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  return std::any_of(kSides.begin(), kSides.end(), [&](const auto& side) {
    const int u = x + side[0], v = y + side[1];
    if (u < 0 || v < 0 || u >= raw.width || v >= raw.height) return true;
    const std::uint16_t other = raw.at(u, v);
    return !measured(other) || int(other) > own + step;
  });
}

/// The least depth of the pixel and those around it: a pixel beside an edge may look past it.
std::uint32_t clear_depth(const RawWindow& raw, int x, int y) {
  if (raw.at(x, y) == kNoReturn) return 0;
  std::uint32_t least = kFar;
  for (int v = std::max(0, y - 1); v <= std::min(raw.height - 1, y + 1); ++v) {
    for (int u = std::max(0, x - 1); u <= std::min(raw.width - 1, x + 1); ++u) {
      if (measured(raw.at(u, v))) least = std::min<std::uint32_t>(least, raw.at(u, v));
    }
  }
  return least;
}

void make_tiles(DepthView& view) {
  view.tiles_x = (view.width + DepthView::kTile - 1) / DepthView::kTile;
  view.tiles_y = (view.height + DepthView::kTile - 1) / DepthView::kTile;
  view.tiles.assign(std::size_t(view.tiles_x) * std::size_t(view.tiles_y), {});
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const std::uint32_t word = view.pixels[std::size_t(y) * std::size_t(view.width) + x];
      DepthView::Tile& tile = view.tiles[std::size_t(y / DepthView::kTile) * view.tiles_x +
                                         std::size_t(x / DepthView::kTile)];
      const auto depth = std::uint16_t(word & 0xffffu), clear = std::uint16_t(word >> 17 << 1);
      if (depth != 0) {
        tile.nearest = std::min(tile.nearest, depth);
        tile.farthest = std::max(tile.farthest, depth);
      }
      tile.clear = std::min(tile.clear, clear);
      tile.clear_most = std::max(tile.clear_most, clear);
    }
  }
}

/// Fills pixels and tiles from a window.
void pack_window(const RawWindow& raw, double edge_step_m, DepthView& view) {
  const int step = int(std::lround(edge_step_m / double(view.unit_m)));
  view.width = raw.width + 2;
  view.height = raw.height + 2;
  view.pixels.assign(std::size_t(view.width) * std::size_t(view.height), 0);
  for (int y = 0; y < raw.height; ++y) {
    for (int x = 0; x < raw.width; ++x) {
      const std::uint16_t own = raw.at(x, y);
      const std::uint32_t depth = measured(own) ? own : 0u;
      view.pixels[std::size_t(y + 1) * std::size_t(view.width) + std::size_t(x + 1)] =
          DepthView::pack(depth, depth != 0 && beside_edge(raw, x, y, step),
                          clear_depth(raw, x, y));
    }
  }
  make_tiles(view);
}

void set_pose(DepthView& view, const Pose& T_table_view) {
  const Pose inverse = T_table_view.inverse();
  view.rotation = inverse.linear().cast<float>();
  view.translation = inverse.translation().cast<float>();
}

struct PixelBox {
  int x0 = 1 << 30, y0 = 1 << 30, x1 = -1, y1 = -1;
  void add(int x, int y) {
    x0 = std::min(x0, x), x1 = std::max(x1, x);
    y0 = std::min(y0, y), y1 = std::max(y1, y);
  }
  /// A rim around it shows where the surroundings are empty.
  void widen(int by, int width, int height) {
    x0 = std::max(0, x0 - by), y0 = std::max(0, y0 - by);
    x1 = std::min(width - 1, x1 + by), y1 = std::min(height - 1, y1 + by);
  }
  bool empty() const { return x1 < x0; }
  int width() const { return x1 - x0 + 1; }
  int height() const { return y1 - y0 + 1; }
};

constexpr int kRim = 6;  // pixels

DepthView view_of_depth(const Frame& frame, const SensorInfo& sensor, const RayTable& rays,
                        const Pose& T_table_sensor, const ViewScale& scale, const KeepPoint& keep) {
  const DepthImage& depth = frame.depth;
  DepthView view;
  PixelBox box;
  for (int y = 0; y < depth.height; ++y) {
    for (int x = 0; x < depth.width; ++x) {
      const std::size_t i = std::size_t(y) * std::size_t(depth.width) + std::size_t(x);
      const std::uint16_t raw = depth.pixels[i];
      if (!measured(raw)) continue;
      ++view.returns;
      const auto z = static_cast<float>(raw * sensor.depth_unit_m + sensor.depth_bias_m);
      if (keep(Vec3f(rays.x()[i] * z, rays.y()[i] * z, z))) {
        ++view.kept;
        box.add(x, y);
      }
    }
  }
  if (box.empty()) return view;
  box.widen(kRim, depth.width, depth.height);
  RawWindow raw(box.width(), box.height());
  for (int y = 0; y < raw.height; ++y) {
    for (int x = 0; x < raw.width; ++x) raw.at(x, y) = depth.at(x + box.x0, y + box.y0);
  }
  const CameraIntrinsics& camera = sensor.intrinsics;
  view.fx = static_cast<float>(camera.fx);
  view.fy = static_cast<float>(camera.fy);
  view.cx = static_cast<float>(camera.cx - box.x0 + 1);
  view.cy = static_cast<float>(camera.cy - box.y0 + 1);
  for (std::size_t k = 0; k < 5; ++k) view.distortion[k] = static_cast<float>(camera.distortion[k]);
  view.distorted = camera.distorted();
  view.unit_m = static_cast<float>(sensor.depth_unit_m);
  view.bias_m = static_cast<float>(sensor.depth_bias_m);
  set_pose(view, T_table_sensor);
  pack_window(raw, scale.edge_step_m, view);
  return view;
}

/// Draws triangles of a range scan into an image of depths; the nearest surface stays.
class Resampler {
 public:
  Resampler(const FramePoints& points, double pixel_m) : points_(points) {
    const Box box = bounds(points.cloud.points);
    const Vec3d center = box.center();
    const Vec3d towards = points.viewpoint.direction_from(center);
    const Vec3d z = -(towards.norm() > 0.5 ? towards : Vec3d(0, 0, -1));
    const Vec3d x = z.unitOrthogonal(), y = z.cross(x);
    rotation_.row(0) = x, rotation_.row(1) = y, rotation_.row(2) = z;
    parallel_ = points.viewpoint.parallel;
    const double away = parallel_ ? 0.0 : (center - points.viewpoint.value).norm();
    origin_ = parallel_ ? center - (box.size().norm() + 0.01) * z : points.viewpoint.value;
    focal_ = parallel_ ? 1.0 / pixel_m : std::max(away, pixel_m) / pixel_m;
    project();
  }

  bool usable() const { return width_ > 0; }

  void draw(double edge_step_m) {
    z_ = Image<float>(width_, height_, 0.0f);
    const auto n = points_.cell.empty() ? std::size_t(0) : points_.cloud.size();
    std::vector<std::int32_t> at(std::size_t(points_.width) * std::size_t(points_.height), -1);
    for (std::size_t i = 0; i < n; ++i) at[std::size_t(points_.cell[i])] = std::int32_t(i);
    for (int r = 0; n > 0 && r + 1 < points_.height; ++r) {
      for (int c = 0; c + 1 < points_.width; ++c) {
        const std::size_t i = std::size_t(r) * std::size_t(points_.width) + std::size_t(c);
        const std::size_t below = i + std::size_t(points_.width);
        triangle(at[i], at[i + 1], at[below + 1], edge_step_m);
        triangle(at[i], at[below + 1], at[below], edge_step_m);
      }
    }
    for (const Vec3d& q : image_) dot(q);
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
    view.bias_m = low - view.unit_m;  // the nearest one is 1
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
    return view;
  }

 private:
  static constexpr int kMaxSide = 4096;

  void project() {
    double u1 = -1e30, v1 = -1e30;
    for (const Vec3f& p : points_.cloud.points) {
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

  void put(int x, int y, double z) {
    float& own = z_.at(x, y);
    if (own == 0.0f || z < double(own)) own = static_cast<float>(z);
  }

  void dot(const Vec3d& q) {
    const int x = int(std::lround(q.x())), y = int(std::lround(q.y()));
    if (q.z() > 0.0 && z_.at(x, y) == 0.0f) put(x, y, q.z());
  }

  void triangle(std::int32_t ia, std::int32_t ib, std::int32_t ic, double step_m) {
    if (ia < 0 || ib < 0 || ic < 0) return;
    const Vec3d &a = image_[std::size_t(ia)], &b = image_[std::size_t(ib)],
                &c = image_[std::size_t(ic)];
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
        put(x, y, z);
      }
    }
  }

  const FramePoints& points_;
  Eigen::Matrix3d rotation_;
  Vec3d origin_ = Vec3d::Zero();
  double focal_ = 1.0, u0_ = 1e30, v0_ = 1e30;
  bool parallel_ = false;
  int width_ = 0, height_ = 0;
  std::vector<Vec3d> image_;  // u, v from the window's corner, z
  Image<float> z_;
};

DepthView view_of_points(FramePoints points, const Pose& T_table_sensor, const ViewScale& scale,
                         const KeepPoint& keep) {
  FramePoints kept;
  kept.width = points.width;
  kept.height = points.height;
  kept.viewpoint = points.viewpoint;
  for (std::size_t i = 0; i < points.cloud.size(); ++i) {
    if (!keep(points.cloud.points[i])) continue;
    kept.cloud.points.push_back(points.cloud.points[i]);
    if (!points.cell.empty()) kept.cell.push_back(points.cell[i]);
  }
  if (kept.cloud.empty()) return {};
  // Where triangles are drawn, finer pixels than the points' spacing cost nothing in truth.
  const double pixel = kept.cell.empty() ? scale.spacing_m : 0.5 * scale.spacing_m;
  Resampler resampler(kept, pixel);
  if (!resampler.usable()) return {};
  resampler.draw(scale.edge_step_m);
  DepthView view = resampler.view(T_table_sensor, scale.edge_step_m);
  view.returns = std::uint32_t(points.cloud.size());
  view.kept = std::uint32_t(kept.cloud.size());
  return view;
}

}  // namespace

Viewpoint DepthView::viewpoint() const {
  const Eigen::Matrix3d r = rotation.cast<double>();
  if (parallel) return {-r.transpose() * Vec3d::UnitZ(), true};
  return {-r.transpose() * translation.cast<double>(), false};
}

Result<DepthView> make_view(const Frame& frame, const SensorInfo& sensor, const RayTable& rays,
                            const Pose& T_table_sensor, const ViewScale& scale,
                            const KeepPoint& keep) {
  if (!frame.depth.empty()) {
    if (frame.depth.width != sensor.intrinsics.width ||
        frame.depth.height != sensor.intrinsics.height ||
        rays.x().size() != frame.depth.pixels.size())
      return fail_at(frame.info.file, ErrorCode::kFormat,
                     "depth image is {} x {} pixels, but its sensor has {} x {}", frame.depth.width,
                     frame.depth.height, sensor.intrinsics.width, sensor.intrinsics.height);
    return view_of_depth(frame, sensor, rays, T_table_sensor, scale, keep);
  }
  TURNSCAN_ASSIGN(FramePoints points, points_of(frame, sensor, rays));
  return view_of_points(std::move(points), T_table_sensor, scale, keep);
}

}  // namespace turnscan
