#include <algorithm>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/texture/charts.hpp>
#include <turnscan/reconstruction/texture/filling.hpp>

namespace turnscan::texture {

namespace {

constexpr int kGapRounds = 6;      // number of texels by which colours extend into the gaps
constexpr int kSmoothRounds = 60;  // of the vertices that no view saw
constexpr float kGrey = 190.0f;

/// Sum of colours, with their count in the last component.
using ColorSum = Eigen::Vector4f;

ColorSum sum_of(Rgb c) { return {float(c.r), float(c.g), float(c.b), 1.0f}; }

Rgb mean_of(const ColorSum& sum) {
  const auto byte = [&](int i) {
    return std::uint8_t(std::clamp(sum[i] / sum[3] + 0.5f, 0.0f, 255.0f));
  };
  return {byte(0), byte(1), byte(2)};
}

/// Colours of the vertices from known texels of the adjacent triangles, propagated to the other
/// vertices until all have one, then smoothed where they were propagated.
std::vector<ColorSum> vertex_colors(const TriangleMesh& mesh, const TexelBlocks& blocks,
                                    const Blended& blended) {
  std::vector<ColorSum> sums(mesh.vertices.size(), ColorSum::Zero());
  for (std::size_t b = 0; b < blocks.count(); ++b)
    for (int i = 0; i < kBlockTexels; ++i) {
      const std::size_t at = b * kBlockTexels + std::size_t(i);
      if (blended.known[at] == 0) continue;
      for (const std::uint32_t v : mesh.triangles[blocks.triangle(b, i)])
        sums[v] += sum_of(blended.colors[at]);
    }
  std::vector<std::uint8_t> spread(sums.size(), 0);
  for (ColorSum& s : sums)
    if (s[3] > 0.0f) s /= s[3];
  std::vector<ColorSum> next(sums.size());
  const auto ring = [&](bool into_unknown) {
    std::fill(next.begin(), next.end(), ColorSum::Zero());
    for (const auto& t : mesh.triangles)
      for (std::size_t c = 0; c < 3; ++c) {
        const ColorSum& own = sums[t[c]];
        if (!(own[3] > 0.0f)) continue;
        next[t[(c + 1) % 3]] += own;
        next[t[(c + 2) % 3]] += own;
      }
    bool any = false;
    for (std::size_t v = 0; v < sums.size(); ++v) {
      const bool takes = into_unknown ? !(sums[v][3] > 0.0f) : spread[v] != 0;
      if (!takes || !(next[v][3] > 0.0f)) continue;
      sums[v] = next[v] / next[v][3];
      spread[v] = 1;
      any = true;
    }
    return any;
  };
  while (ring(true)) {
  }
  for (int round = 0; round < kSmoothRounds; ++round)
    if (!ring(false)) break;
  for (ColorSum& s : sums)
    if (!(s[3] > 0.0f)) s = ColorSum(kGrey, kGrey, kGrey, 1.0f);
  return sums;
}

Rgb color_inside(const TriangleMesh& mesh, const TexelBlocks& blocks,
                 const std::vector<ColorSum>& colors, std::size_t block, int texel) {
  const auto& t = mesh.triangles[blocks.triangle(block, texel)];
  const Vec3f p = blocks.surface(block, texel).position;
  ColorSum sum = ColorSum::Zero();
  for (const std::uint32_t v : t)
    sum += colors[v] / ((mesh.vertices[v] - p).squaredNorm() + 1e-12f);
  return mean_of(sum);
}

/// Fills pixels adjacent to filled ones with their mean, one ring.
void grow_into_gaps(ColorImage& image, std::vector<std::uint8_t>& full) {
  const int n = image.width;
  std::vector<std::uint8_t> now = full;
  parallel_for(std::size_t(n), 64, [&](std::size_t row) {
    const int y = int(row);
    for (int x = 0; x < n; ++x) {
      const std::size_t i = row * std::size_t(n) + std::size_t(x);
      if (full[i] != 0) continue;
      ColorSum sum = ColorSum::Zero();
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          if (x + dx < 0 || y + dy < 0 || x + dx >= n || y + dy >= n) continue;
          const std::size_t j = std::size_t(y + dy) * std::size_t(n) + std::size_t(x + dx);
          if (full[j] != 0) sum += sum_of(image.pixels[j]);
        }
      if (!(sum[3] > 0.0f)) continue;
      image.pixels[i] = mean_of(sum);
      now[i] = 1;
    }
  });
  full.swap(now);
}

}  // namespace

double filled_share(const TexelBlocks& blocks, const Blended& blended) {
  std::size_t known = 0;
  for (const std::uint8_t k : blended.known) known += k;
  const std::size_t all = blocks.covered_texels();
  return all > 0 ? 1.0 - double(known) / double(all) : 0.0;
}

ColorImage filled_picture(const TriangleMesh& mesh, const TexelBlocks& blocks,
                          const Blended& blended) {
  const int n = blocks.size_px();
  ColorImage image(n, n, Rgb{});
  std::vector<std::uint8_t> full(image.pixels.size(), 0);
  const std::vector<ColorSum> colors = vertex_colors(mesh, blocks, blended);
  parallel_for(blocks.count(), 256, [&](std::size_t b) {
    for (int i = 0; i < kBlockTexels; ++i) {
      if (blocks.triangle(b, i) == kNoTriangle) continue;
      const std::size_t at = b * kBlockTexels + std::size_t(i);
      const int x = blocks.left(b) + i % kBlock_px, y = blocks.top(b) + i / kBlock_px;
      image.at(x, y) =
          blended.known[at] != 0 ? blended.colors[at] : color_inside(mesh, blocks, colors, b, i);
      full[std::size_t(y) * std::size_t(n) + std::size_t(x)] = 1;
    }
  });
  for (int round = 0; round < kGapRounds; ++round) grow_into_gaps(image, full);
  // Texels farther from any chart are only seen at coarser mipmap levels.
  ColorSum sum = ColorSum::Zero();
  for (std::size_t i = 0; i < full.size(); i += 97)
    if (full[i] != 0) sum += sum_of(image.pixels[i]);
  const Rgb rest = sum[3] > 0.0f ? mean_of(sum) : Rgb{190, 190, 190};
  for (std::size_t i = 0; i < full.size(); ++i)
    if (full[i] == 0) image.pixels[i] = rest;
  return image;
}

}  // namespace turnscan::texture
