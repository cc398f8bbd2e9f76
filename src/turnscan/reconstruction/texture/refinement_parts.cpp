#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/texture/refinement_parts.hpp>

namespace turnscan::texture {

namespace {

constexpr float kMinEdge = 6.0f;        // levels a pixel
constexpr double kPatternScale = 12.0;  // levels: points that look different have less weight
constexpr std::size_t kMinSeen = 3;     // views of a point
constexpr float kFacing = 0.45f;        // cosine
constexpr int kOutlineStep = 3;         // pixels along the outline
constexpr float kMaxEdge = 25.0f;       // levels per pixel; stronger edges have no more weight
/// The surface ends about half a pixel beyond the last pixel whose centre it covers.
constexpr float kBeyond = 0.5f;

/// Outward normal of the outline at a pixel: away from the covered pixels around it.
Eigen::Vector2f outline_normal(const DrawnMesh& drawn, int x, int y) {
  Eigen::Vector2f inward = Eigen::Vector2f::Zero();
  for (int dy = -4; dy <= 4; ++dy)
    for (int dx = -4; dx <= 4; ++dx)
      if (drawn.covered(x + dx, y + dy)) inward += Eigen::Vector2f(float(dx), float(dy));
  const float length = inward.norm();
  return length > 0.0f ? Eigen::Vector2f(-inward / length) : Eigen::Vector2f::Zero();
}

bool on_outline(const DrawnMesh& drawn, int x, int y) {
  return drawn.covered(x, y) && (!drawn.covered(x - 1, y) || !drawn.covered(x + 1, y) ||
                                 !drawn.covered(x, y - 1) || !drawn.covered(x, y + 1));
}

/// Position along the normal, from -reach to reach, of the largest gradient; returns whether there
/// is one.
bool edge_along(const GreyWindow& grey, const Eigen::Vector2f& from, const Eigen::Vector2f& normal,
                double reach_px, double& offset) {
  const int steps = int(2.0 * reach_px) + 1;
  float strongest = kMinEdge;
  std::vector<float> slope(std::size_t(2 * steps + 1), 0.0f);
  int best = steps * 2;
  for (int i = -steps; i <= steps; ++i) {
    const Eigen::Vector2f p = from + float(i) * 0.5f * normal;
    float value = 0.0f;
    Eigen::Vector2f gradient;
    if (!grey.at(p.x(), p.y(), value, gradient)) return false;
    slope[std::size_t(i + steps)] = std::abs(gradient.dot(normal));
    // The closer of two equal edges is more likely the outline.
    const float value_here =
        slope[std::size_t(i + steps)] * (1.0f - 0.4f * float(std::abs(i)) / float(steps));
    if (value_here > strongest) strongest = value_here, best = i;
  }
  if (best == steps * 2 || std::abs(best) >= steps) return false;
  const float before = slope[std::size_t(best + steps - 1)],
              here = slope[std::size_t(best + steps)];
  const float after = slope[std::size_t(best + steps + 1)];
  const float bend = before - 2.0f * here + after;
  const float part = bend < 0.0f ? std::clamp(0.5f * (before - after) / bend, -0.5f, 0.5f) : 0.0f;
  offset = 0.5 * (double(best) + double(part));
  return true;
}

}  // namespace

void MotionEquations::add(const Motion& gradient, double residual, double w) {
  NormalEquations::add(gradient, residual, w);
  error += w * residual * residual;
  weight += w;
}

void MotionEquations::add(const MotionEquations& other) {
  NormalEquations::add(other);
  error += other.error;
  weight += other.weight;
}

Eigen::Matrix<double, 2, 6> image_motion(const Vec3f& p, const CameraIntrinsics& camera) {
  const double x = double(p.x()), y = double(p.y()), z = double(p.z());
  Eigen::Matrix<double, 2, 3> projection;
  projection << camera.fx / z, 0.0, -camera.fx * x / (z * z), 0.0, camera.fy / z,
      -camera.fy * y / (z * z);
  Eigen::Matrix<double, 3, 6> moved;
  moved << 0.0, z, -y, 1.0, 0.0, 0.0, -z, 0.0, x, 0.0, 1.0, 0.0, y, -x, 0.0, 0.0, 0.0, 1.0;
  return projection * moved;
}

bool GreyWindow::at(float u, float v, float& value, Eigen::Vector2f& gradient) const {
  const float x = u - float(left), y = v - float(top);
  if (!(x >= 1.0f && y >= 1.0f && x < float(light.width - 2) && y < float(light.height - 2)))
    return false;
  const int x0 = int(x), y0 = int(y);
  const float fx = x - float(x0), fy = y - float(y0);
  const float a = light.at(x0, y0), b = light.at(x0 + 1, y0), c = light.at(x0, y0 + 1),
              d = light.at(x0 + 1, y0 + 1);
  value = (1 - fy) * ((1 - fx) * a + fx * b) + fy * ((1 - fx) * c + fx * d);
  gradient = {(1 - fy) * (b - a) + fy * (d - c), (1 - fx) * (c - a) + fx * (d - b)};
  return true;
}

GreyWindow blurred(const GreyWindow& window, double sigma) {
  const int reach = std::max(1, int(std::ceil(2.5 * sigma)));
  std::vector<float> kernel(std::size_t(2 * reach + 1));
  float sum = 0.0f;
  for (int i = -reach; i <= reach; ++i)
    sum += kernel[std::size_t(i + reach)] = float(std::exp(-0.5 * i * i / (sigma * sigma)));
  for (float& k : kernel) k /= sum;
  const int width = window.light.width, height = window.light.height;
  Image<float> rows(width, height);
  GreyWindow out{window.left, window.top, Image<float>(width, height)};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      float value = 0.0f;
      for (int i = -reach; i <= reach; ++i)
        value +=
            kernel[std::size_t(i + reach)] * window.light.at(std::clamp(x + i, 0, width - 1), y);
      rows.at(x, y) = value;
    }
  for (int y = 0; y < height; ++y)
    for (int i = -reach; i <= reach; ++i) {
      const int from = std::clamp(y + i, 0, height - 1);
      for (int x = 0; x < width; ++x)
        out.light.at(x, y) += kernel[std::size_t(i + reach)] * rows.at(x, from);
    }
  return out;
}

std::vector<OutlinePoint> outline_of(const ColorView& view, const DrawnMesh& drawn) {
  std::vector<OutlinePoint> out;
  for (int y = 0; y < drawn.height(); ++y) {
    for (int x = 0; x < drawn.width(); ++x) {
      if ((x + 2 * y) % kOutlineStep != 0 || !on_outline(drawn, x, y)) continue;
      const Eigen::Vector2f normal = outline_normal(drawn, x, y);
      if (normal.squaredNorm() == 0.0f) continue;
      const Vec3d ray = view.camera.ray(double(drawn.left() + x), double(drawn.top() + y));
      const Vec3f p = (ray * double(drawn.depth(x, y))).cast<float>();
      if (!p.allFinite()) continue;
      out.push_back({view.rotation.transpose() * (p - view.translation), normal});
    }
  }
  return out;
}

double edge_strength(const ColorView& view, const std::vector<OutlinePoint>& outline,
                     const GreyWindow& grey, const Eigen::Vector2f& shift_px) {
  double sum = 0.0;
  for (const OutlinePoint& point : outline) {
    const Projection q = view.project(point.p_object);
    const Eigen::Vector2f at = Eigen::Vector2f(q.u, q.v) + kBeyond * point.normal + shift_px;
    float value = 0.0f;
    Eigen::Vector2f gradient;
    if (q.z > 0.0f && grey.at(at.x(), at.y(), value, gradient))
      sum += double(std::min(std::abs(gradient.dot(point.normal)), kMaxEdge));
  }
  return sum;
}

int HeightBands::of(const Vec3f& p_object) const {
  const double share = (double(p_object.y()) - lowest_m) / std::max(height_m, 1e-9);
  return std::clamp(int(share * kCount), 0, kCount - 1);
}

void OutlineEquations::add(const OutlineEquations& other) {
  MotionEquations::add(other);
  per_band += other.per_band;
}

OutlineEquations outline_equations(const ColorView& view, const std::vector<OutlinePoint>& outline,
                                   const GreyWindow& grey, const HeightBands& bands,
                                   double reach_px) {
  OutlineEquations out;
  const double scale = std::max(0.7, 0.25 * reach_px);
  for (const OutlinePoint& point : outline) {
    const Projection q = view.project(point.p_object);
    if (!(q.z > 0.0f)) continue;
    const Eigen::Vector2f from = Eigen::Vector2f(q.u, q.v) + kBeyond * point.normal;
    double offset = 0.0;
    if (!edge_along(grey, from, point.normal, reach_px, offset)) continue;
    const Vec3f p = view.rotation * point.p_object + view.translation;
    const Motion along =
        (point.normal.cast<double>().transpose() * image_motion(p, view.camera)).transpose();
    const double r = offset / scale;
    const double w = 1.0 / ((1.0 + r * r) * (1.0 + r * r));
    out.add(along, offset, w);
    out.per_band.col(bands.of(point.p_object)) += w * along;
  }
  return out;
}

namespace {

/// Observation of a surface point by a view.
struct PatternView {
  double value = 0.0;
  Eigen::RowVector2d slope;                ///< of the image, per pixel
  Eigen::Matrix<double, 2, 6> per_motion;  ///< pixels per motion of the camera
  Eigen::Matrix2d per_tangent;             ///< pixels per metre along the surface's tangents
};

/// Two unit vectors perpendicular to n and to each other.
Eigen::Matrix<double, 3, 2> tangents(const Vec3f& n) {
  const Vec3d normal = n.cast<double>();
  Eigen::Matrix<double, 3, 2> out;
  out.col(0) = normal.unitOrthogonal();
  out.col(1) = normal.cross(out.col(0));
  return out;
}

void find_pattern_views(const std::vector<ColorView>& views, const std::vector<DrawnMesh>& drawn,
                        const std::vector<GreyWindow>& grey, const Vec3f& point,
                        const Vec3f& normal, std::vector<PatternView>& out) {
  out.clear();
  const Eigen::Matrix<double, 3, 2> tangent = tangents(normal);
  for (std::size_t k = 0; k < views.size(); ++k) {
    const Vec3f to_eye = (views[k].eye() - point).normalized();
    if (!(normal.dot(to_eye) > kFacing)) continue;
    const Projection q = views[k].project(point);
    if (drawn[k].shows(q) != Shown::kWell) continue;
    float value = 0.0f;
    Eigen::Vector2f slope;
    if (!grey[k].at(q.u, q.v, value, slope)) continue;
    PatternView& view = out.emplace_back();
    view.value = double(value);
    view.slope = slope.cast<double>().transpose();
    view.per_motion =
        image_motion(views[k].rotation * point + views[k].translation, views[k].camera);
    view.per_tangent =
        view.per_motion.rightCols<3>() * (views[k].rotation.cast<double>() * tangent);
  }
}

/// The pattern has one gradient along the surface, the mean over the views. With a gradient per
/// view, noise would pass for evidence in directions in which all views see the pattern move alike,
/// as along the turntable's axis.
void add_pattern(const std::vector<PatternView>& seen, MotionEquations& out) {
  const double share = 1.0 / double(seen.size());
  double mean = 0.0;
  Eigen::RowVector2d slope = Eigen::RowVector2d::Zero();
  for (const PatternView& view : seen) {
    mean += share * view.value;
    slope += share * view.slope * view.per_tangent;
  }
  const auto gradient_of = [&](const PatternView& view) -> Motion {
    return (slope * (view.per_tangent.inverse() * view.per_motion)).transpose();
  };
  Motion mean_gradient = Motion::Zero();
  for (const PatternView& view : seen) mean_gradient += share * gradient_of(view);
  for (const PatternView& view : seen) {
    const double residual = mean - view.value, r = residual / kPatternScale;
    out.add(gradient_of(view) - mean_gradient, residual, 1.0 / ((1.0 + r * r) * (1.0 + r * r)));
  }
}

}  // namespace

MotionEquations pattern_equations(const std::vector<ColorView>& views,
                                  const std::vector<DrawnMesh>& drawn,
                                  const std::vector<GreyWindow>& grey,
                                  const std::vector<Vec3f>& points,
                                  const std::vector<Vec3f>& normals) {
  const auto parts =
      parallel_chunks<MotionEquations>(points.size(), 512, [&](std::size_t begin, std::size_t end) {
        MotionEquations part;
        std::vector<PatternView> seen;
        for (std::size_t i = begin; i < end; ++i) {
          find_pattern_views(views, drawn, grey, points[i], normals[i], seen);
          if (seen.size() >= kMinSeen) add_pattern(seen, part);
        }
        return part;
      });
  MotionEquations all;
  for (const MotionEquations& part : parts) all.add(part);
  return all;
}

}  // namespace turnscan::texture
