#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/texture/charts.hpp>
#include <turnscan/reconstruction/texture/exposure.hpp>
#include <turnscan/reconstruction/texture/light.hpp>

namespace turnscan::texture {

namespace {

constexpr float kDarkest = 0.004f, kBrightest = 0.96f;  // linear light that tells of exposure
constexpr int kGainRounds = 4;
constexpr double kGainScale = 0.08;  // log ratios beyond are taken for something else than exposure
constexpr double kEnoughBlocks = 20.0;    // that compare two views
constexpr double kUsualGain = 0.15;       // log of how far gains are from 1
constexpr double kLeastPairError = 0.01;  // log
constexpr int kStayRounds = 3;
constexpr std::size_t kGainChunks = 32;
constexpr std::size_t kLightBlocks = 4000;  // that the lamp is looked for in

std::array<float, 256> linear_table() {
  std::array<float, 256> out{};
  for (std::size_t i = 0; i < 256; ++i) out[i] = linear_of(float(i));
  return out;
}

/// Of one channel, for each two views: weights and weighted sums of what the gain of the first has
/// more than that of the second, as logarithms.
struct PairSums {
  Eigen::MatrixXd weight, sum;
};

PairSums add_pairs(const ChosenViews& chosen, const BlockMeans& means, int channel,
                   const Eigen::MatrixXd& usual, double scale, std::size_t begin, std::size_t end) {
  PairSums sums{Eigen::MatrixXd::Zero(usual.rows(), usual.cols()),
                Eigen::MatrixXd::Zero(usual.rows(), usual.cols())};
  for (std::size_t b = begin; b < end; ++b) {
    for (std::size_t k = 0; k < kSlots; ++k) {
      if (!tells_of_exposure(means[b][k])) continue;
      const auto i = Eigen::Index(chosen.view[b][k]);
      const double own = std::log(double(means[b][k][channel]));
      for (std::size_t l = k + 1; l < kSlots; ++l) {
        if (!tells_of_exposure(means[b][l])) continue;
        const auto j = Eigen::Index(chosen.view[b][l]);
        const double difference = std::log(double(means[b][l][channel])) - own;
        const double r = (difference - usual(i, j)) / scale;
        const double w = 1.0 / ((1.0 + r * r) * (1.0 + r * r));
        sums.weight(i, j) += w, sums.weight(j, i) += w;
        sums.sum(i, j) += w * difference, sums.sum(j, i) -= w * difference;
      }
    }
  }
  return sums;
}

/// Logarithms of the gains that fit the pairs' ratios best. How much these contradict each other
/// says how much they are worth beside that exposures are usually alike.
Eigen::VectorXd balanced(const Eigen::MatrixXd& weight, const Eigen::MatrixXd& ratio) {
  const Eigen::Index n = weight.rows();
  Eigen::MatrixXd matrix = -weight;
  matrix.diagonal() += weight.rowwise().sum();
  const Eigen::VectorXd right = weight.cwiseProduct(ratio).rowwise().sum();
  Eigen::VectorXd gains = Eigen::VectorXd::Zero(n);
  double error = kLeastPairError;
  for (int round = 0; round < kStayRounds; ++round) {
    Eigen::MatrixXd stayed = matrix;
    stayed.diagonal().array() += error * error / (kUsualGain * kUsualGain);
    gains = stayed.ldlt().solve(right);
    const Eigen::MatrixXd fitted = gains.replicate(1, n) - gains.transpose().replicate(n, 1);
    const double squared = weight.cwiseProduct((ratio - fitted).cwiseAbs2()).sum();
    error = std::max(kLeastPairError, std::sqrt(squared / std::max(weight.sum(), 1e-9)));
  }
  return gains;
}

/// Each two views' ratio is found by itself, then all are balanced. Places that fit badly count
/// less among those of the same two views only: where a lamp makes each view a little darker than
/// the next, all around the object, the two that close the circle fit worst, and are right.
Eigen::VectorXd solve_channel(const ChosenViews& chosen, const BlockMeans& means, int channel,
                              std::size_t views) {
  const auto n = Eigen::Index(views);
  const std::size_t chunk = (means.size() + kGainChunks - 1) / kGainChunks;
  if (chunk == 0) return Eigen::VectorXd::Zero(n);
  PairSums all{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n)};
  Eigen::MatrixXd usual = Eigen::MatrixXd::Zero(n, n);
  for (int round = 0; round < kGainRounds; ++round) {
    // The first round has no idea yet of what an outlier is.
    const double scale = round == 0 ? 10.0 * kGainScale : kGainScale;
    const auto parts =
        parallel_chunks<PairSums>(means.size(), chunk, [&](std::size_t begin, std::size_t end) {
          return add_pairs(chosen, means, channel, usual, scale, begin, end);
        });
    all = parts[0];
    for (std::size_t i = 1; i < parts.size(); ++i) {
      all.weight += parts[i].weight;
      all.sum += parts[i].sum;
    }
    usual = (all.sum.array() / all.weight.array().max(1e-9)).matrix();
  }
  return balanced(all.weight.unaryExpr([](double w) { return w / (w + kEnoughBlocks); }), usual);
}

/// Luminances of a block, and the normals with which its views saw it.
struct LightBlock {
  std::array<float, kSlots> light{};
  std::array<Vec3f, kSlots> normal{};
  std::size_t count = 0;
};

/// How far the views of a block disagree about its albedo, in shares of it; large ones count as
/// one.
double disagreement(const std::vector<LightBlock>& blocks, const FixedLight& light) {
  const auto parts =
      parallel_chunks<double>(blocks.size(), 256, [&](std::size_t begin, std::size_t end) {
        double sum = 0.0;
        for (std::size_t b = begin; b < end; ++b) {
          const LightBlock& block = blocks[b];
          std::array<float, kSlots> albedo{};
          float mean = 0.0f;
          for (std::size_t k = 0; k < block.count; ++k) {
            albedo[k] = block.light[k] / light.on(block.normal[k]);
            mean += albedo[k] / float(block.count);
          }
          for (std::size_t k = 0; k < block.count; ++k) {
            const double r = double((albedo[k] - mean) / (0.1f * mean));
            sum += r * r / (1.0 + r * r);
          }
        }
        return sum;
      });
  double sum = 0.0;
  for (const double part : parts) sum += part;
  return sum;
}

FixedLight light_from(double azimuth, double elevation, double share) {
  FixedLight light;
  light.direction =
      Vec3f(float(std::cos(elevation) * std::sin(azimuth)), float(std::sin(elevation)),
            float(std::cos(elevation) * std::cos(azimuth)));
  light.ambient = float(1.0 - share);
  light.lamp = float(share);
  return light;
}

}  // namespace

bool tells_of_exposure(const Vec3f& mean) {
  return mean.minCoeff() > kDarkest && mean.maxCoeff() < kBrightest;
}

BlockMeans block_means(const TexelBlocks& blocks, const ChosenViews& chosen,
                       const TexelSamples& samples) {
  const auto linear = linear_table();
  BlockMeans out(blocks.count());
  parallel_for(out.size(), 256, [&](std::size_t b) {
    for (std::size_t k = 0; k < kSlots; ++k) {
      out[b][k] = Vec3f::Constant(-1.0f);
      if (chosen.view[b][k] == kNoView) continue;
      const Sample* s = samples.of(b, k);
      Vec3f sum = Vec3f::Zero();
      int n = 0;
      bool whole = true;
      for (int i = 0; i < kBlockTexels && whole; ++i) {
        if (blocks.triangle(b, i) == kNoTriangle) continue;
        whole = s[i].valid == Sample::kWell;
        sum += Vec3f(linear[s[i].r], linear[s[i].g], linear[s[i].b]);
        ++n;
      }
      if (whole && n > 0) out[b][k] = sum / float(n);
    }
  });
  return out;
}

std::vector<Vec3f> solve_gains(const ChosenViews& chosen, const BlockMeans& means,
                               std::size_t views) {
  std::vector<Vec3f> out(views, Vec3f::Ones());
  for (int channel = 0; channel < 3; ++channel) {
    const Eigen::VectorXd gains = solve_channel(chosen, means, channel, views);
    for (std::size_t i = 0; i < views; ++i)
      out[i][channel] = float(std::exp(std::clamp(gains[Eigen::Index(i)], -2.0, 2.0)));
  }
  return out;
}

FixedLight solve_light(const ChosenViews& chosen, const BlockMeans& means,
                       const std::vector<Vec3f>& gains, const std::vector<Vec3f>& normals,
                       const std::vector<Eigen::Matrix3f>& rotation) {
  std::vector<LightBlock> blocks;
  const std::size_t step = std::max<std::size_t>(1, means.size() / kLightBlocks);
  for (std::size_t b = 0; b < means.size(); b += step) {
    LightBlock block;
    for (std::size_t k = 0; k < kSlots; ++k) {
      if (!tells_of_exposure(means[b][k])) continue;
      const std::uint16_t view = chosen.view[b][k];
      block.light[block.count] = means[b][k].cwiseProduct(gains[view]).sum();
      block.normal[block.count++] = rotation[view] * normals[b];
    }
    if (block.count >= 3) blocks.push_back(block);
  }
  FixedLight best;
  if (blocks.empty()) return best;
  double least = disagreement(blocks, best), azimuth = 0.0, elevation = 0.0, share = 0.0;
  const auto look = [&](double a, double e, double s) {
    if (s < 0.0 || s > 0.97 || std::abs(e) > kTurn / 4) return;
    const FixedLight light = light_from(a, e, s);
    const double value = disagreement(blocks, light);
    if (value < least) least = value, best = light, azimuth = a, elevation = e, share = s;
  };
  for (int e = -2; e <= 4; ++e)
    for (int a = 0; a < 18; ++a)
      for (const double s : {0.2, 0.45, 0.7, 0.9}) look(a * kTurn / 18, e * kTurn / 20, s);
  double step_angle = kTurn / 36, step_share = 0.12;
  for (int round = 0; round < 24 && share > 0.0; ++round) {
    const double a = azimuth, e = elevation, s = share;
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k)
          look(a + i * step_angle, e + j * step_angle, s + k * step_share);
    if (azimuth == a && elevation == e && share == s) step_angle *= 0.6, step_share *= 0.6;
  }
  double mean = 0.0, count = 0.0;
  for (const LightBlock& block : blocks)
    for (std::size_t k = 0; k < block.count; ++k, count += 1.0)
      mean += double(best.on(block.normal[k]));
  best.ambient *= float(count / mean);
  best.lamp *= float(count / mean);
  return best;
}

}  // namespace turnscan::texture
