#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <turnscan/geometry/mesh/mesh_measure.hpp>
#include <turnscan/geometry/search/knn.hpp>
#include <turnscan/reconstruction/surface/detached_components.hpp>
#include <turnscan/reconstruction/tsdf/object_grouping.hpp>

namespace turnscan::tsdf {

namespace {

constexpr std::size_t kNotKept = std::numeric_limits<std::size_t>::max();

/// Indices of the components that may be objects, largest area first.
std::vector<std::size_t> by_area(const std::vector<TriangleMesh>& components, double min_share) {
  std::vector<double> areas;
  for (const TriangleMesh& component : components) areas.push_back(surface_area(component));
  std::vector<std::size_t> order(components.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return areas[a] > areas[b]; });
  std::erase_if(order, [&](std::size_t i) {
    return areas[i] < min_share * areas[order[0]] || !encloses_volume(components[i]);
  });
  return order;
}

/// For each component of the order the one of it that it is attached to. The largest stands, even
/// if something is below it.
std::vector<std::size_t> attachments(const std::vector<TriangleMesh>& components,
                                     const std::vector<std::size_t>& order,
                                     const std::optional<double>& detached_above_m) {
  std::vector<PlacedComponent> placed(order.size());
  bool any = false;
  for (std::size_t i = 0; i < order.size(); ++i) {
    placed[i].stands = i == 0 || !detached_above_m ||
                       !(bounds(components[order[i]].vertices).min.y() > *detached_above_m);
    any |= !placed[i].stands;
  }
  for (std::size_t i = 0; any && i < order.size(); ++i)
    placed[i].points = components[order[i]].vertices;
  return attach_detached(placed, std::numeric_limits<double>::infinity());
}

bool are_close(const TriangleMesh& a, const TriangleMesh& b, double gap_m) {
  const Box box_a = bounds(a.vertices), box_b = bounds(b.vertices);
  if (((box_a.min - box_b.max).array() > gap_m).any() ||
      ((box_b.min - box_a.max).array() > gap_m).any())
    return false;
  const KdTree tree(a.vertices);
  const float reach = float(gap_m);
  std::uint32_t index = 0;
  float squared = 0.0f;
  return std::any_of(b.vertices.begin(), b.vertices.end(), [&](const Vec3f& p) {
    return tree.knn(p, 1, &index, &squared, std::nextafter(reach, 2 * reach)) > 0 &&
           squared <= reach * reach;
  });
}

/// Joins component i of the order, which stands, with the groups of larger ones close to it.
void join_close(const std::vector<TriangleMesh>& components, const std::vector<std::size_t>& order,
                const std::vector<std::size_t>& attached, double gap_m, std::size_t i,
                std::vector<std::size_t>& first) {
  for (std::size_t j = 0; j < i; ++j) {
    if (attached[j] != j || first[j] == first[i] ||
        !are_close(components[order[j]], components[order[i]], gap_m))
      continue;
    const std::size_t from = std::max(first[i], first[j]), to = std::min(first[i], first[j]);
    for (std::size_t k = 0; k <= i; ++k)
      if (attached[k] == k && first[k] == from) first[k] = to;
  }
}

}  // namespace

bool encloses_volume(const TriangleMesh& mesh) { return !(signed_volume(mesh) <= 0.0); }

std::vector<ObjectComponents> group_objects(std::vector<TriangleMesh> components,
                                            const GroupingRules& rules) {
  const std::vector<std::size_t> order = by_area(components, rules.min_share);
  const std::vector<std::size_t> attached = attachments(components, order, rules.detached_above_m);
  std::vector<std::size_t> first(order.size());  // of standing ones: the largest of those close to
                                                 // it
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (attached[i] != i) continue;
    first[i] = i;
    if (rules.gap_m > 0.0) join_close(components, order, attached, rules.gap_m, i, first);
  }
  std::vector<ObjectComponents> objects;
  std::vector<std::size_t> object(order.size(), kNotKept);  // of standing ones
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (attached[i] != i || (first[i] == i && rules.keep != 0 && objects.size() >= rules.keep))
      continue;
    if (first[i] == i) {
      object[i] = objects.size();
      objects.emplace_back();
    } else {
      object[i] = object[first[i]];
    }
    if (object[i] != kNotKept)
      objects[object[i]].components.push_back(std::move(components[order[i]]));
  }
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (attached[i] == i || object[attached[i]] == kNotKept) continue;
    ObjectComponents& its = objects[object[attached[i]]];
    its.components.push_back(std::move(components[order[i]]));
    ++its.detached;
  }
  return objects;
}

}  // namespace turnscan::tsdf
