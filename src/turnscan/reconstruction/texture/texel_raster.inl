// Body of for_each_texel(): see atlas.hpp.

namespace turnscan::texture {

template <class Texel>
void for_each_texel(const std::array<Eigen::Vector2f, 3>& corners, const Texel& texel) {
  using Int = std::int64_t;
  constexpr Int kOne = 256;
  std::array<Int, 3> x{}, y{};
  for (std::size_t k = 0; k < 3; ++k) {
    x[k] = Int(std::floor(corners[k].x() * float(kOne) + 0.5f));
    y[k] = Int(std::floor(corners[k].y() * float(kOne) + 0.5f));
  }
  Int area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  if (area == 0) return;
  if (area < 0) std::swap(x[1], x[2]), std::swap(y[1], y[2]);
  const auto [least_x, most_x] = std::minmax({x[0], x[1], x[2]});
  const auto [least_y, most_y] = std::minmax({y[0], y[1], y[2]});
  const auto first = [](Int v) { return (v - kOne / 2 + kOne - 1) >> 8; };  // centre at or after
  const auto last = [](Int v) { return (v - kOne / 2) >> 8; };
  std::array<Int, 3> dx{}, dy{}, at_edge{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    dx[k] = x[next] - x[k], dy[k] = y[next] - y[k];
    // Of two triangles along an edge, one runs it up and the other one down.
    at_edge[k] = dy[k] < 0 || (dy[k] == 0 && dx[k] > 0) ? 0 : 1;
  }
  for (Int row = first(least_y); row <= last(most_y); ++row) {
    for (Int column = first(least_x); column <= last(most_x); ++column) {
      const Int px = column * kOne + kOne / 2, py = row * kOne + kOne / 2;
      bool inside = true;
      for (std::size_t k = 0; k < 3 && inside; ++k)
        inside = dx[k] * (py - y[k]) - dy[k] * (px - x[k]) >= at_edge[k];
      if (inside) texel(int(column), int(row));
    }
  }
}

}  // namespace turnscan::texture
