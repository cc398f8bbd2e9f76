#pragma once
// Meshes and meshing mishaps for tests.

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <turnscan/core/random.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan::test {

inline TriangleMesh tetrahedron() {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  return mesh;
}

/// Box of size 1 around (0.5, 0.5, 0.5).
inline TriangleMesh cube() {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back(float(i & 1), float(i >> 1 & 1), float(i >> 2 & 1));
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

/// Each triangle split in four, `levels` times; new vertices are the middles of edges.
inline TriangleMesh subdivided(TriangleMesh mesh, int levels) {
  for (; levels > 0; --levels) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [it, added] =
          middles.try_emplace(std::minmax(a, b), std::uint32_t(mesh.vertices.size()));
      if (added) {
        const Vec3f m = 0.5f * (mesh.vertices[a] + mesh.vertices[b]);
        mesh.vertices.push_back(m);
      }
      return it->second;
    };
    std::vector<std::array<std::uint32_t, 3>> split;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      split.insert(split.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(split);
  }
  return mesh;
}

/// Subdivided octahedron pushed onto the sphere: 8 * 4^levels triangles.
inline TriangleMesh sphere(double radius, int levels, const Vec3d& center = Vec3d::Zero()) {
  TriangleMesh mesh;
  mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  mesh = subdivided(std::move(mesh), levels);
  for (Vec3f& v : mesh.vertices) {
    v = (center + v.cast<double>().normalized() * radius).cast<float>();
  }
  return mesh;
}

/// Ring of circles around the z axis.
inline TriangleMesh torus(double ring, double tube, std::uint32_t around, std::uint32_t across) {
  TriangleMesh mesh;
  const double turn = 2.0 * std::numbers::pi;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      const double u = turn * i / around, v = turn * j / across;
      const double r = ring + tube * std::cos(v);
      mesh.vertices.push_back(
          Vec3d(r * std::cos(u), r * std::sin(u), tube * std::sin(v)).cast<float>());
      const auto at = [&](std::uint32_t k, std::uint32_t l) {
        return (k % around) * across + l % across;
      };
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

/// n x n squares of the unit square in z = height, normal +z.
inline TriangleMesh plane(std::uint32_t n, double size = 1.0, double height = 0.0) {
  TriangleMesh mesh;
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i) {
      mesh.vertices.emplace_back(float(size * i / n), float(size * j / n), float(height));
    }
  }
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  }
  return mesh;
}

inline void flip(TriangleMesh& mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
}

inline void append(TriangleMesh& mesh, const TriangleMesh& other) {
  const auto offset = std::uint32_t(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (auto t : other.triangles) {
    for (std::uint32_t& v : t) v += offset;
    mesh.triangles.push_back(t);
  }
}

inline void move(TriangleMesh& mesh, const Vec3f& by) {
  for (Vec3f& v : mesh.vertices) v += by;
}

/// Every triangle with three vertices of its own, as in an STL file.
inline TriangleMesh as_soup(const TriangleMesh& mesh) {
  TriangleMesh soup;
  for (const auto& t : mesh.triangles) {
    const auto first = std::uint32_t(soup.vertices.size());
    for (const std::uint32_t v : t) soup.vertices.push_back(mesh.vertices[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

inline double random_value(std::uint64_t seed, std::uint64_t i, std::uint64_t j = 0) {
  return 2.0 * uniform01(hash_key(seed, i, j)) - 1.0;
}

/// Triangles between random ones of few vertices: shared, repeated and folded in every way.
inline TriangleMesh random_soup(std::size_t vertices, std::size_t triangles, std::uint64_t seed) {
  TriangleMesh mesh;
  for (std::size_t i = 0; i < vertices; ++i) {
    mesh.vertices.push_back(
        Vec3d(random_value(seed, i, 0), random_value(seed, i, 1), random_value(seed, i, 2))
            .cast<float>());
  }
  for (std::size_t t = 0; t < triangles; ++t) {
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t c = 0; c < 3; ++c) {
      corners[c] = std::uint32_t(hash_key(seed, t, c, 1) % vertices);
    }
    mesh.triangles.push_back(corners);
  }
  return mesh;
}

}  // namespace turnscan::test
