#include <algorithm>
#include <numeric>
#include <turnscan/reconstruction/texture/chart_packing.hpp>

namespace turnscan::texture {

namespace {

/// The row at which a chart comes to rest in a column.
int rest_of(const ChartOutline& chart, const std::vector<int>& ground, int column) {
  int row = 0;
  for (int c = 0; c < chart.width; ++c)
    row = std::max(row, ground[std::size_t(column + c)] - chart.bottom[std::size_t(c)]);
  return row;
}

}  // namespace

std::optional<std::vector<ChartPlace>> pack_charts(const std::vector<ChartOutline>& charts,
                                                   int side) {
  std::vector<std::size_t> order(charts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return charts[a].height > charts[b].height;
  });
  std::vector<int> ground(std::size_t(side), 0);
  std::vector<ChartPlace> places(charts.size());
  for (const std::size_t i : order) {
    const ChartOutline& chart = charts[i];
    ChartPlace best;
    int lowest = side + 1;
    for (int column = 0; column + chart.width <= side; ++column) {
      const int row = rest_of(chart, ground, column);
      if (row + chart.height < lowest) lowest = row + chart.height, best = {column, row};
    }
    if (lowest > side) return std::nullopt;
    places[i] = best;
    for (int c = 0; c < chart.width; ++c)
      ground[std::size_t(best.column + c)] = best.row + chart.top[std::size_t(c)];
  }
  return places;
}

}  // namespace turnscan::texture
