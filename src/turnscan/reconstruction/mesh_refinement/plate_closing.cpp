#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/hull/resting_poses.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_untangle.hpp>
#include <turnscan/reconstruction/mesh_refinement/plate_closing.hpp>

namespace turnscan::mesh_refinement {

namespace {

constexpr int kMaxContacts = 4;        ///< solutions, each with the contacts of the previous ones
constexpr int kMaxRests = 3;           ///< vertices placed on the platter
constexpr float kTouchCells = 1.0f;    ///< lower heights above the platter count as contact
constexpr double kBalanceCells = 3.0;  ///< from the contact below the centre of mass
constexpr float kNearCells = 1.5f;     ///< the rim is within observed space
using Marks = std::vector<std::uint8_t>;

class PlateCloser {
 public:
  PlateCloser(TriangleMesh& mesh, const std::vector<float>& support, const PlateClosing& closing,
              const RunContext& context)
      : mesh_(mesh), closing_(closing), context_(context), neighbours_(mesh) {
    loose_ = unseen_vertices(support);
    for (std::size_t v = 0; v < loose_.size(); ++v)
      if (loose_[v] && closing_.stands(mesh.vertices[v])) loose_[v] = 0;
  }

  Result<> run() {
    if (!any_marked(loose_)) return {};
    const std::vector<Vec3f> start = mesh_.vertices;
    TURNSCAN_TRY(bend(start));
    for (int n = 0; n < kMaxRests && rest_on_platter(); ++n) TURNSCAN_TRY(bend(start));
    for (const std::uint32_t v : rests_) loose_[v] = 1;
    TURNSCAN_TRY(untangle(mesh_, start, loose_, context_));
    mesh_.normals.clear();
    return {};
  }

 private:
  /// Solves for the plate until no more vertices touch observed space.
  Result<> bend(const std::vector<Vec3f>& start) {
    Marks free = loose_;
    Marks contact(loose_.size(), 0);  // fixed at the border of observed space
    for (int round = 0; round < kMaxContacts; ++round) {
      TURNSCAN_ASSIGN(const TriangleMesh bent, relax(mesh_, free, {}, context_));
      Marks touches(loose_.size(), 0);
      parallel_for(loose_.size(), 1024, [&](std::size_t v) {
        if (!free[v]) return;
        const float share = free_share(start[v], bent.vertices[v]);
        mesh_.vertices[v] = start[v] + share * (bent.vertices[v] - start[v]);
        touches[v] = share < 1.0f ? 1 : 0;
      });
      const Marks again = loose_around(touches);
      if (!any_marked(again)) break;
      for (std::size_t v = 0; v < free.size(); ++v) {
        contact[v] |= touches[v];
        free[v] = again[v] && !contact[v] ? 1 : 0;
      }
    }
    return {};
  }

  /// Places a loose vertex on the platter if the object would tip over without. Returns whether
  /// there is one that can be placed.
  bool rest_on_platter() {
    if (!closing_.rests_below_m) return false;
    const float touching = kTouchCells * float(closing_.cell_m);
    std::vector<Vec3f> contacts;
    for (const Vec3f& p : mesh_.vertices)
      if (p.y() < touching) contacts.push_back(p);
    const Vec3d center = center_of_mass(mesh_);
    const auto tipping = tipping_direction(center, contacts, kBalanceCells * closing_.cell_m);
    if (!tipping) return false;
    // Among those as low as the lowest, the one below the centre of mass.
    const auto rank = [&](std::uint32_t v) {
      const Vec3d p = mesh_.vertices[v].cast<double>();
      return std::pair(std::floor(p.y() / closing_.cell_m),
                       std::hypot(p.x() - center.x(), p.z() - center.z()));
    };
    std::optional<std::uint32_t> lowest;
    for (std::uint32_t v = 0; v < loose_.size(); ++v) {
      const Vec3f& p = mesh_.vertices[v];
      if (!loose_[v] || p.y() >= float(*closing_.rests_below_m)) continue;
      if (!contacts.empty() && tipping->dot(p.cast<double>() - center) <= 0.0) continue;
      if ((!lowest || rank(v) < rank(*lowest)) && free_share(p, {p.x(), 0.0f, p.z()}) == 1.0f)
        lowest = v;
    }
    if (!lowest) return false;
    mesh_.vertices[*lowest].y() = 0.0f;
    loose_[*lowest] = 0;
    rests_.push_back(*lowest);
    return true;
  }

  /// Moves a vertex and its connected component from the marked ones to a list.
  void take_group(std::uint32_t seed, Marks& marked, std::vector<std::uint32_t>& group) const {
    const auto take = [&](std::uint32_t v) {
      if (!marked[v]) return;
      marked[v] = 0;
      group.push_back(v);
    };
    std::size_t i = group.size();
    for (take(seed); i < group.size(); ++i) neighbours_.each(group[i], take);
  }

  /// All loose vertices connected with those.
  Marks loose_around(const Marks& seeds) const {
    Marks left = loose_, out(loose_.size(), 0);
    std::vector<std::uint32_t> taken;
    for (std::uint32_t v = 0; v < seeds.size(); ++v)
      if (seeds[v]) take_group(v, left, taken);
    for (const std::uint32_t v : taken) out[v] = 1;
    return out;
  }

  /// Share of the path between two points that is unobserved or close to its start.
  float free_share(const Vec3f& from, const Vec3f& to) const {
    const float length = (to - from).norm(), step = 0.5f * float(closing_.cell_m);
    const int steps = int(std::ceil(length / step));
    const float near = kNearCells * float(closing_.cell_m);
    for (int i = 1; i <= steps; ++i) {
      const float share = float(i) / float(steps);
      const Vec3f p = from + share * (to - from);
      if (!closing_.stands(p) && (share * length < near || closing_.unseen(p))) continue;
      return float(i - 1) / float(steps);
    }
    return 1.0f;
  }

  TriangleMesh& mesh_;
  const PlateClosing& closing_;
  const RunContext& context_;
  MeshNeighbours neighbours_;
  Marks loose_;                       ///< may move
  std::vector<std::uint32_t> rests_;  ///< placed on the platter
};

}  // namespace

Result<> close_as_plate(TriangleMesh& mesh, const std::vector<float>& support,
                        const PlateClosing& closing, const RunContext& context) {
  return PlateCloser(mesh, support, closing, context).run();
}

}  // namespace turnscan::mesh_refinement
