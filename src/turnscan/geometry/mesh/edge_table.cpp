#include <algorithm>
#include <turnscan/geometry/mesh/edge_table.hpp>

namespace turnscan::mesh {

EdgeTable::EdgeTable(std::span<const std::array<std::uint32_t, 3>> triangles,
                     std::size_t vertex_count, std::span<const std::uint8_t> use) {
  const auto used = [&](std::size_t t) { return use.empty() || use[t] != 0; };
  // Counting sort by the smaller vertex, then each bucket (a handful) by the larger one.
  std::vector<std::uint32_t> start(vertex_count + 1, 0);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!used(t)) continue;
    const auto& v = triangles[t];
    for (int c = 0; c < 3; ++c) ++start[std::min(v[c], v[(c + 1) % 3]) + 1];
  }
  for (std::size_t v = 0; v < vertex_count; ++v) start[v + 1] += start[v];
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sorted(start.back());  // (larger, half edge)
  std::vector<std::uint32_t> cursor(start.begin(), start.end() - 1);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!used(t)) continue;
    const auto& v = triangles[t];
    for (std::uint32_t c = 0; c < 3; ++c) {
      const auto [low, high] = std::minmax(v[c], v[(c + 1) % 3]);
      sorted[cursor[low]++] = {high, std::uint32_t(3 * t) + c};
    }
  }
  half_edges_.reserve(sorted.size());
  first_.reserve(sorted.size() / 2 + 2);
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const auto begin = sorted.begin() + start[v], end = sorted.begin() + start[v + 1];
    std::sort(begin, end);
    for (auto it = begin; it != end; ++it) {
      if (it == begin || it->first != (it - 1)->first) {
        first_.push_back(std::uint32_t(half_edges_.size()));
      }
      half_edges_.push_back(it->second);
    }
  }
  first_.push_back(std::uint32_t(half_edges_.size()));
}

}  // namespace turnscan::mesh
