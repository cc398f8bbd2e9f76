#include <turnscan/evaluation/inspection/section.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <turnscan/geometry/mesh/planar_outlines.hpp>
#include <unordered_map>

namespace turnscan {

namespace {

/// Within a triangle, from the edge where its outline leaves the half space to the one where it
/// re-enters. Edges are identified by their ends, the lower first.
struct CutSegment {
  std::uint64_t from = 0, to = 0;
};

std::uint64_t edge_name(std::uint32_t a, std::uint32_t b) {
  return (std::uint64_t(std::min(a, b)) << 32) | std::max(a, b);
}

/// Cuts every triangle once, and joins the segments at the edges that they share.
class ContourTracer {
 public:
  ContourTracer(const TriangleMesh& mesh, const HalfSpace& plane) : mesh_(mesh) {
    side_.reserve(mesh.vertices.size());
    for (const Vec3f& p : mesh.vertices)
      side_.push_back(plane.normal.dot(p.cast<double>()) - plane.offset_m);
    for (const auto& t : mesh.triangles) cut_triangle(t);
    used_.assign(segments_.size(), 0);
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      starts_[segments_[i].from].push_back(i);
      ++ends_[segments_[i].to];
    }
  }

  std::vector<Contour> contours() {
    // Starts with those that begin at a hole of the mesh: any other start would omit their
    // beginning.
    for (std::size_t i = 0; i < segments_.size(); ++i)
      if (!ends_.contains(segments_[i].from)) follow(i);
    for (std::size_t i = 0; i < segments_.size(); ++i) follow(i);
    return std::move(contours_);
  }

 private:
  bool inside(std::uint32_t v) const { return side_[v] >= 0.0; }

  void cut_triangle(const std::array<std::uint32_t, 3>& t) {
    CutSegment segment;
    bool cut = false;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = t[c], b = t[(c + 1) % 3];
      if (inside(a) == inside(b)) continue;
      (inside(a) ? segment.from : segment.to) = edge_name(a, b);
      cut = true;
    }
    if (cut) segments_.push_back(segment);
  }

  Vec3d point_on(std::uint64_t edge) const {
    const auto a = static_cast<std::uint32_t>(edge >> 32), b = static_cast<std::uint32_t>(edge);
    const double t = std::clamp(side_[a] / (side_[a] - side_[b]), 0.0, 1.0);
    return (1.0 - t) * mesh_.vertices[a].cast<double>() + t * mesh_.vertices[b].cast<double>();
  }

  std::optional<std::size_t> next_from(std::uint64_t edge) const {
    const auto found = starts_.find(edge);
    if (found == starts_.end()) return std::nullopt;
    for (const std::size_t i : found->second)
      if (used_[i] == 0) return i;
    return std::nullopt;
  }

  void follow(std::size_t first) {
    if (used_[first] != 0) return;
    Contour contour;
    std::optional<std::size_t> at = first;
    std::uint64_t last = segments_[first].from;
    add_point(contour, last);
    while (at) {
      used_[*at] = 1;
      last = segments_[*at].to;
      if (last == segments_[first].from) break;
      add_point(contour, last);
      at = next_from(last);
    }
    contour.closed = last == segments_[first].from;
    if (contour.closed && contour.points.size() > 1 &&
        (contour.points.front() - contour.points.back()).norm() < kSamePoint)
      contour.points.pop_back();
    if (contour.points.size() >= (contour.closed ? 3u : 2u))
      contours_.push_back(std::move(contour));
  }

  void add_point(Contour& contour, std::uint64_t edge) const {
    const Vec3d p = point_on(edge);
    if (contour.points.empty() || (contour.points.back() - p).norm() >= kSamePoint)
      contour.points.push_back(p);
  }

  static constexpr double kSamePoint = 1e-9;  // metres

  const TriangleMesh& mesh_;
  std::vector<double> side_;
  std::vector<CutSegment> segments_;
  std::vector<std::uint8_t> used_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> starts_;
  std::unordered_map<std::uint64_t, std::size_t> ends_;
  std::vector<Contour> contours_;
};

}  // namespace

std::pair<Vec3d, Vec3d> drawing_axes(const Vec3d& normal) {
  const Vec3d up = std::abs(normal.y()) > 0.9 ? Vec3d(-Vec3d::UnitZ()) : Vec3d(Vec3d::UnitY());
  const Vec3d right = up.cross(normal).normalized();
  return {right, normal.cross(right)};
}

Result<Section> cross_section(const TriangleMesh& mesh, const HalfSpace& plane) {
  TURNSCAN_TRY(validate_mesh(mesh, "section"));
  if (!(std::abs(plane.normal.norm() - 1.0) < 1e-6) || !std::isfinite(plane.offset_m)) {
    return fail(ErrorCode::kInvalidOption,
                "section: the plane's normal has length {}; give one of length 1",
                plane.normal.norm());
  }
  Section out;
  out.normal = plane.normal;
  out.offset_m = plane.offset_m;
  out.contours = ContourTracer(mesh, plane).contours();
  const auto [right, up] = drawing_axes(plane.normal);
  for (const Contour& contour : out.contours) {
    const std::size_t n = contour.points.size();
    const Vec3d o = contour.points.front();  // nearby, which avoids cancellation
    out.open += contour.closed ? 0 : 1;
    for (std::size_t i = 0; i + (contour.closed ? 0 : 1) < n; ++i) {
      const Vec3d a = contour.points[i], b = contour.points[(i + 1) % n];
      out.length_m += (b - a).norm();
      if (contour.closed)
        out.area_m2 += 0.5 * (right.dot(a - o) * up.dot(b - o) - right.dot(b - o) * up.dot(a - o));
    }
  }
  return out;
}

Result<TriangleMesh> section_cap(const Section& section) {
  const auto [right, up] = drawing_axes(section.normal);
  TriangleMesh out;
  std::vector<Eigen::Vector2d> flat;
  std::vector<mesh::Outline> outlines;
  for (const Contour& contour : section.contours) {
    if (!contour.closed) continue;
    mesh::Outline& outline = outlines.emplace_back();
    for (const Vec3d& p : contour.points) {
      outline.push_back(std::uint32_t(flat.size()));
      flat.emplace_back(right.dot(p), up.dot(p));
      out.vertices.push_back(p.cast<float>());
    }
  }
  if (outlines.empty()) return TriangleMesh();
  const auto triangles = mesh::triangulate_outlines(flat, outlines);
  if (!triangles) {
    return fail(ErrorCode::kLibrary,
                "section: outlines touch or cross each other, so that the cut cannot be closed; "
                "move the plane a little");
  }
  out.triangles.assign(triangles->begin(), triangles->end());
  out.normals.assign(out.vertices.size(), (-section.normal).cast<float>());
  return out;
}

}  // namespace turnscan
