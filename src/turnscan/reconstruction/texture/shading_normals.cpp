#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/reconstruction/texture/charts.hpp>
#include <turnscan/reconstruction/texture/light.hpp>
#include <turnscan/reconstruction/texture/shading_normals.hpp>

namespace turnscan::texture {

namespace {

constexpr int kSquare = NormalTilts::kSquare_px, kInRow = kBlock_px / kSquare;
constexpr double kReach_m = 0.5e-3;         // Gaussian over the squares that share a tilt
constexpr int kMaxReach = 6;                // squares
constexpr float kUsualAlbedoError = 0.15f;  // larger errors are not shading
/// Added to the mean squared derivative of light by a tilt: regularises unobserved tilts.
constexpr float kStays = 0.005f;
constexpr float kMaxTilt = 0.5f;
constexpr std::uint8_t kDarkestLevel = 12, kBrightestLevel = 250;
constexpr int kAlbedoRounds = 3;

/// Least squares for a tilt, from the mean of the samples.
struct TiltSums {
  Eigen::Matrix3f matrix = Eigen::Matrix3f::Zero();
  Vec3f right = Vec3f::Zero();
  float count = 0.0f;
  void add(const TiltSums& o, float weight) {
    matrix += weight * o.matrix;
    right += weight * o.right;
    count += weight * o.count;
  }
};

using BlockSums = std::array<TiltSums, NormalTilts::kSquares>;

class ShadingSolver {
 public:
  ShadingSolver(const TexelBlocks& blocks, const ChosenViews& chosen, const TexelSamples& samples,
                const std::vector<Vec3f>& gains, const FixedLight& light,
                const std::vector<Vec3f>& to_lamp)
      : blocks_(blocks),
        chosen_(chosen),
        samples_(samples),
        gains_(gains),
        light_(light),
        to_lamp_(to_lamp) {
    for (std::size_t i = 0; i < linear_.size(); ++i) linear_[i] = linear_of(float(i));
  }

  BlockSums sums_of(std::size_t b) const {
    BlockSums out;
    for (int i = 0; i < kBlockTexels; ++i) {
      if (blocks_.triangle(b, i) == kNoTriangle) continue;
      const int square = i / kBlock_px / kSquare * kInRow + i % kBlock_px / kSquare;
      add_texel(b, i, out[std::size_t(square)]);
    }
    return out;
  }

 private:
  void add_texel(std::size_t b, int i, TiltSums& sums) const {
    const Vec3f normal = blocks_.normal(b, i);
    std::array<float, kSlots> albedo{}, weight{};
    std::array<Vec3f, kSlots> change;  // relative derivative of the light by the tilt
    std::size_t n = 0;
    for (std::size_t k = 0; k < kSlots && chosen_.view[b][k] != kNoView; ++k) {
      const Sample& s = samples_.of(b, k)[i];
      if (s.valid != Sample::kWell || Lit(s.lit) == Lit::kUnsure) continue;
      if (std::max({s.r, s.g, s.b}) > kBrightestLevel || std::min({s.r, s.g, s.b}) < kDarkestLevel)
        continue;
      const std::uint16_t view = chosen_.view[b][k];
      const Vec3f& to_lamp = to_lamp_[view];
      const float facing = Lit(s.lit) == Lit::kYes ? normal.dot(to_lamp) : 0.0f;
      const float light = light_.on(facing, true);
      if (!(light > kMinLight)) continue;
      const Vec3f& gain = gains_[view];
      albedo[n] =
          (linear_[s.r] * gain.x() + linear_[s.g] * gain.y() + linear_[s.b] * gain.z()) / light;
      change[n] = facing > 0.0f ? Vec3f((light_.lamp / light) * to_lamp) : Vec3f(Vec3f::Zero());
      weight[n++] = 1.0f;
    }
    if (n < 2) return;
    float mean = 0.0f, total = 0.0f;
    for (int round = 0; round < kAlbedoRounds; ++round) {
      float sum = 0.0f;
      total = 0.0f;
      for (std::size_t k = 0; k < n; ++k) sum += weight[k] * albedo[k], total += weight[k];
      mean = sum / total;
      for (std::size_t k = 0; k < n; ++k) {
        const float r = (albedo[k] / mean - 1.0f) / kUsualAlbedoError;
        weight[k] = 1.0f / ((1.0f + r * r) * (1.0f + r * r));
      }
    }
    Vec3f usual = Vec3f::Zero();
    total = 0.0f;
    for (std::size_t k = 0; k < n; ++k) usual += weight[k] * change[k], total += weight[k];
    usual /= total;
    for (std::size_t k = 0; k < n; ++k) {
      Vec3f v = change[k] - usual;
      v -= v.dot(normal) * normal;
      sums.matrix += weight[k] * v * v.transpose();
      sums.right += weight[k] * (albedo[k] / mean - 1.0f) * v;
    }
    sums.count += total;
  }

  const TexelBlocks& blocks_;
  const ChosenViews& chosen_;
  const TexelSamples& samples_;
  const std::vector<Vec3f>& gains_;
  const FixedLight& light_;
  const std::vector<Vec3f>& to_lamp_;
  std::array<float, 256> linear_{};
};

struct Square {
  std::size_t block, index;
};

/// The square of a chart at a column and row of squares of the image, if there is one.
std::optional<Square> square_at(const TexelBlocks& blocks, std::uint32_t chart, int column,
                                int row) {
  const std::int32_t at = blocks.block_at(column * kSquare, row * kSquare);
  if (at < 0 || blocks.chart(std::size_t(at)) != chart) return std::nullopt;
  return Square{std::size_t(at), std::size_t(row % kInRow * kInRow + column % kInRow)};
}

Vec3f tilt_of(const TiltSums& sums) {
  if (!(sums.count > 0.0f)) return Vec3f::Zero();
  Eigen::Matrix3f matrix = sums.matrix / sums.count;
  matrix.diagonal().array() += kStays;
  const Vec3f tilt = estimation::solve_ldlt(matrix, Vec3f(sums.right / sums.count));
  const float size = tilt.norm();
  return size > kMaxTilt ? Vec3f(tilt * (kMaxTilt / size)) : tilt;
}

}  // namespace

Vec3f NormalTilts::at(std::size_t block, int texel) const {
  const int x = blocks_->left(block) + texel % kBlock_px,
            y = blocks_->top(block) + texel / kBlock_px;
  const float u = (float(x) + 0.5f) / float(kSquare) - 0.5f;
  const float v = (float(y) + 0.5f) / float(kSquare) - 0.5f;
  const int column = int(std::floor(u)), row = int(std::floor(v));
  Vec3f sum = Vec3f::Zero();
  float weights = 0.0f;
  for (int dy = 0; dy <= 1; ++dy) {
    for (int dx = 0; dx <= 1; ++dx) {
      const auto square = square_at(*blocks_, blocks_->chart(block), column + dx, row + dy);
      if (!square) continue;
      const float weight =
          (1.0f - std::abs(u - float(column + dx))) * (1.0f - std::abs(v - float(row + dy)));
      sum += weight * tilts_[square->block][square->index];
      weights += weight;
    }
  }
  return weights > 0.0f ? Vec3f(sum / weights) : sum;
}

NormalTilts shading_normals(const TexelBlocks& blocks, const ChosenViews& chosen,
                            const TexelSamples& samples, const std::vector<Vec3f>& gains,
                            const FixedLight& light, const std::vector<Vec3f>& to_lamp,
                            double texels_per_m) {
  const ShadingSolver solver(blocks, chosen, samples, gains, light, to_lamp);
  std::vector<BlockSums> sums(blocks.count());
  parallel_for(sums.size(), 64, [&](std::size_t b) { sums[b] = solver.sums_of(b); });
  const double reach = kReach_m * texels_per_m / kSquare;  // squares
  const int most = std::clamp(int(std::ceil(2.0 * reach)), 1, kMaxReach);
  std::vector<float> kernel;
  for (int d = -most; d <= most; ++d)
    kernel.push_back(float(std::exp(-0.5 * d * d / std::max(reach * reach, 0.05))));
  std::vector<NormalTilts::OfBlock> tilts(blocks.count());
  parallel_for(tilts.size(), 64, [&](std::size_t b) {
    for (int s = 0; s < NormalTilts::kSquares; ++s) {
      const int column = blocks.left(b) / kSquare + s % kInRow;
      const int row = blocks.top(b) / kSquare + s / kInRow;
      TiltSums near;
      for (int dy = -most; dy <= most; ++dy)
        for (int dx = -most; dx <= most; ++dx)
          if (const auto square = square_at(blocks, blocks.chart(b), column + dx, row + dy))
            near.add(sums[square->block][square->index],
                     kernel[std::size_t(dx + most)] * kernel[std::size_t(dy + most)]);
      tilts[b][std::size_t(s)] = tilt_of(near);
    }
  });
  return NormalTilts(blocks, std::move(tilts));
}

}  // namespace turnscan::texture
