#include <algorithm>
#include <turnscan/core/disjoint_sets.hpp>
#include <turnscan/reconstruction/points/components.hpp>
#include <turnscan/reconstruction/surface/detached_components.hpp>

namespace turnscan::points {

namespace {

/// Joins voxels in one cell of `side` voxels or in adjacent cells. Half of the neighbours of a cell
/// suffice, since the other half meets it from the other side.
void join_neighbours(const voxels::VoxelGrid& grid, int side, DisjointSets& sets) {
  std::vector<Vec3f> cells;  // as points, so that the grid sorts them
  cells.reserve(grid.voxels().size());
  for (const voxels::VoxelGrid::Voxel& voxel : grid.voxels()) {
    const Vec3d cell = (voxel.index.cast<double>() / side).array().floor() + 0.5;
    cells.push_back(cell.cast<float>());
  }
  const auto coarse = voxels::VoxelGrid::build(cells, 1.0, RunContext());
  if (!coarse) return;  // there are no voxels
  for (const voxels::VoxelGrid::Voxel& cell : coarse->voxels()) {
    const std::uint32_t first = coarse->order()[cell.begin];
    for (std::uint32_t k = cell.begin + 1; k < cell.end; ++k) sets.join(first, coarse->order()[k]);
    const voxels::VoxelIndex one = voxels::VoxelIndex::Ones();
    voxels::VoxelIndex high = cell.index + one;
    high.z() = cell.index.z();
    coarse->for_each_in_box(cell.index - one, high, [&](std::uint32_t other) {
      sets.join(first, coarse->order()[coarse->voxels()[other].begin]);
    });
  }
}

struct Piece {
  std::uint64_t points = 0;
  std::size_t voxels = 0;
  std::uint32_t root = 0;
};

/// Most points first.
std::vector<Piece> find_pieces(const voxels::VoxelGrid& grid, DisjointSets& sets) {
  std::vector<Piece> pieces(grid.voxels().size());
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    Piece& piece = pieces[sets.root(i)];
    piece.root = sets.root(i);
    piece.points += grid.voxels()[i].count();
    ++piece.voxels;
  }
  std::erase_if(pieces, [](const Piece& p) { return p.voxels == 0; });
  std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) {
    return a.points != b.points ? a.points > b.points : a.root < b.root;
  });
  return pieces;
}

bool is_crumb(const Piece& piece, const std::vector<Piece>& pieces,
              const ComponentOptions& options) {
  return double(piece.points) < options.min_share * double(pieces.front().points);
}

/// Joins floating pieces, except crumbs, to what holds them. Returns their number.
std::size_t join_floating(const voxels::VoxelGrid& grid, const ComponentOptions& options,
                          double floor_m, DisjointSets& sets) {
  constexpr double kFarthestOfSize = 0.5;  // beyond this, no surface would bridge it
  std::vector<tsdf::PlacedComponent> places;
  std::vector<std::uint32_t> roots;
  std::vector<std::int32_t> of_root(grid.voxels().size(), -1);
  const std::vector<Piece> pieces = find_pieces(grid, sets);
  for (const Piece& piece : pieces) {
    if (is_crumb(piece, pieces, options)) continue;
    of_root[piece.root] = static_cast<std::int32_t>(places.size());
    places.emplace_back();
    roots.push_back(piece.root);
  }
  for (std::uint32_t i = 0; i < of_root.size(); ++i) {
    const std::int32_t p = of_root[sets.root(i)];
    if (p < 0) continue;
    const Vec3d center = grid.center(grid.voxels()[i]);
    tsdf::PlacedComponent& place = places[std::size_t(p)];
    place.points.push_back(center.cast<float>());
    place.stands = place.stands || center.y() < floor_m;
  }
  const std::vector<std::size_t> holder = tsdf::attach_detached(places, kFarthestOfSize);
  std::size_t joined = 0;
  for (std::size_t p = 0; p < holder.size(); ++p) {
    if (holder[p] == p) continue;
    sets.join(roots[p], roots[holder[p]]);
    ++joined;
  }
  return joined;
}

}  // namespace

Result<Components> find_components(const voxels::VoxelGrid& grid, const ComponentOptions& options,
                                   int reach, std::optional<double> floor_m) {
  TURNSCAN_ASSIGN(const int keep, objects_to_keep(options));
  const std::size_t n = grid.voxels().size();
  DisjointSets sets(n);
  join_neighbours(grid, std::max(1, reach / 2), sets);
  Components out;
  if (floor_m) out.joined = join_floating(grid, options, *floor_m, sets);
  const std::vector<Piece> pieces = find_pieces(grid, sets);
  std::vector<std::int32_t> label_of_root(n, -1);
  for (const Piece& piece : pieces) {
    if (is_crumb(piece, pieces, options)) {
      ++out.crumbs;
    } else if (keep > 0 && out.voxel_count.size() >= std::size_t(keep)) {
      ++out.not_kept;
    } else {
      label_of_root[piece.root] = static_cast<std::int32_t>(out.voxel_count.size());
      out.voxel_count.push_back(piece.voxels);
    }
  }
  out.label.reserve(n);
  for (std::uint32_t i = 0; i < n; ++i) out.label.push_back(label_of_root[sets.root(i)]);
  return out;
}

}  // namespace turnscan::points
