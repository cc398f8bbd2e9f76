#include "explorer/edits.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <turnscan/core/parallel.hpp>

namespace turnscan::studio {

namespace {

std::vector<std::uint8_t> inside_mask(const std::vector<Vec3f>& points, const Outline& outline,
                                      const Eigen::Matrix4d& to_pixels) {
  std::vector<std::uint8_t> mask(points.size());
  parallel_for(points.size(), 4096, [&](std::size_t i) {
    const Eigen::Vector4d q = to_pixels * points[i].cast<double>().homogeneous();
    mask[i] = q.w() > 1e-9 && inside(outline, q.x() / q.w(), q.y() / q.w()) ? 1 : 0;
  });
  return mask;
}

/// Builds the cut mesh: old vertices are taken over once, new ones lie on edges.
class Cutter {
 public:
  Cutter(const TriangleMesh& mesh, const Vec3d& normal, double offset)
      : mesh_(mesh), taken_(mesh.vertices.size(), -1) {
    out_.name = mesh.name;
    for (const Vec3f& p : mesh.vertices) side_.push_back(normal.dot(p.cast<double>()) - offset);
  }

  TriangleMesh operator()() {
    for (const auto& triangle : mesh_.triangles) clip(triangle);
    return std::move(out_);
  }

 private:
  void clip(const std::array<std::uint32_t, 3>& triangle) {
    std::vector<std::uint32_t> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangle[i], b = triangle[(i + 1) % 3];
      if (side_[a] >= 0.0) corners.push_back(take(a));
      if ((side_[a] >= 0.0) != (side_[b] >= 0.0)) corners.push_back(split(a, b));
    }
    for (std::size_t i = 2; i < corners.size(); ++i)
      out_.triangles.push_back({corners[0], corners[i - 1], corners[i]});
  }

  std::uint32_t take(std::uint32_t v) {
    if (taken_[v] < 0) {
      taken_[v] = static_cast<std::int64_t>(out_.vertices.size());
      out_.vertices.push_back(mesh_.vertices[v]);
      if (!mesh_.normals.empty()) out_.normals.push_back(mesh_.normals[v]);
      if (!mesh_.colors.empty()) out_.colors.push_back(mesh_.colors[v]);
    }
    return static_cast<std::uint32_t>(taken_[v]);
  }

  std::uint32_t split(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto known = splits_.find({a, b});
    if (known != splits_.end()) return known->second;
    const double t = std::clamp(side_[a] / (side_[a] - side_[b]), 0.0, 1.0);
    const auto mix = [t](const Vec3f& x, const Vec3f& y) {
      return Vec3f(((1 - t) * x.cast<double>() + t * y.cast<double>()).cast<float>());
    };
    const auto at = static_cast<std::uint32_t>(out_.vertices.size());
    out_.vertices.push_back(mix(mesh_.vertices[a], mesh_.vertices[b]));
    if (!mesh_.normals.empty())
      out_.normals.push_back(mix(mesh_.normals[a], mesh_.normals[b]).normalized());
    if (!mesh_.colors.empty()) {
      const Rgb &x = mesh_.colors[a], &y = mesh_.colors[b];
      const auto blend = [t](std::uint8_t u, std::uint8_t v) {
        return static_cast<std::uint8_t>(std::lround((1 - t) * u + t * v));
      };
      out_.colors.push_back({blend(x.r, y.r), blend(x.g, y.g), blend(x.b, y.b)});
    }
    splits_[{a, b}] = at;
    return at;
  }

  const TriangleMesh& mesh_;
  TriangleMesh out_;
  std::vector<double> side_;
  std::vector<std::int64_t> taken_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> splits_;
};

}  // namespace

TriangleMesh cut(const TriangleMesh& mesh, const Vec3d& normal, double offset) {
  return Cutter(mesh, normal, offset)();
}

PointCloud points_where(const PointCloud& cloud, const std::function<bool(std::size_t)>& keep) {
  PointCloud out;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!keep(i)) continue;
    out.points.push_back(cloud.points[i]);
    if (!cloud.normals.empty()) out.normals.push_back(cloud.normals[i]);
    if (!cloud.colors.empty()) out.colors.push_back(cloud.colors[i]);
    if (!cloud.weights.empty()) out.weights.push_back(cloud.weights[i]);
    if (!cloud.frame.empty()) out.frame.push_back(cloud.frame[i]);
  }
  return out;
}

PointCloud cut(const PointCloud& cloud, const Vec3d& normal, double offset) {
  return points_where(
      cloud, [&](std::size_t i) { return normal.dot(cloud.points[i].cast<double>()) >= offset; });
}

bool inside(const Outline& outline, double x, double y) {
  bool in = false;
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const auto& [ax, ay] = outline[i];
    const auto& [bx, by] = outline[j];
    if ((ay > y) != (by > y) && x < (bx - ax) * (y - ay) / (by - ay) + ax) in = !in;
  }
  return in;
}

TriangleMesh without_lassoed(const TriangleMesh& mesh, const Outline& outline,
                             const Eigen::Matrix4d& to_pixels) {
  const auto in = inside_mask(mesh.vertices, outline, to_pixels);
  TriangleMesh rest = mesh;
  std::erase_if(rest.triangles,
                [&](const auto& t) { return in[t[0]] != 0 && in[t[1]] != 0 && in[t[2]] != 0; });
  // Vertices that no triangle names any more would still count for the box.
  return cut(rest, Vec3d::Zero(), -1.0);
}

PointCloud without_lassoed(const PointCloud& cloud, const Outline& outline,
                           const Eigen::Matrix4d& to_pixels) {
  const auto in = inside_mask(cloud.points, outline, to_pixels);
  return points_where(cloud, [&](std::size_t i) { return in[i] == 0; });
}

}  // namespace turnscan::studio
