#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <bitset>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/turntable/detection/rim_fit.hpp>

namespace turnscan::detection {

namespace {

using Eigen::Vector2d;

constexpr double kEdgeSigma_px = 0.35;  // a rim between two pixels: 0.29, and some noise
constexpr double kWallSigma_px = 0.25;
// Shift of a rim by mixed pixels: none, or half a pixel if each of them is lost.
constexpr double kOffset_px = 0.25, kOffsetSigma_px = 0.35;
constexpr std::size_t kMaxCircles = 8, kMaxEnds = 600;
constexpr std::array<std::array<int, 2>, 4> kAround{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

struct Circle2 {
  Vector2d center;
  double radius;
};

std::optional<Circle2> circle_through(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const Vector2d u = b - a, v = c - a;
  const double twice = 2.0 * (u.x() * v.y() - u.y() * v.x());
  if (std::abs(twice) < 1e-9) return std::nullopt;
  const double uu = u.squaredNorm(), vv = v.squaredNorm();
  const Vector2d to((v.y() * uu - u.y() * vv) / twice, (u.x() * vv - v.x() * uu) / twice);
  return Circle2{a + to, to.norm()};
}

/// Width of a pixel across the rim, as seen from the centre.
double pixel_across(const RimPoint& p, const Vector2d& center) {
  const Vector2d out = (p.at - center).normalized();
  return (p.footprint.transpose() * out).norm();
}

using Places = std::bitset<120>;

Places places_near(const std::vector<RimPoint>& points, const Circle2& circle) {
  Places places;
  for (const RimPoint& p : points) {
    const Vector2d d = p.at - circle.center;
    const double off = std::abs(d.norm() - circle.radius);
    if (off > 0.03 || off > pixel_across(p, circle.center) + 0.0005) continue;
    const double turn = std::atan2(d.y(), d.x()) / (kTurn) + 0.5;
    places.set(std::min<std::size_t>(places.size() - 1, std::size_t(turn * places.size())));
  }
  return places;
}

/// One step's normal equations. Unknowns: centre, radius, edge offset in pixels.
struct RimSystem {
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  double squares = 0.0, metres2 = 0.0;
  std::size_t points = 0;
};

RimSystem linearise(const std::vector<RimPoint>& points, const RimCircle& circle, double reach_px) {
  RimSystem out;
  for (const RimPoint& p : points) {
    const Vector2d d = p.at - circle.center;
    const double rho = d.norm();
    if (!(rho > 0.0)) continue;
    const double pixel = pixel_across(p, circle.center),
                 sigma = (p.jump ? kEdgeSigma_px : kWallSigma_px) * pixel;
    const double offset = p.jump ? pixel : 0.0;
    const double error = rho + circle.edge_px * offset - circle.radius_m;
    if (std::abs(error) > reach_px * pixel + 0.0005) continue;
    const double size = std::abs(error) / sigma;
    const double weight = size > 2.0 ? 2.0 / size : 1.0;
    Eigen::Vector4d row;
    row << -d.x() / rho, -d.y() / rho, -1.0, offset;
    row /= sigma;
    out.normal += weight * row * row.transpose();
    out.right -= weight * row * (error / sigma);
    out.squares += weight * size * size;
    out.metres2 += error * error;
    ++out.points;
  }
  const double prior = 1.0 / (kOffsetSigma_px * kOffsetSigma_px);
  out.normal(3, 3) += prior;
  out.right[3] -= prior * (circle.edge_px - kOffset_px);
  return out;
}

void hold_radius(double radius_m, const RimCircle& circle, RimSystem& system) {
  const double prior = 1.0 / (0.0005 * 0.0005);
  system.normal(2, 2) += prior;
  system.right[2] -= prior * (circle.radius_m - radius_m);
}

/// Least squares with rejection of distant points; nullopt if it diverges.
std::optional<RimCircle> refine(const std::vector<RimPoint>& points, const Circle2& start,
                                std::optional<double> radius_m) {
  RimCircle circle;
  circle.center = start.center;
  circle.radius_m = radius_m.value_or(start.radius);
  RimSystem system;
  for (int i = 0; i < 30; ++i) {
    system = linearise(points, circle, i < 5 ? 2.5 : 1.5);
    if (system.points < 12) return std::nullopt;
    if (radius_m) hold_radius(*radius_m, circle, system);
    const Eigen::Vector4d step = estimation::solve_ldlt(system.normal, system.right);
    if (!step.allFinite()) return std::nullopt;
    circle.center += step.head<2>();
    circle.radius_m += step[2];
    circle.edge_px = std::clamp(circle.edge_px + step[3], -2.0, 2.0);
    if ((circle.center - start.center).norm() > start.radius || !(circle.radius_m > 0.0))
      return std::nullopt;
    if (i > 6 && step.norm() < 1e-8) break;
  }
  // The ends of neighbouring rows form one staircase: every second one counts as independent.
  const double scale = 2.0 * std::max(1.0, system.squares / double(system.points));
  const Eigen::Matrix4d covariance = scale * system.normal.inverse();
  circle.center_covariance = covariance.topLeftCorner<2, 2>();
  circle.radius_sigma_m = std::sqrt(covariance(2, 2));
  circle.rms_m = std::sqrt(system.metres2 / double(system.points));
  circle.points = system.points;
  return circle;
}

}  // namespace

PlaneFrame::PlaneFrame(const Plane& plane, const Vec3d& origin)
    : o_(origin - plane.height(origin) * plane.normal) {
  u_ = (std::abs(plane.normal.x()) < 0.9 ? Vec3d::UnitX() : Vec3d::UnitZ());
  u_ = (u_ - u_.dot(plane.normal) * plane.normal).normalized();
  v_ = plane.normal.cross(u_);
}

int PlaneView::side(int column, int row) const {
  const auto i = std::size_t(row) * std::size_t(scan.width) + std::size_t(column);
  if (in[i]) return 0;
  const Vec3f& p = scan.point[i];
  if (!(p.z() > 0.0f)) return -1;
  const Vec3d at = p.cast<double>();
  const double h = plane.height(at);
  if (std::abs(h) < tolerance_m) return 0;
  return h > 0.0 ? 1 : -1;
}

namespace {

/// Scans the pixels of a plane for its ends.
class RimSearch {
 public:
  explicit RimSearch(const PlaneView& view)
      : view_(view), w_(view.scan.width), h_(view.scan.height) {}

  /// Ends of the pixels for which `counts` is not 0.
  std::vector<RimPoint> ends_of(const std::vector<std::uint8_t>& counts) {
    for (int y = 1; y + 1 < h_; ++y) {
      for (int x = 1; x + 1 < w_; ++x) {
        if (!counts[index(x, y)]) continue;
        for (const auto& [dx, dy] : kAround)
          if (!counts[index(x + dx, y + dy)] && view_.side(x + dx, y + dy) <= 0)
            add(x + 0.5 * dx, y + 0.5 * dy, true);
      }
    }
    return std::move(out_);
  }

  std::vector<RimPoint> run() {
    for (int y = 0; y < h_; ++y) {
      for (int x = 0; x < w_; ++x) {
        if (!view_.in[index(x, y)]) continue;
        for (const auto& [dx, dy] : kAround) examine(x, y, dx, dy);
      }
    }
    return std::move(out_);
  }

 private:
  std::size_t index(int x, int y) const {
    return std::size_t(y) * std::size_t(w_) + std::size_t(x);
  }
  bool inside(int x, int y) const { return x >= 0 && y >= 0 && x < w_ && y < h_; }
  Vec3d meet(double column, double row) const {
    const Vec3d ray = view_.ray(column, row);
    return ray * view_.plane.depth_along(ray);
  }

  /// Adds the point where the surface ends beyond pixel (x, y), if it ends there in front of
  /// something farther away.
  void examine(int x, int y, int dx, int dy) {
    const int nx = x + dx, ny = y + dy, fx = x + 2 * dx, fy = y + 2 * dy;
    if (!inside(nx, ny) || !inside(fx, fy) || view_.in[index(nx, ny)]) return;
    if (const auto wall = wall_begins(x, y, dx, dy)) {
      add(x + *wall * dx, y + *wall * dy, false);
      return;
    }
    // A pixel that flickers between two surfaces is the rim itself.
    const bool mixed =
        view_.scan.point[index(nx, ny)].z() > 0.0f && !view_.scan.still[index(nx, ny)];
    if (!(mixed ? lies_deep(fx, fy, dx, dy) : lies_deep(nx, ny, dx, dy))) return;
    const double half = mixed ? 1.0 : 0.5;
    add(x + half * dx, y + half * dy, true);
  }

  /// Whether a pixel sees something well below the plane, or nothing. Slightly below, it may be the
  /// upper end of a wall, whose beginning is not known.
  bool lies_deep(int x, int y, int dx, int dy) const {
    const Vec3f& p = view_.scan.point[index(x, y)];
    if (!(p.z() > 0.0f)) return true;
    const double pixel = p.z() / view_.camera.fx;
    const double height = view_.plane.height(p.cast<double>());
    if (height < -view_.tolerance_m - 1.8 * pixel) return true;
    if (height > -view_.tolerance_m || !inside(x + dx, y + dy)) return false;
    const Vec3f& next = view_.scan.point[index(x + dx, y + dy)];
    if (!(next.z() > 0.0f)) return false;
    return std::abs(view_.plane.height(next.cast<double>()) - height) < 0.15 * pixel;
  }

  /// Where a wall descends from the rim, pixel by pixel, its first pixels still count as the plane;
  /// the line through the heights of the next two gives its beginning.
  std::optional<double> wall_begins(int x, int y, int dx, int dy) const {
    if (!inside(x + 3 * dx, y + 3 * dy)) return std::nullopt;
    std::array<double, 3> height{};
    for (int k = 0; k < 3; ++k) {
      const std::size_t i = index(x + (k + 1) * dx, y + (k + 1) * dy);
      if (!view_.scan.still[i]) return std::nullopt;
      height[std::size_t(k)] = view_.plane.height(view_.scan.point[i].cast<double>());
    }
    const double pixel = view_.scan.point[index(x, y)].z() / view_.camera.fx;
    const double first = height[1] - height[0], second = height[2] - height[1];
    const auto falls = [&](double step) { return step < -0.75 * pixel && step > -1.8 * pixel; };
    const double slack = 0.4 * pixel + 6.0 * view_.scan.noise_m;
    if (!falls(0.5 * (first + second)) || std::abs(first - second) > slack) return std::nullopt;
    const double step = 0.5 * (first + second), mean = (height[0] + height[1] + height[2]) / 3.0;
    const double begins = 2.0 - mean / step;
    if (begins < -3.0 || begins > 1.5) return std::nullopt;
    return begins;
  }

  void add(double u, double v, bool jump) {
    const Vec3d p = meet(u, v), px = meet(u + 0.5, v) - meet(u - 0.5, v),
                py = meet(u, v + 0.5) - meet(u, v - 0.5);
    if (!p.allFinite() || !px.allFinite() || !py.allFinite() || !(p.z() > 0.0)) return;
    RimPoint point;
    point.at = view_.frame.to_plane(p);
    const Vec3d a = view_.frame.u(), b = view_.frame.v();
    point.footprint << a.dot(px), a.dot(py), b.dot(px), b.dot(py);
    point.jump = jump;
    out_.push_back(point);
  }

  const PlaneView& view_;
  int w_, h_;
  std::vector<RimPoint> out_;
};

}  // namespace

namespace {

/// 1 for the largest set of the plane's pixels that are connected along rows and columns.
std::vector<std::uint8_t> largest_part(const PlaneView& view) {
  const int w = view.scan.width, h = view.scan.height;
  std::vector<std::uint8_t> open = view.in;
  std::vector<std::int32_t> best, part;
  for (std::size_t first = 0; first < open.size(); ++first) {
    if (!open[first]) continue;
    part.assign(1, static_cast<std::int32_t>(first));
    open[first] = 0;
    for (std::size_t k = 0; k < part.size(); ++k) {
      const int x = part[k] % w, y = part[k] / w;
      for (const auto& [dx, dy] : kAround) {
        const int u = x + dx, v = y + dy;
        if (u < 0 || v < 0 || u >= w || v >= h || !open[std::size_t(v * w + u)]) continue;
        open[std::size_t(v * w + u)] = 0;
        part.push_back(v * w + u);
      }
    }
    if (part.size() > best.size()) best.swap(part);
  }
  std::vector<std::uint8_t> out(open.size(), 0);
  for (const std::int32_t i : best) out[std::size_t(i)] = 1;
  return out;
}

}  // namespace

std::vector<RimPoint> part_ends(const PlaneView& view) {
  return RimSearch(view).ends_of(largest_part(view));
}

std::vector<RimPoint> rim_points(const PlaneView& view) { return RimSearch(view).run(); }

void drop_false_ends(const Vector2d& center, const Vector2d& to_sensor,
                     std::vector<RimPoint>& points) {
  const auto faces = [&](const RimPoint& p) {
    return (p.at - center).normalized().dot(to_sensor) > -0.15;
  };
  std::size_t walls = 0, all = 0;
  for (const RimPoint& p : points) {
    if (!faces(p)) continue;
    ++all;
    walls += p.jump ? 0 : 1;
  }
  if (walls < 15 || walls < all / 8) return;
  std::erase_if(points, [&](const RimPoint& p) { return p.jump && faces(p); });
}

std::vector<RimCircle> find_circles(const std::vector<RimPoint>& all, double min_radius_m,
                                    double max_radius_m, std::optional<double> radius_m,
                                    std::uint64_t seed) {
  std::vector<RimCircle> found;
  if (all.size() < 20) return found;
  const std::vector<RimPoint> points = evenly_spread(all, kMaxEnds);
  constexpr std::size_t kTrials = 1500;
  std::vector<std::size_t> score(kTrials, 0);
  std::vector<Circle2> circles(kTrials, Circle2{Vector2d::Zero(), 0.0});
  parallel_for(kTrials, 32, [&](std::size_t t) {
    const auto pick = [&](std::uint64_t k) -> const Vector2d& {
      return points[std::size_t(uniform01(hash_key(seed, t, k)) * double(points.size()))].at;
    };
    const auto circle = circle_through(pick(0), pick(1), pick(2));
    if (!circle || circle->radius < min_radius_m || circle->radius > max_radius_m) return;
    circles[t] = *circle;
    score[t] = places_near(points, *circle).count();
  });
  // Refines the best few: a circle through three neighbouring points is inaccurate.
  std::vector<std::size_t> order(kTrials);
  for (std::size_t t = 0; t < kTrials; ++t) order[t] = t;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t l, std::size_t r) { return score[l] > score[r]; });
  for (std::size_t k = 0; k < kMaxCircles && score[order[k]] >= 24; ++k) {
    const auto circle = refine(points, circles[order[k]], radius_m);
    if (circle && circle->radius_m >= min_radius_m && circle->radius_m <= max_radius_m)
      found.push_back(*circle);
  }
  return found;
}

}  // namespace turnscan::detection
