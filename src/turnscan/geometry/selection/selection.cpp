#include <turnscan/geometry/selection/selection.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <turnscan/core/disjoint_sets.hpp>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/search/knn.hpp>
#include <unordered_map>

namespace turnscan {

namespace {

void must_fit(const Selection& selection, std::size_t count) {
  if (selection.size() != count)
    throw std::invalid_argument("a selection has one flag a triangle or point");
}

/// Small pieces of elements that belong to the piece `piece_of` and have the weight `weight_of`.
SmallPieces small_pieces(const std::vector<std::uint32_t>& piece_of,
                         const std::vector<double>& weight_of, double share) {
  std::unordered_map<std::uint32_t, double> weights;
  for (std::size_t i = 0; i < piece_of.size(); ++i) weights[piece_of[i]] += weight_of[i];
  double largest = 0.0;
  for (const auto& [piece, weight] : weights) largest = std::max(largest, weight);
  SmallPieces out;
  out.parts.resize(piece_of.size());
  const auto small = [&](double weight) { return weight < share * largest; };
  for (const auto& [piece, weight] : weights) out.pieces += small(weight) ? 1 : 0;
  for (std::size_t i = 0; i < piece_of.size(); ++i)
    out.parts[i] = small(weights[piece_of[i]]) ? 1 : 0;
  return out;
}

DisjointSets pieces_of(const TriangleMesh& mesh) {
  DisjointSets pieces(mesh.vertices.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    pieces.join(a, b);
    pieces.join(b, c);
  }
  return pieces;
}

}  // namespace

void change_selection(Selection& selection, const Selection& picked, SelectHow how) {
  if (selection.empty()) selection.assign(picked.size(), 0);
  must_fit(selection, picked.size());
  for (std::size_t i = 0; i < picked.size(); ++i) {
    const bool now = how == SelectHow::kReplace ? picked[i] != 0
                     : how == SelectHow::kAdd   ? selection[i] != 0 || picked[i] != 0
                                                : selection[i] != 0 && picked[i] == 0;
    selection[i] = now ? 1 : 0;
  }
}

Selection inverted(const Selection& selection) {
  Selection out(selection.size());
  std::transform(selection.begin(), selection.end(), out.begin(),
                 [](std::uint8_t flag) { return flag == 0 ? 1 : 0; });
  return out;
}

std::size_t count_selected(const Selection& selection) {
  return selection.size() - std::size_t(std::count(selection.begin(), selection.end(), 0));
}

Selection grown(const TriangleMesh& mesh, const Selection& selection) {
  must_fit(selection, mesh.triangles.size());
  std::vector<std::uint8_t> touched(mesh.vertices.size(), 0);
  for (std::size_t t = 0; t < selection.size(); ++t)
    if (selection[t] != 0)
      for (const std::uint32_t v : mesh.triangles[t]) touched[v] = 1;
  Selection out(selection.size());
  for (std::size_t t = 0; t < out.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    out[t] = touched[a] != 0 || touched[b] != 0 || touched[c] != 0 ? 1 : 0;
  }
  return out;
}

Selection shrunk(const TriangleMesh& mesh, const Selection& selection) {
  return inverted(grown(mesh, inverted(selection)));
}

Selection connected(const TriangleMesh& mesh, const Selection& selection) {
  must_fit(selection, mesh.triangles.size());
  DisjointSets pieces = pieces_of(mesh);
  std::vector<std::uint8_t> chosen(mesh.vertices.size(), 0);
  for (std::size_t t = 0; t < selection.size(); ++t)
    if (selection[t] != 0) chosen[pieces.root(mesh.triangles[t][0])] = 1;
  Selection out(selection.size());
  for (std::size_t t = 0; t < out.size(); ++t) out[t] = chosen[pieces.root(mesh.triangles[t][0])];
  return out;
}

SmallPieces small_pieces(const TriangleMesh& mesh, double share) {
  DisjointSets pieces = pieces_of(mesh);
  std::vector<std::uint32_t> piece_of(mesh.triangles.size());
  std::vector<double> areas(piece_of.size());
  for (std::size_t t = 0; t < piece_of.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3f& p = mesh.vertices[a];
    piece_of[t] = pieces.root(a);
    areas[t] = 0.5 * double((mesh.vertices[b] - p).cross(mesh.vertices[c] - p).norm());
  }
  return small_pieces(piece_of, areas, share);
}

Selection grown(std::span<const Vec3f> points, const Selection& selection, double reach_m) {
  must_fit(selection, points.size());
  const KdTree tree(points);
  // Each point searches for a selected neighbour, so that no thread writes another's flag.
  Selection out(selection.size());
  parallel_for(out.size(), 1024, [&](std::size_t i) {
    out[i] = selection[i] != 0 ? 1 : 0;
    if (out[i] != 0) return;
    std::vector<std::pair<std::uint32_t, float>> near;
    tree.radius(points[i], float(reach_m), near);
    for (const auto& [other, distance] : near)
      if (selection[other] != 0) out[i] = 1;
  });
  return out;
}

Selection shrunk(std::span<const Vec3f> points, const Selection& selection, double reach_m) {
  return inverted(grown(points, inverted(selection), reach_m));
}

Selection connected(std::span<const Vec3f> points, const Selection& selection, double reach_m) {
  must_fit(selection, points.size());
  const KdTree tree(points);
  Selection out(selection.size(), 0);
  std::vector<std::uint32_t> open;
  for (std::size_t i = 0; i < out.size(); ++i)
    if (selection[i] != 0) {
      out[i] = 1;
      open.push_back(std::uint32_t(i));
    }
  std::vector<std::pair<std::uint32_t, float>> near;
  while (!open.empty()) {
    tree.radius(points[open.back()], float(reach_m), near);
    open.pop_back();
    for (const auto& [other, distance] : near) {
      if (out[other] != 0) continue;
      out[other] = 1;
      open.push_back(other);
    }
  }
  return out;
}

SmallPieces small_pieces(std::span<const Vec3f> points, double share, double reach_m) {
  const KdTree tree(points);
  DisjointSets pieces(points.size());
  std::vector<std::pair<std::uint32_t, float>> near;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    tree.radius(points[i], float(reach_m), near);
    for (const auto& [other, distance] : near) pieces.join(i, other);
  }
  std::vector<std::uint32_t> piece_of(points.size());
  for (std::uint32_t i = 0; i < piece_of.size(); ++i) piece_of[i] = pieces.root(i);
  return small_pieces(piece_of, std::vector<double>(points.size(), 1.0), share);
}

double usual_reach(std::span<const Vec3f> points) {
  constexpr std::size_t kAsked = 2000;
  const KdTree tree(points);
  std::vector<float> nearest;
  const std::size_t step = std::max<std::size_t>(1, points.size() / kAsked);
  for (std::size_t i = 0; i < points.size(); i += step) {
    std::uint32_t index[2];
    float squared[2];
    if (tree.knn(points[i], 2, index, squared) == 2) nearest.push_back(squared[1]);
  }
  return 2.0 * std::sqrt(median(nearest));
}

}  // namespace turnscan
