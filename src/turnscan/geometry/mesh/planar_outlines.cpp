#include <geos_c.h>

#include <algorithm>
#include <memory>
#include <turnscan/geometry/mesh/planar_outlines.hpp>
#include <utility>

namespace turnscan::mesh {

namespace {

using DirectedEdge = std::pair<std::uint32_t, std::uint32_t>;

/// A session of GEOS, whose geometries must not outlive it.
class Geos {
 public:
  struct Delete {
    GEOSContextHandle_t context;
    void operator()(GEOSGeometry* g) const { GEOSGeom_destroy_r(context, g); }
  };
  using Geometry = std::unique_ptr<GEOSGeometry, Delete>;

  Geos() : context_(GEOS_init_r()) {}
  Geos(const Geos&) = delete;
  Geos& operator=(const Geos&) = delete;
  ~Geos() { GEOS_finish_r(context_); }

  /// nullptr if the library fails.
  Geometry own(GEOSGeometry* g) const { return {g, Delete{context_}}; }

  Geometry closed_line(std::span<const Eigen::Vector2d> points, const Outline& outline) const {
    const auto size = unsigned(outline.size());
    GEOSCoordSequence* places = GEOSCoordSeq_create_r(context_, size + 1, 2);
    if (places == nullptr) return own(nullptr);
    for (unsigned i = 0; i <= size; ++i) {
      const Eigen::Vector2d& p = points[outline[i % size]];
      GEOSCoordSeq_setXY_r(context_, places, i, p.x(), p.y());
    }
    return own(GEOSGeom_createLineString_r(context_, places));
  }

  /// The area that the lines enclose.
  Geometry area(std::vector<Geometry> lines) const {
    std::vector<GEOSGeometry*> parts;
    for (Geometry& line : lines) {
      if (line == nullptr) return own(nullptr);
      parts.push_back(line.release());
    }
    const Geometry all = own(GEOSGeom_createCollection_r(context_, GEOS_MULTILINESTRING,
                                                         parts.data(), unsigned(parts.size())));
    return own(all == nullptr ? nullptr : GEOSBuildArea_r(context_, all.get()));
  }

  Geometry triangulation(const Geometry& area) const {
    return own(area == nullptr ? nullptr
                               : GEOSConstrainedDelaunayTriangulation_r(context_, area.get()));
  }

  /// The corners of each triangle of a triangulation; stops at a part that is not a triangle.
  std::vector<std::array<Eigen::Vector2d, 3>> corners(const Geometry& triangles) const {
    std::vector<std::array<Eigen::Vector2d, 3>> out;
    const int count = triangles == nullptr ? 0 : GEOSGetNumGeometries_r(context_, triangles.get());
    for (int t = 0; t < count; ++t) {
      const GEOSGeometry* part = GEOSGetGeometryN_r(context_, triangles.get(), t);
      const GEOSGeometry* ring = GEOSGetExteriorRing_r(context_, part);
      const GEOSCoordSequence* places =
          ring == nullptr ? nullptr : GEOSGeom_getCoordSeq_r(context_, ring);
      unsigned size = 0;
      if (places == nullptr || GEOSCoordSeq_getSize_r(context_, places, &size) == 0 || size != 4)
        return {};
      std::array<Eigen::Vector2d, 3> triangle;
      for (unsigned i = 0; i < 3; ++i)
        GEOSCoordSeq_getXY_r(context_, places, i, &triangle[i].x(), &triangle[i].y());
      out.push_back(triangle);
    }
    return out;
  }

 private:
  GEOSContextHandle_t context_;
};

/// The outlines' points, indexed by their exact position.
class PlaceTable {
 public:
  PlaceTable(std::span<const Eigen::Vector2d> points, std::span<const Outline> outlines) {
    for (const Outline& outline : outlines)
      for (const std::uint32_t v : outline) table_.emplace_back(key(points[v]), v);
    std::sort(table_.begin(), table_.end());
  }
  /// kNone if there is no such point.
  std::uint32_t at(const Eigen::Vector2d& place) const {
    const auto found =
        std::lower_bound(table_.begin(), table_.end(), std::pair(key(place), std::uint32_t(0)));
    return found == table_.end() || found->first != key(place) ? kNone : found->second;
  }

 private:
  using Key = std::pair<double, double>;
  static Key key(const Eigen::Vector2d& p) { return {p.x(), p.y()}; }
  std::vector<std::pair<Key, std::uint32_t>> table_;
};

/// Whether the triangles' edges are those of the outlines, each once and in the opposite direction,
/// and edges that two triangles share.
bool spans(const std::vector<Triangle>& triangles, std::span<const Outline> outlines) {
  std::vector<DirectedEdge> wanted, found;
  for (const Outline& outline : outlines) {
    for (std::size_t i = 0; i < outline.size(); ++i)
      wanted.emplace_back(outline[(i + 1) % outline.size()], outline[i]);
  }
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) found.emplace_back(t[i], t[(i + 1) % 3]);
  std::sort(wanted.begin(), wanted.end());
  std::sort(found.begin(), found.end());
  if (std::adjacent_find(found.begin(), found.end()) != found.end()) return false;
  std::vector<DirectedEdge> border;
  for (const DirectedEdge& e : found)
    if (!std::binary_search(found.begin(), found.end(), DirectedEdge(e.second, e.first)))
      border.push_back(e);
  return border == wanted;
}

}  // namespace

std::optional<std::vector<Triangle>> triangulate_outlines(std::span<const Eigen::Vector2d> points,
                                                          std::span<const Outline> outlines) {
  const Geos geos;
  std::vector<Geos::Geometry> lines;
  for (const Outline& outline : outlines) lines.push_back(geos.closed_line(points, outline));
  const PlaceTable places(points, outlines);
  std::vector<Triangle> triangles;
  for (const auto& corners : geos.corners(geos.triangulation(geos.area(std::move(lines))))) {
    Triangle t{};
    for (std::size_t i = 0; i < 3; ++i) {
      t[i] = places.at(corners[i]);
      if (t[i] == kNone) return std::nullopt;
    }
    const Eigen::Vector2d a = corners[1] - corners[0], b = corners[2] - corners[0];
    if (a.x() * b.y() - a.y() * b.x() > 0.0) std::swap(t[1], t[2]);
    triangles.push_back(t);
  }
  if (!spans(triangles, outlines)) return std::nullopt;
  return triangles;
}

}  // namespace turnscan::mesh
