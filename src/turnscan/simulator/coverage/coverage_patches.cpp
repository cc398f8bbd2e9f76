#include <algorithm>
#include <cmath>
#include <limits>
#include <turnscan/simulator/coverage/coverage_patches.hpp>

namespace turnscan::coverage {

namespace {

constexpr std::size_t kMaxPatches = 4'000'000;
constexpr double kPlainAlbedo = 0.8;
constexpr double kSliver = 0.4;  // of a cell's face

/// Its first corner; the first among equally long ones.
int longest_edge(const std::array<Vec3f, 3>& c) {
  int longest = 0;
  float length = -1.0f;
  for (int k = 0; k < 3; ++k) {
    const float l = (c[std::size_t(k)] - c[std::size_t((k + 1) % 3)]).squaredNorm();
    if (l > length) longest = k, length = l;
  }
  return longest;
}

double edge_length(const std::array<Vec3f, 3>& c, int edge) {
  return double((c[std::size_t(edge)] - c[std::size_t((edge + 1) % 3)]).norm());
}

/// Edges far from the origin that are not much longer than the float spacing there are not halved:
/// rounding would move their middle as much as halving does, and the subdivision would not end.
double float_step(const std::array<Vec3f, 3>& c) {
  float farthest = 0.0f;
  for (const Vec3f& p : c) farthest = std::max(farthest, p.cwiseAbs().maxCoeff());
  return 16.0 * double(std::numeric_limits<float>::epsilon()) * double(farthest);
}

/// The two halves of a triangle.
std::array<std::array<Vec3f, 3>, 2> halves(const std::array<Vec3f, 3>& c, int edge) {
  const auto a = std::size_t(edge), b = std::size_t((edge + 1) % 3);
  const Vec3f middle = 0.5f * (c[a] + c[b]);
  std::array<std::array<Vec3f, 3>, 2> out{c, c};
  out[0][b] = middle;
  out[1][a] = middle;
  return out;
}

Vec3d doubled_area(const std::array<Vec3f, 3>& c) {
  const Vec3d a = c[0].cast<double>();
  return (c[1].cast<double>() - a).cross(c[2].cast<double>() - a);
}

std::array<Vec3f, 3> corners_of(const TriangleMesh& mesh, std::size_t face) {
  const auto& t = mesh.triangles[face];
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

/// Mean of the corners' luminance (weights of Rec. 709), as a step.
std::uint8_t albedo_of(const TriangleMesh& mesh, std::size_t face) {
  double albedo = kPlainAlbedo;
  if (mesh.colors.size() == mesh.vertices.size()) {
    albedo = 0.0;
    for (const std::uint32_t v : mesh.triangles[face]) {
      const Rgb& c = mesh.colors[v];
      albedo += (0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b) / (3.0 * 255.0);
    }
  }
  return static_cast<std::uint8_t>(std::lround(albedo * (CoveragePatches::kAlbedoSteps - 1)));
}

using CellKey = CoveragePatches::CellKey;

Vec3f middle_of(const CoveragePatch& patch) {
  return (patch.corners[0] + patch.corners[1] + patch.corners[2]) / 3.0f;
}

CellKey key_of(const CoveragePatch& patch, const Vec3f& normal, double cell_m) {
  CellKey key{};
  const Vec3f center = middle_of(patch);
  for (int k = 0; k < 3; ++k)
    key[std::size_t(k)] = static_cast<std::int64_t>(std::floor(double(center[k]) / cell_m));
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  key[3] = 2 * axis + (normal[axis] < 0.0f ? 1 : 0);
  return key;
}

/// The largest of the cells that are adjacent to the one with this key and face the same direction;
/// `self` if none is larger than least.
std::uint32_t largest_neighbour(std::span<const CellKey> keys, std::span<const double> areas,
                                std::uint32_t self, double least) {
  std::uint32_t best = self;
  for (int n = 0; n < 27; ++n) {
    CellKey key = keys[self];
    key[0] += n % 3 - 1;
    key[1] += n / 3 % 3 - 1;
    key[2] += n / 9 - 1;
    const auto found = std::lower_bound(keys.begin(), keys.end(), key);
    if (found == keys.end() || *found != key) continue;
    const auto c = static_cast<std::uint32_t>(found - keys.begin());
    if (areas[c] >= least && areas[c] > areas[best]) best = c;
  }
  return best;
}

/// The replacement of each cell: itself unless it is smaller than least.
std::vector<std::uint32_t> absorb_slivers(std::span<const CellKey> keys,
                                          std::span<const double> areas, double least) {
  std::vector<std::uint32_t> kept(keys.size());
  for (std::uint32_t c = 0; c < keys.size(); ++c)
    kept[c] = areas[c] < least ? largest_neighbour(keys, areas, c, least) : c;
  return kept;
}

}  // namespace

CoveragePatches::CoveragePatches(std::span<const TriangleMesh> objects, double size)
    : cell_m(size), objects_(objects) {
  while (count(objects, cell_m) > kMaxPatches) {
    const std::size_t faces = count(objects, 1e9);
    if (faces >= kMaxPatches) break;  // no further subdivision
    cell_m *= 1.5;
  }
  for (std::uint32_t o = 0; o < objects.size(); ++o) {
    first_.push_back(roots_.size());
    cut(objects[o], o);
  }
  first_.push_back(roots_.size());
  gather();
}

/// Upper bound of the number of patches without subdividing: halving leaves no part smaller than a
/// quarter of a cell's half square, and no sliver shorter than half a cell.
std::size_t CoveragePatches::count(std::span<const TriangleMesh> objects, double size) const {
  double sum = 0.0;
  for (const TriangleMesh& mesh : objects) {
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
      const auto c = corners_of(mesh, f);
      const double longest = edge_length(c, longest_edge(c));
      const double area = 0.5 * doubled_area(c).norm();
      sum += longest <= size ? 1.0 : 2.0 * longest / size + 8.0 * area / (size * size);
      if (sum > 1e9) return std::size_t(1e9);
    }
  }
  return static_cast<std::size_t>(sum);
}

void CoveragePatches::cut(const TriangleMesh& mesh, std::uint32_t object) {
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const auto corners = corners_of(mesh, f);
    const Vec3d n = doubled_area(corners);
    normals_.push_back(n.norm() > 0.0 ? Vec3f(n.normalized().cast<float>()) : Vec3f::Zero());
    albedo_.push_back(albedo_of(mesh, f));
    roots_.push_back(cut(corners, object, static_cast<std::uint32_t>(f)));
  }
}

std::int32_t CoveragePatches::cut(const std::array<Vec3f, 3>& corners, std::uint32_t object,
                                  std::uint32_t face) {
  const int edge = longest_edge(corners);
  const double smallest = std::max(cell_m, float_step(corners));
  if (edge_length(corners, edge) <= smallest || patches.size() >= kMaxPatches) {
    patches.push_back({corners, object, face, 0, 0});
    return static_cast<std::int32_t>(patches.size() - 1);
  }
  const auto node = nodes_.size();
  nodes_.push_back({edge, {}});
  const auto parts = halves(corners, edge);
  for (std::size_t k = 0; k < 2; ++k) {
    const std::int32_t child = cut(parts[k], object, face);
    nodes_[node].child[k] = child;
  }
  return ~static_cast<std::int32_t>(node);
}

/// Cells in the order of their cubes, so that neighbours are stored together. Slivers at a cube's
/// border are assigned to the largest adjacent cell, so that cells have enough samples for a
/// density.
void CoveragePatches::gather() {
  std::vector<CellKey> keys;
  std::vector<double> areas;
  std::vector<std::uint32_t> place = place_by_key(keys, areas);
  const std::vector<std::uint32_t> kept = absorb_slivers(keys, areas, kSliver * cell_m * cell_m);
  std::uint32_t count = 0;
  std::vector<std::uint32_t> number(areas.size(), 0);
  for (std::uint32_t c = 0; c < areas.size(); ++c)
    if (kept[c] == c) number[c] = count++;
  cells.assign(count, {});
  largest.assign(count, 0);
  std::vector<double> largest_area(count, -1.0);
  for (std::uint32_t p = 0; p < patches.size(); ++p) {
    CoveragePatch& patch = patches[p];
    patch.cell = number[kept[place[p]]];
    const double area = 0.5 * doubled_area(patch.corners).norm();
    CoverageCell& cell = cells[patch.cell];
    cell.area_m2 += area;
    cell.center += area * middle_of(patch).cast<double>();
    if (area > largest_area[patch.cell]) largest[patch.cell] = p, largest_area[patch.cell] = area;
  }
  for (CoverageCell& cell : cells)
    if (cell.area_m2 > 0.0) cell.center /= cell.area_m2;
}

/// The index of each patch's key in the sorted keys, and the area of each.
std::vector<std::uint32_t> CoveragePatches::place_by_key(std::vector<CellKey>& keys,
                                                         std::vector<double>& areas) const {
  std::vector<std::pair<CellKey, std::uint32_t>> sorted(patches.size());
  for (std::uint32_t p = 0; p < patches.size(); ++p)
    sorted[p] = {key_of(patches[p], normal(patches[p].object, patches[p].face), cell_m), p};
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::uint32_t> place(patches.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (i == 0 || sorted[i].first != sorted[i - 1].first) {
      keys.push_back(sorted[i].first);
      areas.push_back(0.0);
    }
    place[sorted[i].second] = static_cast<std::uint32_t>(keys.size() - 1);
    areas.back() += 0.5 * doubled_area(patches[sorted[i].second].corners).norm();
  }
  return place;
}

std::uint32_t CoveragePatches::patch_at(std::uint32_t object, std::uint32_t triangle,
                                        const Vec3f& p) const {
  std::int32_t at = roots_[first_[object] + triangle];
  if (at >= 0) return static_cast<std::uint32_t>(at);
  const auto corners = corners_of(objects_[object], triangle);
  const Vec3d a = corners[0].cast<double>(), ab = corners[1].cast<double>() - a,
              ac = corners[2].cast<double>() - a, ap = p.cast<double>() - a;
  const Vec3d n = ab.cross(ac);
  const double scale = 1.0 / n.squaredNorm();
  std::array<double, 3> w{};
  w[1] = scale * ap.cross(ac).dot(n);
  w[2] = scale * ab.cross(ap).dot(n);
  w[0] = 1.0 - w[1] - w[2];
  while (at < 0) {
    const Node& node = nodes_[static_cast<std::size_t>(~at)];
    double& first = w[std::size_t(node.edge)];
    double& second = w[std::size_t((node.edge + 1) % 3)];
    const bool in_first = first >= second;
    // The middle of the edge replaces the corner that is cut off.
    if (in_first)
      first -= second, second *= 2.0;
    else
      second -= first, first *= 2.0;
    at = node.child[in_first ? 0 : 1];
  }
  return static_cast<std::uint32_t>(at);
}

}  // namespace turnscan::coverage
