#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/search/knn.hpp>
#include <turnscan/reconstruction/surface/detached_components.hpp>

namespace turnscan::tsdf {

namespace {

/// From a detached component to one that stands.
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

std::vector<std::size_t> attach_detached(const std::vector<PlacedComponent>& components,
                                         double farthest_of_size) {
  std::vector<std::size_t> attached(components.size());
  std::iota(attached.begin(), attached.end(), std::size_t(0));
  std::vector<std::size_t> standing;
  std::vector<Bridge> bridges;
  for (std::size_t i = 0; i < components.size(); ++i) {
    if (components[i].stands) {
      standing.push_back(i);
    } else {
      bridges.emplace_back();
      bridges.back().from = i;
    }
  }
  for (std::size_t s = 0; s < standing.size() && !bridges.empty(); ++s) {
    const KdTree tree(components[standing[s]].points);
    for (Bridge& bridge : bridges)
      shorten(components[bridge.from].points, tree, attached[standing[s]], bridge);
    if (s + 1 < standing.size()) continue;
    // Distances to all standing components are known: the nearest detached one counts as standing
    // from now on.
    while (!bridges.empty()) {
      const Bridge best = take_shortest(bridges);
      const double farthest = farthest_of_size * longest_side(components[best.from].points);
      if (std::sqrt(best.squared) > farthest) continue;
      attached[best.from] = best.to;
      standing.push_back(best.from);
      break;
    }
  }
  return attached;
}

}  // namespace turnscan::tsdf
