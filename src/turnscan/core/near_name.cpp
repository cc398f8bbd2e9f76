#include <algorithm>
#include <turnscan/core/near_name.hpp>

namespace turnscan {

namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row.back();
}

}  // namespace

std::optional<std::string> near_name(std::string_view name, const std::vector<std::string>& names) {
  std::optional<std::string> nearest;
  // A third of the letters: "fps" is not a misspelling of "pass".
  std::size_t least = name.size() / 3 + 1;
  for (const std::string& other : names) {
    const bool begins_so = name.size() >= 3 && other.starts_with(name);
    const std::size_t distance = begins_so ? 1 : edit_distance(other, name);
    if (distance >= least) continue;
    least = distance;
    nearest = other;
  }
  return nearest;
}

}  // namespace turnscan
