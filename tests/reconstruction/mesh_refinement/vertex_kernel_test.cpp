#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <turnscan/core/random.hpp>
#include <turnscan/reconstruction/mesh_refinement/vertex_kernel.hpp>
#include <vector>

namespace turnscan::mesh_refinement {
namespace {

constexpr std::size_t kVertices = 5 * kVertexRow;

float uniform(std::uint64_t counter) { return float(mix64(counter) >> 40) * 0x1p-24f; }

/// A camera half a metre before the vertices; one pixel in ten holds nothing, one in seven an edge.
struct TestView {
  std::vector<std::uint32_t> pixels;
  VertexKernelView view{};

  TestView(int distorted, bool parallel) : pixels(97 * 61) {
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const auto raw = static_cast<std::uint32_t>(5000.0f + 20.0f * uniform(i));
      const std::uint32_t edge = mix64(i) % 7 == 0 ? 0x10000u : 0u;
      pixels[i] = mix64(i) % 10 == 0 ? 0u : raw | edge | (raw - 7u) >> 1 << 17;
    }
    view.pixels = pixels.data();
    view.width = 97, view.height = 61;
    for (const std::size_t i : {0u, 4u, 8u}) view.rotation[i] = 1.0f;
    view.translation[2] = 0.5f;
    view.fx = view.fy = parallel ? 900.0f : 450.0f;
    view.cx = 48.3f, view.cy = 30.2f;
    if (distorted > 0)
      view.lens.k1 = 0.1f, view.lens.k2 = -0.2f, view.lens.p1 = 0.001f, view.lens.p2 = -0.002f;
    if (distorted == 2)
      view.lens.k4 = 0.9f, view.lens.k5 = 0.1f, view.lens.k6 = -0.01f, view.lens.largest_r2 = 0.01f;
    view.unit = 1e-4f, view.bias = 0.001f;
    view.distorted = distorted, view.parallel = parallel ? 1 : 0;
  }
};

/// Weights and offsets, for vertices on a plane 10 cm wide (wider than the
/// image) that faces the camera within 25 deg or so.
std::array<std::vector<float>, 2> sums_of(const VertexKernel& kernel,
                                          const VertexKernelView& view) {
  std::array<std::vector<float>, 6> columns;
  for (std::size_t i = 0; i < kVertices; ++i) {
    for (std::size_t c = 0; c < 6; ++c) {
      const float x = uniform(10 * i + c) - 0.5f;
      columns[c].push_back(c < 2 ? 0.1f * x : c == 2 ? 0.004f * x : c < 5 ? 0.6f * x : -1.0f);
    }
    const float length =
        std::sqrt(columns[3][i] * columns[3][i] + columns[4][i] * columns[4][i] + 1);
    for (std::size_t c = 3; c < 6; ++c) columns[c][i] /= length;
  }
  const VertexColumns vertices{columns[0].data(), columns[1].data(), columns[2].data(),
                               columns[3].data(), columns[4].data(), columns[5].data()};
  std::array<std::vector<float>, 2> out;
  for (auto& sums : out) sums.assign(kVertices, 0.0f);
  VertexSums sums{out[0].data(), out[1].data()};
  const VertexKernelScale scale{1.0f / (0.003f * 0.003f), 0.001f, 0.0001f, 4.685f, 0.2f, 0.5f};
  kernel.add_view(view, vertices, 0, kVertices, scale, sums);
  return out;
}

TEST(VertexKernel, GivesTheSameBytesForEveryInstructionSet) {
  for (const int distorted : {0, 1, 2}) {
    for (const bool parallel : {false, true}) {
      const TestView test(distorted, parallel);
      const auto plain = sums_of(*VertexKernels::find(InstructionSet::kPortable), test.view);
      std::size_t measured = 0;
      for (const float weight : plain[0]) measured += weight > 0.0f ? 1 : 0;
      EXPECT_GT(measured, kVertices / 4);
      for (const InstructionSet set : {InstructionSet::kAvx2, InstructionSet::kAvx512}) {
        if (const VertexKernel* kernel = VertexKernels::find(set)) {
          EXPECT_EQ(sums_of(*kernel, test.view), plain);
        }
      }
    }
  }
}

}  // namespace
}  // namespace turnscan::mesh_refinement
