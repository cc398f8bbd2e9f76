#include <algorithm>
#include <array>
#include <turnscan/core/figure_text.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/grid/wrap.hpp>
#include <turnscan/geometry/mesh/mesh_measure.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/geometry/search/knn.hpp>
#include <turnscan/reconstruction/surface/surface_repair.hpp>

namespace turnscan::surface {

namespace {

/// Surface that Poisson invents is kept if its area is at most this factor of the tight
/// continuation's.
constexpr double kSwollenShare = 1.25;

/// Per vertex: 1 without a candidate within reach.
using Unsupported = std::vector<std::uint8_t>;

/// Tests the marked vertices, which may have moved, and unmarks those with a candidate in reach.
void unmark_supported(const TriangleMesh& mesh, const KdTree& tree, double reach_m,
                      Unsupported& marked) {
  const float reach2 = static_cast<float>(reach_m * reach_m);
  parallel_for(marked.size(), 1024, [&](std::size_t i) {
    if (!marked[i]) return;
    std::uint32_t index = 0;
    float squared = 0.0f;
    tree.knn(mesh.vertices[i], 1, &index, &squared);
    marked[i] = squared > reach2 ? 1 : 0;
  });
}

Unsupported find_unsupported(const TriangleMesh& mesh, const KdTree& tree, double reach_m) {
  Unsupported out(mesh.vertices.size(), 1);
  unmark_supported(mesh, tree, reach_m, out);
  return out;
}

struct MarkedPiece {
  TriangleMesh mesh;
  Unsupported unsupported;
};

/// A piece beside the main one is a part of the object if it has at least this share of its
/// vertices near candidates, and this share of the main piece's.
constexpr double kSupportedPart = 0.5, kPartOfMain = 0.02;

/// The piece with the most vertices near candidates, and, if requested, the other parts.
Result<MarkedPiece> main_piece(const TriangleMesh& mesh, const KdTree& tree, double reach_m,
                               Parts parts, std::vector<std::string>& notes) {
  TURNSCAN_ASSIGN(auto pieces, split_components(mesh));
  if (pieces.empty()) return fail(ErrorCode::kLibrary, "the surface has no triangles");
  std::vector<Unsupported> unsupported;
  std::vector<double> near;
  for (const TriangleMesh& piece : pieces) {
    unsupported.push_back(find_unsupported(piece, tree, reach_m));
    near.push_back(double(std::count(unsupported.back().begin(), unsupported.back().end(), 0)));
  }
  const auto main = std::size_t(std::max_element(near.begin(), near.end()) - near.begin());
  MarkedPiece out;
  std::vector<TriangleMesh> kept;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const bool part = parts == Parts::kAll && near[i] >= kPartOfMain * near[main] &&
                      near[i] >= kSupportedPart * double(pieces[i].vertices.size());
    if (i != main && !part) continue;
    kept.push_back(std::move(pieces[i]));
    out.unsupported.insert(out.unsupported.end(), unsupported[i].begin(), unsupported[i].end());
  }
  out.mesh = kept.size() == 1 ? std::move(kept[0]) : join_meshes(kept);
  if (const std::size_t removed = pieces.size() - kept.size(); removed > 0)
    notes.push_back(fmt::format("{} removed", removed == 1
                                                  ? std::string("one loose piece was")
                                                  : fmt::format("{} loose pieces were", removed)));
  return out;
}

/// Grows the mask over `rings` rings of neighbours.
void grow(const TriangleMesh& mesh, Unsupported& mask, int rings) {
  for (int r = 0; r < rings; ++r) {
    Unsupported next = mask;
    for (const auto& [a, b, c] : mesh.triangles) {
      if (mask[a] || mask[b] || mask[c]) next[a] = next[b] = next[c] = 1;
    }
    mask.swap(next);
  }
}

/// Labels the connected regions of masked vertices; -1 elsewhere. Returns their number.
int label_regions(const TriangleMesh& mesh, const std::vector<std::uint8_t>& mask,
                  std::vector<std::int32_t>& label) {
  std::vector<std::uint32_t> parent(mask.size());
  for (std::uint32_t i = 0; i < parent.size(); ++i) parent[i] = i;
  const auto root = [&](std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const auto& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (!mask[a] || !mask[b]) continue;
      const std::uint32_t ra = root(a), rb = root(b);
      parent[std::max(ra, rb)] = std::min(ra, rb);
    }
  }
  label.assign(mask.size(), -1);
  int count = 0;
  for (std::uint32_t i = 0; i < mask.size(); ++i) {
    if (!mask[i]) continue;
    const std::uint32_t r = root(i);
    if (r == i)
      label[i] = count++;
    else
      label[i] = label[r];
  }
  return count;
}

std::vector<double> region_areas(const TriangleMesh& mesh, const std::vector<std::int32_t>& label,
                                 int regions) {
  std::vector<double> areas(std::size_t(regions), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::uint32_t v : mesh.triangles[t]) {
      if (label[v] < 0) continue;
      areas[std::size_t(label[v])] += triangle_area(mesh, t);
      break;
    }
  }
  return areas;
}

/// Replaces swollen invented regions by a tight, smooth continuation of their surroundings.
Result<> deflate(MarkedPiece& piece, std::vector<std::string>& notes, const RunContext& context) {
  Unsupported region = piece.unsupported;
  grow(piece.mesh, region, 1);
  std::vector<std::int32_t> label;
  const int regions = label_regions(piece.mesh, region, label);
  if (regions == 0) return {};
  RelaxOptions tight;
  tight.tension = 0.7;
  TURNSCAN_ASSIGN(const TriangleMesh relaxed, relax(piece.mesh, region, tight, context));
  const auto before = region_areas(piece.mesh, label, regions),
             after = region_areas(relaxed, label, regions);
  int replaced = 0;
  std::vector<std::uint8_t> replace(std::size_t(regions), 0);
  for (std::size_t r = 0; r < replace.size(); ++r) {
    replace[r] = before[r] > kSwollenShare * after[r] ? 1 : 0;
    replaced += replace[r];
  }
  for (std::size_t v = 0; v < label.size(); ++v) {
    if (label[v] < 0 || !replace[std::size_t(label[v])]) continue;
    piece.mesh.vertices[v] = relaxed.vertices[v];
    piece.unsupported[v] = 1;
  }
  if (replaced > 0)
    notes.push_back(
        fmt::format("{} that no sensor saw {} tightened",
                    replaced == 1 ? std::string("one region") : fmt::format("{} regions", replaced),
                    replaced == 1 ? "was" : "were"));
  return {};
}

RepairedMesh checked(MarkedPiece piece, std::vector<std::string> notes) {
  RepairedMesh out;
  out.check = check_mesh(piece.mesh);
  for (std::size_t t = 0; t < piece.mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = piece.mesh.triangles[t];
    const bool invented = piece.unsupported[a] || piece.unsupported[b] || piece.unsupported[c];
    out.evidence.push_back(invented ? Evidence::kInvented : Evidence::kMeasured);
    if (invented) out.invented_area_m2 += triangle_area(piece.mesh, t);
  }
  out.mesh = std::move(piece.mesh);
  out.notes = std::move(notes);
  return out;
}

}  // namespace

Result<RepairedMesh> repair_poisson(const TriangleMesh& raw, const PointCloud& candidates,
                                    double reach_m, Parts parts, const RunContext& context) {
  const KdTree tree(candidates.points);
  std::vector<std::string> notes;
  context.begin_phase("repair", 3);
  TURNSCAN_ASSIGN(MarkedPiece piece, main_piece(raw, tree, reach_m, parts, notes));
  context.advance();
  MarkedPiece tight = piece;
  std::vector<std::string> tight_notes = notes;
  TURNSCAN_TRY(deflate(tight, tight_notes, context));
  context.advance();
  unmark_supported(tight.mesh, tree, reach_m, tight.unsupported);
  RepairedMesh out = checked(std::move(tight), std::move(tight_notes));
  // A sheet that was seen from one side only encloses nothing with its continuation.
  if (!out.check.watertight()) out = checked(std::move(piece), std::move(notes));
  context.advance();
  if (!out.check.watertight())
    return fail(ErrorCode::kLibrary, "the Poisson surface cannot be made watertight: {}",
                out.check.text());
  return out;
}

Result<RepairedMesh> repair_concave_hull(const TriangleMesh& raw, const PointCloud& candidates,
                                         double cell_m, double reach_m, Parts parts,
                                         const RunContext& context) {
  const KdTree tree(candidates.points);
  const MeshReport before = check_mesh(raw);
  std::vector<std::string> notes{
      fmt::format("concave hull: {} edges of three or more triangles, {} open edges; wrapped on "
                  "cells of {}",
                  before.non_manifold_edges, before.boundary_edges, length_text(cell_m))};
  TURNSCAN_ASSIGN(const TriangleMesh mesh, grid::wrap(raw, cell_m, context));
  TURNSCAN_ASSIGN(MarkedPiece piece, main_piece(mesh, tree, reach_m, parts, notes));
  RepairedMesh out = checked(std::move(piece), std::move(notes));
  if (!out.check.watertight())
    return fail(ErrorCode::kLibrary, "the concave hull cannot be made watertight: {}",
                out.check.text());
  return out;
}

void mark_base(RepairedMesh& repaired, const PointCloud& candidates, std::size_t added) {
  const TriangleMesh& mesh = repaired.mesh;
  if (added >= candidates.size() || repaired.evidence.empty()) return;
  const KdTree tree(candidates.points);
  std::vector<std::uint8_t> at_base(mesh.vertices.size(), 0);
  parallel_for(at_base.size(), 1024, [&](std::size_t v) {
    std::uint32_t index = 0;
    float squared = 0.0f;
    at_base[v] = tree.knn(mesh.vertices[v], 1, &index, &squared) > 0 && index >= added ? 1 : 0;
  });
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (repaired.evidence[t] == Evidence::kMeasured && at_base[a] && at_base[b] && at_base[c])
      repaired.evidence[t] = Evidence::kBase;
  }
}

void color_vertices(TriangleMesh& mesh, const PointCloud& candidates) {
  if (candidates.colors.size() != candidates.size() || candidates.empty()) return;
  const KdTree tree(candidates.points);
  mesh.colors.resize(mesh.vertices.size());
  parallel_for(mesh.vertices.size(), 1024, [&](std::size_t i) {
    std::array<std::uint32_t, 3> index{};
    std::array<float, 3> squared{};
    const std::size_t found = tree.knn(mesh.vertices[i], 3, index.data(), squared.data());
    Vec3d sum = Vec3d::Zero();
    double weight = 0.0;
    for (std::size_t k = 0; k < found; ++k) {
      const double w = 1.0 / (double(squared[k]) + 1e-9);
      const Rgb& c = candidates.colors[index[k]];
      sum += w * Vec3d(c.r, c.g, c.b);
      weight += w;
    }
    const Vec3d c = (sum / weight).array() + 0.5;
    mesh.colors[i] = {std::uint8_t(c.x()), std::uint8_t(c.y()), std::uint8_t(c.z())};
  });
}

}  // namespace turnscan::surface
