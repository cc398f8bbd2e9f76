#include <algorithm>
#include <limits>
#include <numeric>
#include <queue>
#include <turnscan/core/disjoint_sets.hpp>
#include <turnscan/geometry/mesh/cut_handles.hpp>
#include <turnscan/geometry/mesh/edge_table.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/mesh/mesh_edit.hpp>

namespace turnscan {

namespace {

using mesh::kNone;
using mesh::next_in_triangle;
using mesh::previous_in_triangle;

constexpr double kSeedsApart = 0.25;  ///< relative to the longest loop
constexpr int kShortenings = 4;       ///< of a loop found from a nearby seed
constexpr int kMaxPasses = 16;
constexpr float kRetreat = 0.25f;  ///< share of the distance to the neighbours by which the two
                                   ///< sides move apart

constexpr float kFar = std::numeric_limits<float>::max();

/// Distance of a vertex along edges from the centre of a ball, and the half edge by which it is
/// reached.
struct Reached {
  float distance = kFar;
  std::uint32_t by = kNone;
};

/// A loop as the half edges along it.
using Loop = std::vector<std::uint32_t>;

/// The half edge on the other side of each one's edge.
std::vector<std::uint32_t> opposites(const TriangleMesh& mesh) {
  const mesh::EdgeTable edges(mesh.triangles, mesh.vertices.size());
  std::vector<std::uint32_t> out(3 * mesh.triangles.size(), kNone);
  for (std::size_t e = 0; e < edges.edge_count(); ++e) {
    const auto halves = edges.half_edges(e);
    if (halves.size() != 2) continue;
    out[halves[0]] = halves[1];
    out[halves[1]] = halves[0];
  }
  return out;
}

/// One round of cuts along loops that share no vertex.
class HandleCutter {
 public:
  /// searched: per vertex, 1 if no loop can be near; updated with the results of this round.
  HandleCutter(TriangleMesh& mesh, std::vector<std::uint8_t>& cuttable,
               std::vector<std::uint8_t>& searched, double longest_m)
      : mesh_(mesh),
        cuttable_(cuttable),
        free_(cuttable),
        longest_(longest_m),
        opposite_(opposites(mesh)),
        on_loop_(opposite_.size(), 0),
        leaving_(mesh.vertices.size(), kNone),
        searched_(searched),
        reached_(mesh.vertices.size()),
        faces_(mesh.triangles.size() + 1),
        side_(mesh.triangles.size(), 0) {
    for (std::uint32_t h = 0; h < opposite_.size(); ++h) leaving_[origin(h)] = h;
  }

  /// Returns the number of cuts; makes at most `most`.
  Result<std::size_t> run(std::size_t most, const RunContext& context) {
    std::vector<std::uint8_t> visited(free_.size(), 0);
    for (std::uint32_t seed = 0; seed < free_.size(); ++seed)
      if (free_[seed] && !visited[seed]) leave_out_disc(seed, visited);
    for (std::uint32_t seed = 0; seed < searched_.size() && loops_.size() < most; ++seed) {
      if (!free_[seed] || searched_[seed]) continue;
      TURNSCAN_TRY(context.check());
      search_around(seed);
    }
    for (const Loop& loop : loops_) search_again_around(loop);
    for (const Loop& loop : loops_) cut(loop);
    return loops_.size();
  }

 private:
  std::uint32_t origin(std::uint32_t h) const { return mesh::origin(mesh_, h); }
  std::uint32_t target(std::uint32_t h) const { return origin(next_in_triangle(h)); }
  double length(std::uint32_t h) const {
    return double((mesh_.vertices[target(h)] - mesh_.vertices[origin(h)]).norm());
  }
  double length(const Loop& loop) const {
    return std::accumulate(loop.begin(), loop.end(), 0.0,
                           [&](double sum, std::uint32_t h) { return sum + length(h); });
  }
  /// The next half edge that leaves the same vertex, counter-clockwise.
  std::uint32_t turned(std::uint32_t h) const { return opposite_[previous_in_triangle(h)]; }

  /// No loop in a disc-shaped patch of free vertices needs a cut.
  void leave_out_disc(std::uint32_t seed, std::vector<std::uint8_t>& visited) {
    std::vector<std::uint32_t> patch(1, seed);
    visited[seed] = 1;
    std::ptrdiff_t twice_edges = 0, thrice_faces = 0;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      for_each_leaving(patch[i], [&](std::uint32_t h) {
        const std::uint32_t w = target(h);
        if (!free_[w]) return;
        ++twice_edges;
        if (free_[origin(previous_in_triangle(h))]) ++thrice_faces;
        if (visited[w]) return;
        visited[w] = 1;
        patch.push_back(w);
      });
    }
    if (!is_disc(patch.size(), twice_edges, thrice_faces)) return;
    for (const std::uint32_t v : patch) searched_[v] = 1;
  }

  /// Other loops may cross one that was cut, or separate the surface now.
  void search_again_around(const Loop& loop) {
    for (const std::uint32_t h : loop) free_[origin(h)] = cuttable_[origin(h)];
    grow_ball(origin(loop[0]), longest_ + length(loop));
    for (const std::uint32_t v : ball_) searched_[v] = 0;
    for (const std::uint32_t h : loop) free_[origin(h)] = 0;
  }

  void search_around(std::uint32_t seed) {
    const double apart = kSeedsApart * longest_;
    Loop best = shortest_loop(seed, longest_ + 2.0 * apart, apart);
    for (int i = 0; i < kShortenings && !best.empty(); ++i) {
      const Loop next = shortest_loop(origin(best[best.size() / 2]), length(best), 0.0);
      if (next.empty() || length(next) > 0.99 * length(best)) break;
      best = next;
    }
    if (best.empty() || length(best) > longest_) return;
    for (const std::uint32_t h : best) {
      free_[origin(h)] = 0;
      on_loop_[h] = on_loop_[opposite_[h]] = 1;
    }
    loops_.push_back(std::move(best));
  }

  /// Dijkstra over free vertices.
  void grow_ball(std::uint32_t seed, double radius) {
    using Item = std::pair<float, std::uint32_t>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
    for (const std::uint32_t v : ball_) reached_[v] = {};
    ball_.assign(1, seed);
    reached_[seed] = {0.0f, kNone};
    queue.emplace(0.0f, seed);
    while (!queue.empty()) {
      const float distance = queue.top().first;
      const std::uint32_t v = queue.top().second;
      queue.pop();
      if (distance > reached_[v].distance) continue;
      for_each_leaving(v, [&](std::uint32_t h) {
        const std::uint32_t w = target(h);
        const float there = distance + float(length(h));
        Reached& other = reached_[w];
        if (!free_[w] || double(there) > radius || there >= other.distance) return;
        if (!in_ball(w)) ball_.push_back(w);
        other = {there, h};
        queue.emplace(there, w);
      });
    }
  }

  bool in_ball(std::uint32_t v) const { return reached_[v].distance < kFar; }

  /// Calls body(h) for each half edge that leaves a vertex.
  template <class Body>
  void for_each_leaving(std::uint32_t v, const Body& body) const {
    std::uint32_t h = leaving_[v];
    do {
      body(h);
      h = turned(h);
    } while (h != leaving_[v]);
  }

  /// The shortest loop through a vertex, up to a length, that does not separate the surface. Marks
  /// the vertices within `cover` of the vertex.
  Loop shortest_loop(std::uint32_t seed, double most, double cover) {
    grow_ball(seed, 0.5 * most);
    for (const std::uint32_t v : ball_)
      if (double(reached_[v].distance) <= cover) searched_[v] = 1;
    for (const auto& [along, h] : loop_edges()) {
      if (double(along) > most) break;
      const Loop loop = close_loop(h);
      if (!separates(loop)) return loop;
    }
    return {};
  }

  /// The edges of the ball that are neither in its tree nor in the longest cotree, with the length
  /// of the path from the centre of the ball along them and back, shortest first. Everything
  /// outside the ball counts as one face.
  std::vector<std::pair<float, std::uint32_t>> loop_edges() {
    std::vector<std::pair<float, std::uint32_t>> edges, out;
    std::ptrdiff_t twice_edges = 0, thrice_faces = 0;
    for (const std::uint32_t v : ball_) {
      for_each_leaving(v, [&](std::uint32_t h) {
        const std::uint32_t w = target(h);
        if (!in_ball(w)) return;
        ++twice_edges;
        if (face(h) != outside()) ++thrice_faces;
        if (v < w && reached_[w].by != h && reached_[v].by != opposite_[h])
          edges.emplace_back(reached_[v].distance + reached_[w].distance + float(length(h)), h);
      });
    }
    if (is_disc(ball_.size(), twice_edges, thrice_faces)) return out;
    std::sort(edges.begin(), edges.end());
    for (auto edge = edges.rbegin(); edge != edges.rend(); ++edge) {
      const std::uint32_t a = face(edge->second), b = face(opposite_[edge->second]);
      if (faces_.root(a) == faces_.root(b)) out.push_back(*edge);
      faces_.join(a, b);
    }
    for (const auto& [along, h] : edges)
      for (const std::uint32_t f : {face(h), face(opposite_[h])}) faces_.reset(f);
    std::reverse(out.begin(), out.end());
    return out;
  }

  /// Tests by the Euler characteristic whether a connected patch is a disc, on which all loops are
  /// contractible.
  static bool is_disc(std::size_t vertices, std::ptrdiff_t twice_edges,
                      std::ptrdiff_t thrice_faces) {
    return std::ptrdiff_t(vertices) - twice_edges / 2 + thrice_faces / 3 == 1;
  }

  std::uint32_t outside() const { return std::uint32_t(mesh_.triangles.size()); }

  /// The triangle of a half edge, or outside().
  std::uint32_t face(std::uint32_t h) const {
    const auto& t = mesh_.triangles[h / 3];
    return in_ball(t[0]) && in_ball(t[1]) && in_ball(t[2]) ? h / 3 : outside();
  }

  /// The loop along the tree to the start of a half edge, along it, and back, without the common
  /// part of both paths.
  Loop close_loop(std::uint32_t h) const {
    const auto way = [&](std::uint32_t v) {
      Loop out;
      for (std::uint32_t by = reached_[v].by; by != kNone; by = reached_[origin(by)].by)
        out.push_back(by);
      std::reverse(out.begin(), out.end());
      return out;
    };
    const Loop there = way(origin(h)), back = way(target(h));
    std::size_t shared = 0;
    while (shared < there.size() && shared < back.size() && there[shared] == back[shared]) ++shared;
    Loop loop(there.begin() + std::ptrdiff_t(shared), there.end());
    loop.push_back(h);
    for (std::size_t i = back.size(); i-- > shared;) loop.push_back(opposite_[back[i]]);
    return loop;
  }

  /// Whether no path leads from one side of a loop to the other along the surface without crossing
  /// a loop. Both sides grow in turn, so that the cost is that of the smaller part.
  bool separates(const Loop& loop) {
    for (const std::uint32_t h : loop) ++on_loop_[h], ++on_loop_[opposite_[h]];
    std::vector<std::uint32_t> parts[2];
    const std::uint32_t first = loop[0] / 3, second = opposite_[loop[0]] / 3;
    parts[0].push_back(first);
    parts[1].push_back(second);
    side_[first] = 1;
    side_[second] = 2;
    bool meet = false;
    for (std::size_t i = 0; !meet && i < parts[0].size() && i < parts[1].size(); ++i) {
      for (std::uint8_t s = 0; s < 2 && !meet; ++s) {
        for (std::uint32_t h = 3 * parts[s][i]; h < 3 * parts[s][i] + 3; ++h) {
          if (on_loop_[h]) continue;
          const std::uint32_t t = opposite_[h] / 3;
          meet |= side_[t] == 2 - s;
          if (side_[t] != 0) continue;
          side_[t] = std::uint8_t(s + 1);
          parts[s].push_back(t);
        }
      }
    }
    for (const auto& part : parts)
      for (const std::uint32_t t : part) side_[t] = 0;
    for (const std::uint32_t h : loop) --on_loop_[h], --on_loop_[opposite_[h]];
    return !meet;
  }

  /// Cuts the surface along a loop; the side to its right gets copies of its vertices.
  void cut(const Loop& loop) {
    std::vector<std::uint32_t> left, right;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t to = loop[i], from = loop[(i + loop.size() - 1) % loop.size()];
      left.push_back(origin(to));
      right.push_back(mesh::duplicate_vertex(mesh_, left.back()));
      cuttable_.push_back(1);
      searched_.push_back(0);
      std::uint32_t h = opposite_[from];
      mesh_.triangles[h / 3][h % 3] = right.back();
      while (previous_in_triangle(h) != opposite_[to]) {
        h = turned(h);
        mesh_.triangles[h / 3][h % 3] = right.back();
      }
    }
    retreat(loop, left, right);
    close(left, true);
    close(right, false);
  }

  void retreat(const Loop& loop, const std::vector<std::uint32_t>& left,
               const std::vector<std::uint32_t>& right) {
    std::vector<Vec3f> moved;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t before = loop[(i + loop.size() - 1) % loop.size()];
      moved.push_back(drawn_back(loop[i], before, left[i]));
      moved.push_back(drawn_back(opposite_[before], opposite_[loop[i]], right[i]));
    }
    for (std::size_t i = 0; i < loop.size(); ++i) {
      mesh_.vertices[left[i]] = moved[2 * i];
      mesh_.vertices[right[i]] = moved[2 * i + 1];
    }
  }

  /// A vertex of a cut, moved towards its neighbours on one side. first: the half edge that leaves
  /// it with that side to its left; last: the one that arrives, likewise.
  Vec3f drawn_back(std::uint32_t first, std::uint32_t last, std::uint32_t v) const {
    Vec3f sum = Vec3f::Zero();
    float count = 0.0f;
    for (std::uint32_t h = first; previous_in_triangle(h) != last; h = turned(h)) {
      sum += mesh_.vertices[target(turned(h))];
      count += 1.0f;
    }
    const Vec3f& p = mesh_.vertices[v];
    return count > 0.0f ? Vec3f(p + kRetreat * (sum / count - p)) : p;
  }

  /// Adds a fan over a cut's vertices, which run along its surface's border, or against it.
  void close(const std::vector<std::uint32_t>& rim, bool along) {
    const std::uint32_t middle = mesh::add_mean_vertex(mesh_, rim);
    cuttable_.push_back(1);
    searched_.push_back(0);
    for (std::size_t i = 0; i < rim.size(); ++i) {
      const std::uint32_t a = rim[i], b = rim[(i + 1) % rim.size()];
      mesh_.triangles.push_back(along ? mesh::Triangle{b, a, middle}
                                      : mesh::Triangle{a, b, middle});
    }
  }

  TriangleMesh& mesh_;
  std::vector<std::uint8_t>& cuttable_;
  std::vector<std::uint8_t> free_;  ///< cuttable, and not on a loop yet
  double longest_;
  std::vector<std::uint32_t> opposite_;
  std::vector<std::uint8_t> on_loop_;    ///< per half edge
  std::vector<std::uint32_t> leaving_;   ///< per vertex: a half edge
  std::vector<std::uint8_t>& searched_;  ///< no loop is near
  std::vector<Reached> reached_;         ///< in the ball
  std::vector<std::uint32_t> ball_;
  DisjointSets faces_;              ///< triangles and the outside, as joined by the cotree
  std::vector<std::uint8_t> side_;  ///< per triangle, while a loop is tested
  std::vector<Loop> loops_;
};

/// Genus of a closed, 2-manifold, connected surface without unreferenced vertices.
std::size_t genus(const TriangleMesh& mesh) {
  const auto euler =
      std::ptrdiff_t(mesh.vertices.size()) - std::ptrdiff_t(mesh.triangles.size() / 2);
  return std::size_t(std::max<std::ptrdiff_t>(0, (2 - euler) / 2));
}

}  // namespace

Result<std::size_t> cut_handles(TriangleMesh& mesh, std::vector<std::uint8_t> cuttable,
                                double longest_m, const RunContext& context) {
  const MeshReport report = check_mesh(mesh);
  if (!report.closed || !report.manifold || !report.oriented)
    return fail(ErrorCode::kFormat, "cut handles: the mesh is not closed and 2-manifold");
  std::vector<std::uint8_t> searched(mesh.vertices.size(), 0);
  std::size_t cuts = 0;
  for (int pass = 0; pass < kMaxPasses && genus(mesh) > 0; ++pass) {
    TURNSCAN_ASSIGN(const std::size_t made,
                    HandleCutter(mesh, cuttable, searched, longest_m).run(genus(mesh), context));
    if (made == 0) break;
    cuts += made;
  }
  return cuts;
}

}  // namespace turnscan
