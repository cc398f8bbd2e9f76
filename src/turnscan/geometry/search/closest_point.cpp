#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/search/closest_point.hpp>

namespace turnscan {
namespace {

Vec3d closest_point_on_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d ab = b - a;
  const double length2 = ab.squaredNorm();
  if (!(length2 > 0.0)) return a;
  return a + ab * std::clamp((p - a).dot(ab) / length2, 0.0, 1.0);
}

Vec3d closest_point_on_edges(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  Vec3d best = closest_point_on_segment(p, a, b);
  for (const Vec3d& q : {closest_point_on_segment(p, b, c), closest_point_on_segment(p, c, a)}) {
    if ((q - p).squaredNorm() < (best - p).squaredNorm()) best = q;
  }
  return best;
}

}  // namespace

Vec3d closest_point_on_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return a;
  const Vec3d bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return b;
  const Vec3d cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return c;
  // For slivers the region test between edges and face has no precision left.
  const double normal2 = ab.cross(ac).squaredNorm();
  if (!(normal2 > 1e-12 * ab.squaredNorm() * ac.squaredNorm())) {
    return closest_point_on_edges(p, a, b, c);
  }
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return closest_point_on_segment(p, a, b);
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return closest_point_on_segment(p, a, c);
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) return closest_point_on_segment(p, b, c);
  const double scale = 1.0 / (va + vb + vc);
  return a + ab * (vb * scale) + ac * (vc * scale);
}

namespace {

constexpr std::size_t kLeafSize = 4;
constexpr std::size_t kBuiltAtOnce = 8192;  ///< triangles below a node that one thread builds
constexpr std::uint32_t kLeafBit = 0x80000000u;

struct FloatBox {
  Vec3f lo = Vec3f::Constant(std::numeric_limits<float>::infinity());
  Vec3f hi = Vec3f::Constant(-std::numeric_limits<float>::infinity());
  void add(const Vec3f& p) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  bool meets(const Vec3f& low, const Vec3f& high) const {
    return (lo.array() <= high.array()).all() && (hi.array() >= low.array()).all();
  }
  double squared_distance(const Vec3d& p) const {
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double below = double(lo[axis]) - p[axis], above = p[axis] - double(hi[axis]);
      const double d = std::max(std::max(below, above), 0.0);
      sum += d * d;
    }
    return sum;
  }
};

struct Corners {
  Vec3f a, b, c;
};

/// Both children with their boxes. A child is an inner node, or with kLeafBit the index of its
/// first triangle and, in count, their number.
struct Node {
  FloatBox box[2];
  std::uint32_t child[2] = {0, 0};
  std::uint32_t count[2] = {0, 0};
};

struct Item {
  Vec3f centroid;
  std::uint32_t triangle;
};

/// Number of nodes of a subtree with this many triangles; 0 for a leaf.
std::size_t nodes_below(std::size_t triangles) {
  if (triangles <= kLeafSize) return 0;
  const std::size_t half = triangles / 2;
  return 1 + nodes_below(half) + nodes_below(triangles - half);
}

}  // namespace

struct MeshDistance::Impl {
  std::vector<Node> nodes;         // nodes[0] is the root; empty for an empty mesh
  std::vector<Corners> corners;    // in the order of leaves
  std::vector<std::uint32_t> ids;  // position -> triangle of the mesh
  double rounding_m = 0.0;         // upper bound of the rounding error of a distance

  Impl(const TriangleMesh& mesh, const RunContext& context);
  FloatBox build_node(std::uint32_t node, std::vector<Item>& items, std::size_t begin,
                      std::size_t end);
  FloatBox set_child(std::uint32_t node, int side, std::uint32_t child, std::vector<Item>& items,
                     std::size_t begin, std::size_t end);
  void query(const Vec3d& p, double max_distance, Hit& best) const;
  const TriangleMesh* source = nullptr;  // this and the context while building
  const RunContext* context = nullptr;
};

/// Useless once the context is cancelled.
MeshDistance::Impl::Impl(const TriangleMesh& mesh, const RunContext& run)
    : source(&mesh), context(&run) {
  std::vector<Item> items;
  items.reserve(mesh.triangles.size());
  float largest = 0.0f;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (std::max({a, b, c}) >= mesh.vertices.size()) continue;
    const Vec3f &pa = mesh.vertices[a], &pb = mesh.vertices[b], &pc = mesh.vertices[c];
    if (!pa.allFinite() || !pb.allFinite() || !pc.allFinite()) continue;
    items.push_back({(pa + pb + pc) / 3.0f, t});
    largest = std::max(
        {largest, pa.cwiseAbs().maxCoeff(), pb.cwiseAbs().maxCoeff(), pc.cwiseAbs().maxCoeff()});
  }
  rounding_m = 1e-12 * double(largest);
  if (items.empty()) return;
  nodes.resize(std::max<std::size_t>(1, nodes_below(items.size())));
  build_node(0, items, 0, items.size());
  if (run.cancelled()) return;
  corners.reserve(items.size());
  ids.reserve(items.size());
  for (const Item& item : items) {
    const auto& [a, b, c] = mesh.triangles[item.triangle];
    corners.push_back({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
    ids.push_back(item.triangle);
  }
  source = nullptr;
  context = nullptr;
}

FloatBox MeshDistance::Impl::build_node(std::uint32_t node, std::vector<Item>& items,
                                        std::size_t begin, std::size_t end) {
  if (end - begin > kBuiltAtOnce && context->cancelled()) return {};
  FloatBox centroids;
  for (std::size_t i = begin; i < end; ++i) centroids.add(items[i].centroid);
  int axis = 0;
  (centroids.hi - centroids.lo).maxCoeff(&axis);
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return items.begin() + std::ptrdiff_t(i); };
  std::nth_element(at(begin), at(middle), at(end), [axis](const Item& a, const Item& b) {
    return a.centroid[axis] < b.centroid[axis] ||
           (a.centroid[axis] == b.centroid[axis] && a.triangle < b.triangle);
  });
  // Nodes are stored in depth-first order, first child first.
  const std::uint32_t child[2] = {node + 1, node + 1 + std::uint32_t(nodes_below(middle - begin))};
  FloatBox box[2];
  parallel_for(2, end - begin > kBuiltAtOnce ? 1 : 2, [&](std::size_t side) {
    box[side] = set_child(node, int(side), child[side], items, side == 0 ? begin : middle,
                          side == 0 ? middle : end);
  });
  box[0].add(box[1].lo);
  box[0].add(box[1].hi);
  return box[0];
}

FloatBox MeshDistance::Impl::set_child(std::uint32_t node, int side, std::uint32_t child,
                                       std::vector<Item>& items, std::size_t begin,
                                       std::size_t end) {
  FloatBox box;
  const bool leaf = end - begin <= kLeafSize;
  if (leaf) {
    for (std::size_t i = begin; i < end; ++i)
      for (const std::uint32_t v : source->triangles[items[i].triangle])
        box.add(source->vertices[v]);
  } else {
    box = build_node(child, items, begin, end);
  }
  nodes[node].box[side] = box;
  nodes[node].child[side] = leaf ? (std::uint32_t(begin) | kLeafBit) : child;
  nodes[node].count[side] = leaf ? std::uint32_t(end - begin) : 0;
  return box;
}

void MeshDistance::Impl::query(const Vec3d& p, double max_distance, Hit& best) const {
  struct Pending {
    double bound;
    std::uint32_t child, count;
  };
  Pending stack[128];  // the tree is balanced: fewer than 64 levels
  int depth = 0;
  const double slack = rounding_m + 1e-12 * p.cwiseAbs().maxCoeff();
  double best2 = max_distance * max_distance;
  double limit = (max_distance + slack) * (max_distance + slack);
  stack[depth++] = {0.0, 0, 0};
  while (depth > 0) {
    const Pending next = stack[--depth];
    if (next.bound > limit) continue;
    if ((next.child & kLeafBit) == 0) {
      const Node& node = nodes[next.child];
      const double d0 = node.box[0].squared_distance(p), d1 = node.box[1].squared_distance(p);
      const int near = d1 < d0 ? 1 : 0;
      stack[depth++] = {near ? d0 : d1, node.child[1 - near], node.count[1 - near]};
      stack[depth++] = {near ? d1 : d0, node.child[near], node.count[near]};
      continue;
    }
    const std::uint32_t first = next.child & ~kLeafBit;
    for (std::uint32_t i = first; i < first + next.count; ++i) {
      const Corners& t = corners[i];
      const Vec3d q =
          closest_point_on_triangle(p, t.a.cast<double>(), t.b.cast<double>(), t.c.cast<double>());
      const double d2 = (q - p).squaredNorm();
      if (!(d2 < best2 || (d2 == best2 && ids[i] < best.triangle))) continue;
      best2 = d2;
      best.point = q;
      best.triangle = ids[i];
      best.distance = std::sqrt(d2);
      limit = (best.distance + slack) * (best.distance + slack);
    }
  }
}

MeshDistance::MeshDistance(const TriangleMesh& mesh)
    : impl_(std::make_unique<Impl>(mesh, RunContext())) {}
MeshDistance::MeshDistance(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Result<MeshDistance> MeshDistance::create(const TriangleMesh& mesh, const RunContext& context) {
  auto impl = std::make_unique<Impl>(mesh, context);
  TURNSCAN_TRY(context.check());
  return MeshDistance(std::move(impl));
}
MeshDistance::MeshDistance(MeshDistance&&) noexcept = default;
MeshDistance& MeshDistance::operator=(MeshDistance&&) noexcept = default;
MeshDistance::~MeshDistance() = default;

MeshDistance::Hit MeshDistance::closest(const Vec3d& p, double max_distance) const {
  Hit best;
  if (!impl_->nodes.empty() && p.allFinite() && max_distance >= 0.0) {
    impl_->query(p, max_distance, best);
  }
  return best;
}

void MeshDistance::append_near(const Vec3f& low, const Vec3f& high, std::size_t most,
                               std::vector<std::uint32_t>& out) const {
  if (impl_->nodes.empty()) return;
  std::uint32_t stack[64];  // as in query()
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0 && out.size() < most) {
    const Node& node = impl_->nodes[stack[--depth]];
    for (int side = 0; side < 2; ++side) {
      if (!node.box[side].meets(low, high)) continue;
      const std::uint32_t child = node.child[side];
      if ((child & kLeafBit) == 0) {
        stack[depth++] = child;
        continue;
      }
      const auto first = impl_->ids.begin() + std::ptrdiff_t(child & ~kLeafBit);
      out.insert(out.end(), first, first + std::ptrdiff_t(node.count[side]));
    }
  }
}

}  // namespace turnscan
