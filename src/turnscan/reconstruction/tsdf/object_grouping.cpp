#include <algorithm>
#include <limits>
#include <numeric>
#include <turnscan/geometry/mesh/mesh_measure.hpp>
#include <turnscan/reconstruction/surface/detached_components.hpp>
#include <turnscan/reconstruction/tsdf/object_grouping.hpp>

namespace turnscan::tsdf {

namespace {

constexpr std::size_t kNotKept = std::numeric_limits<std::size_t>::max();

/// Numbers of the components that may be objects, largest area first.
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

/// For each component of the order the one of it that it is attached to. The largest stands,
/// whatever lies below it.
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

}  // namespace

bool encloses_volume(const TriangleMesh& mesh) { return !(signed_volume(mesh) <= 0.0); }

std::vector<std::vector<TriangleMesh>> group_objects(std::vector<TriangleMesh> components,
                                                     const GroupingRules& rules) {
  const std::vector<std::size_t> order = by_area(components, rules.min_share);
  const std::vector<std::size_t> attached = attachments(components, order, rules.detached_above_m);
  std::vector<std::vector<TriangleMesh>> objects;
  std::vector<std::size_t> object(order.size(), kNotKept);  // of what stands
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (attached[i] != i || (rules.keep != 0 && objects.size() >= rules.keep)) continue;
    object[i] = objects.size();
    objects.emplace_back().push_back(std::move(components[order[i]]));
  }
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (attached[i] == i || object[attached[i]] == kNotKept) continue;
    objects[object[attached[i]]].push_back(std::move(components[order[i]]));
  }
  return objects;
}

}  // namespace turnscan::tsdf
