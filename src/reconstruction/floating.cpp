#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/knn.hpp>
#include <turnscan/reconstruction/floating.hpp>

namespace turnscan {

namespace {

/// From what floats to what stands.
struct Bridge {
  std::size_t from = 0, to = 0;
  double squared = std::numeric_limits<double>::infinity();
};

double longest_side(const std::vector<Vec3f>& points) { return bounds(points).size().maxCoeff(); }

void shorten(const std::vector<Vec3f>& from, const KdTree& tree, std::size_t to, Bridge& bridge) {
  std::vector<float> squared(from.size(), std::numeric_limits<float>::infinity());
  parallel_for(from.size(), 1024, [&](std::size_t i) {
    std::uint32_t index = 0;
    tree.knn(from[i], 1, &index, &squared[i]);
  });
  for (const float s : squared) {
    if (double(s) < bridge.squared) bridge.squared = s, bridge.to = to;
  }
}

Bridge take_shortest(std::vector<Bridge>& bridges) {
  const auto best =
      std::min_element(bridges.begin(), bridges.end(),
                       [](const Bridge& a, const Bridge& b) { return a.squared < b.squared; });
  const Bridge out = *best;
  bridges.erase(best);
  return out;
}

}  // namespace

std::vector<std::size_t> find_holders(const std::vector<PlacedPiece>& pieces,
                                      double farthest_of_size) {
  std::vector<std::size_t> holder(pieces.size());
  std::iota(holder.begin(), holder.end(), std::size_t(0));
  std::vector<std::size_t> standing;
  std::vector<Bridge> bridges;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].stands) {
      standing.push_back(i);
    } else {
      bridges.emplace_back();
      bridges.back().from = i;
    }
  }
  for (std::size_t s = 0; s < standing.size() && !bridges.empty(); ++s) {
    const KdTree tree(pieces[standing[s]].points);
    for (Bridge& bridge : bridges)
      shorten(pieces[bridge.from].points, tree, holder[standing[s]], bridge);
    if (s + 1 < standing.size()) continue;
    // All that stands has been looked at: the nearest that floats stands from now on.
    while (!bridges.empty()) {
      const Bridge best = take_shortest(bridges);
      const double farthest = farthest_of_size * longest_side(pieces[best.from].points);
      if (std::sqrt(best.squared) > farthest) continue;
      holder[best.from] = best.to;
      standing.push_back(best.from);
      break;
    }
  }
  return holder;
}

}  // namespace turnscan
