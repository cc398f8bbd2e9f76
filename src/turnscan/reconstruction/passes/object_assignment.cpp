#include <algorithm>
#include <limits>
#include <turnscan/reconstruction/passes/object_assignment.hpp>

namespace turnscan::passes {

namespace {

/// Kuhn 1955 with potentials, row after row along shortest augmenting paths (Jonker and Volgenant
/// 1987), on a square table of costs; indices start at 1, 0 is none.
std::vector<std::size_t> rows_of_columns(std::size_t n, const std::vector<double>& cost) {
  std::vector<double> row_potential(n + 1, 0.0), column_potential(n + 1, 0.0);
  std::vector<std::size_t> row_of(n + 1, 0), before(n + 1, 0);
  for (std::size_t row = 1; row <= n; ++row) {
    row_of[0] = row;
    std::size_t column = 0;
    std::vector<double> least(n + 1, std::numeric_limits<double>::infinity());
    std::vector<bool> reached(n + 1, false);
    do {
      reached[column] = true;
      const std::size_t from = row_of[column];
      double step = std::numeric_limits<double>::infinity();
      std::size_t next = 0;
      for (std::size_t c = 1; c <= n; ++c) {
        if (reached[c]) continue;
        const double reduced =
            cost[(from - 1) * n + c - 1] - row_potential[from] - column_potential[c];
        if (reduced < least[c]) {
          least[c] = reduced;
          before[c] = column;
        }
        if (least[c] < step) {
          step = least[c];
          next = c;
        }
      }
      for (std::size_t c = 0; c <= n; ++c) {
        if (reached[c]) {
          row_potential[row_of[c]] += step;
          column_potential[c] -= step;
        } else {
          least[c] -= step;
        }
      }
      column = next;
    } while (row_of[column] != 0);
    for (; column != 0; column = before[column]) row_of[column] = row_of[before[column]];
  }
  return row_of;
}

}  // namespace

Assignment assign_objects(const EvidenceTable& evidence) {
  const std::size_t rows = evidence.size(), columns = rows == 0 ? 0 : evidence[0].size();
  const std::size_t n = std::max(rows, columns);
  std::vector<double> cost(n * n, 0.0);
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c) cost[r * n + c] = -std::max(0.0, evidence[r][c]);
  const std::vector<std::size_t> row_of = rows_of_columns(n, cost);
  Assignment out;
  out.column_of.resize(rows);
  for (std::size_t c = 0; c < columns; ++c) {
    const std::size_t r = row_of[c + 1] - 1;
    if (r >= rows || !(evidence[r][c] > 0.0)) continue;
    out.column_of[r] = c;
    out.evidence += evidence[r][c];
  }
  return out;
}

}  // namespace turnscan::passes
