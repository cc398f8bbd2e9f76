#include <algorithm>
#include <bit>
#include <cmath>
#include <turnscan/core/mesh_texture.hpp>
#include <unordered_map>

namespace turnscan {

namespace {

/// All attributes of a vertex, bitwise; -0 equals 0.
struct VertexKey {
  std::array<std::uint32_t, 7> words{};
  bool operator==(const VertexKey&) const = default;
};

struct VertexKeyHash {
  std::size_t operator()(const VertexKey& key) const {
    std::uint64_t h = 0x9e3779b97f4a7c15u;
    for (const std::uint32_t word : key.words) {
      h = (h ^ word) * 0xff51afd7ed558ccdu;
      h ^= h >> 32;
    }
    return std::size_t(h);
  }
};

std::uint32_t bits_of(float value) { return std::bit_cast<std::uint32_t>(value + 0.0f); }

VertexKey key_of(const TriangleMesh& mesh, std::uint32_t v) {
  VertexKey key;
  for (int i = 0; i < 3; ++i) key.words[std::size_t(i)] = bits_of(mesh.vertices[v][i]);
  if (!mesh.normals.empty())
    for (int i = 0; i < 3; ++i) key.words[std::size_t(3 + i)] = bits_of(mesh.normals[v][i]);
  if (!mesh.colors.empty()) {
    const Rgb c = mesh.colors[v];
    key.words[6] = std::uint32_t(c.r) << 16 | std::uint32_t(c.g) << 8 | std::uint32_t(c.b);
  }
  return key;
}

/// Copies vertices, given by their indices in another mesh.
void take_vertices(const TriangleMesh& from, const std::vector<std::uint32_t>& names,
                   TriangleMesh& to) {
  to.vertices.clear();
  to.normals.clear();
  to.colors.clear();
  for (const std::uint32_t v : names) {
    to.vertices.push_back(from.vertices[v]);
    if (!from.normals.empty()) to.normals.push_back(from.normals[v]);
    if (!from.colors.empty()) to.colors.push_back(from.colors[v]);
  }
}

int wrapped(int i, int n) {
  // Almost always, and a division takes longer than everything else here.
  if (i >= 0 && i < n) return i;
  i %= n;
  return i < 0 ? i + n : i;
}

}  // namespace

bool has_texture(const TriangleMesh& mesh) {
  return mesh.texture != nullptr && !mesh.texture->image.empty() && !mesh.triangles.empty() &&
         mesh.texture->corners.size() == mesh.triangles.size();
}

Vec3f texture_at(const ColorImage& image, const Eigen::Vector2f& uv) {
  const float u = uv.x() - std::floor(uv.x()), v = uv.y() - std::floor(uv.y());
  // The right and lower edges are distinct positions; they do not wrap to the left and upper ones.
  const float x = (uv.x() == 1.0f ? 1.0f : u) * float(image.width) - 0.5f;
  const float y = (uv.y() == 1.0f ? 1.0f : v) * float(image.height) - 0.5f;
  const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
  const float fx = x - float(x0), fy = y - float(y0);
  const auto pixel = [&](int column, int row) {
    const Rgb c = image.at(wrapped(column, image.width), wrapped(row, image.height));
    return Vec3f(c.r, c.g, c.b);
  };
  return (1.0f - fy) * ((1.0f - fx) * pixel(x0, y0) + fx * pixel(x0 + 1, y0)) +
         fy * ((1.0f - fx) * pixel(x0, y0 + 1) + fx * pixel(x0 + 1, y0 + 1));
}

Vec3f texture_at(const TriangleMesh& mesh, std::uint32_t triangle, float u, float v) {
  const auto& c = mesh.texture->corners[triangle];
  return texture_at(mesh.texture->image,
                    Eigen::Vector2f((1.0f - u - v) * c[0] + u * c[1] + v * c[2]));
}

SplitMesh split_at_seams(const TriangleMesh& mesh) {
  SplitMesh out;
  out.mesh.name = mesh.name;
  std::vector<std::uint32_t> names;
  // For each vertex a chain of its new copies.
  constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> first(mesh.vertices.size(), kNone), next;
  out.mesh.triangles.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.triangles[t][k];
      const Eigen::Vector2f& place = mesh.texture->corners[t][k];
      std::uint32_t at = first[v];
      while (at != kNone && out.uvs[at] != place) at = next[at];
      if (at == kNone) {
        at = std::uint32_t(names.size());
        names.push_back(v);
        out.uvs.push_back(place);
        next.push_back(first[v]);
        first[v] = at;
      }
      triangle[k] = at;
    }
    out.mesh.triangles.push_back(triangle);
  }
  take_vertices(mesh, names, out.mesh);
  return out;
}

void weld_seams(TriangleMesh& mesh) {
  std::unordered_map<VertexKey, std::uint32_t, VertexKeyHash> known;
  known.reserve(mesh.vertices.size());
  std::vector<std::uint32_t> names;
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& v : triangle) {
      const auto [at, is_new] = known.try_emplace(key_of(mesh, v), std::uint32_t(names.size()));
      if (is_new) names.push_back(v);
      v = at->second;
    }
  }
  TriangleMesh welded;
  take_vertices(mesh, names, welded);
  mesh.vertices = std::move(welded.vertices);
  mesh.normals = std::move(welded.normals);
  mesh.colors = std::move(welded.colors);
}

}  // namespace turnscan
