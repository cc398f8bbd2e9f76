#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <turnscan/geometry/mesh/pack_mesh.hpp>
#include <vector>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

using Corner = std::array<std::uint16_t, 4>;
using Triangle = std::array<Corner, 3>;

std::vector<std::uint8_t> records_of(const TriangleMesh& mesh) {
  std::vector<std::uint8_t> records;
  for (const Vec3f& v : mesh.vertices) {
    for (int axis = 0; axis < 4; ++axis) {
      const double value = axis < 3 ? double(v[axis]) * 30000.0 + 32000.0 : 7.0;
      const auto q = static_cast<std::uint16_t>(value);
      records.push_back(std::uint8_t(q & 0xff));
      records.push_back(std::uint8_t(q >> 8));
    }
  }
  return records;
}

/// Triangles by their corners' records, each turned so that the least corner is first.
std::vector<Triangle> sorted_triangles(const std::vector<std::uint8_t>& records,
                                       const std::vector<std::uint32_t>& indices) {
  std::vector<Triangle> triangles(indices.size() / 3);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c)
      std::memcpy(triangles[t][c].data(), &records[8 * indices[3 * t + c]], 8);
    std::rotate(triangles[t].begin(), std::min_element(triangles[t].begin(), triangles[t].end()),
                triangles[t].end());
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

TEST(PackMesh, ComesBackAsItWas) {
  TriangleMesh mesh = test::sphere(1.0, 5);
  mesh.vertices.emplace_back(0.0f, 0.0f, 0.0f);  // no triangle names it
  const std::vector<std::uint8_t> records = records_of(mesh);
  const PackedMesh packed = pack_mesh(mesh.triangles, records, 8);
  EXPECT_EQ(packed.vertices, mesh.vertices.size() - 1);
  ASSERT_EQ(packed.triangles, mesh.triangles.size());
  std::vector<std::uint8_t> vertices(8 * packed.vertices);
  std::vector<std::uint32_t> indices(3 * packed.triangles), given;
  const auto bytes = [](const std::string& s) {
    return reinterpret_cast<const unsigned char*>(s.data());
  };
  ASSERT_EQ(meshopt_decodeVertexBuffer(vertices.data(), packed.vertices, 8,
                                       bytes(packed.vertex_stream), packed.vertex_stream.size()),
            0);
  ASSERT_EQ(meshopt_decodeIndexBuffer(indices.data(), indices.size(), 4, bytes(packed.index_stream),
                                      packed.index_stream.size()),
            0);
  for (const auto& t : mesh.triangles) given.insert(given.end(), t.begin(), t.end());
  EXPECT_EQ(sorted_triangles(vertices, indices), sorted_triangles(records, given));
  EXPECT_LT(packed.vertex_stream.size() + packed.index_stream.size(), 8 * mesh.triangles.size());
}

TEST(PackMesh, OfNothingIsNothing) {
  const PackedMesh packed = pack_mesh({}, {}, 8);
  EXPECT_EQ(packed.triangles + packed.vertices, 0u);
  EXPECT_TRUE(packed.vertex_stream.empty());
}

TEST(PackMesh, RefusesAStrideOrAnIndexThatCannotBe) {
  const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}};
  const std::vector<std::uint8_t> records(24);
  EXPECT_THROW(pack_mesh(triangles, records, 6), std::invalid_argument);
  EXPECT_THROW(pack_mesh(triangles, records, 16), std::invalid_argument);
  EXPECT_THROW(pack_mesh(triangles, std::vector<std::uint8_t>(16), 8), std::invalid_argument);
  EXPECT_NO_THROW(pack_mesh(triangles, records, 8));
}

}  // namespace
}  // namespace turnscan
