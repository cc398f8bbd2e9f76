#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/reconstruction/texture/charts.hpp>
#include <turnscan/reconstruction/texture/exposure.hpp>
#include <turnscan/reconstruction/texture/light.hpp>

namespace turnscan::texture {

namespace {

constexpr float kDarkest = 0.004f, kBrightest = 0.96f;  // range of linear light usable for exposure
constexpr int kGainRounds = 4;
constexpr double kGainScale = 0.08;     // larger log ratios are not attributed to exposure
constexpr double kEnoughBlocks = 20.0;  // comparing two views
constexpr double kUsualGain = 0.15;     // log of the prior deviation of gains from 1
constexpr double kMinPairError = 0.01;  // log
constexpr int kStayRounds = 3;
constexpr std::size_t kGainChunks = 32;

std::array<float, 256> linear_table() {
  std::array<float, 256> out{};
  for (std::size_t i = 0; i < 256; ++i) out[i] = linear_of(float(i));
  return out;
}

/// For one channel and each pair of views: weights and weighted sums of the difference between the
/// logarithms of their gains.
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

/// Logarithms of the gains that best fit the pairs' ratios. The contradictions between these
/// determine their weight relative to the prior that exposures are similar.
Eigen::VectorXd balanced(const Eigen::MatrixXd& weight, const Eigen::MatrixXd& ratio) {
  const Eigen::Index n = weight.rows();
  Eigen::MatrixXd matrix = -weight;
  matrix.diagonal() += weight.rowwise().sum();
  const Eigen::VectorXd right = weight.cwiseProduct(ratio).rowwise().sum();
  Eigen::VectorXd gains = Eigen::VectorXd::Zero(n);
  double error = kMinPairError;
  for (int round = 0; round < kStayRounds; ++round) {
    Eigen::MatrixXd stayed = matrix;
    stayed.diagonal().array() += error * error / (kUsualGain * kUsualGain);
    gains = estimation::solve_ldlt(stayed, right);
    const Eigen::MatrixXd fitted = gains.replicate(1, n) - gains.transpose().replicate(n, 1);
    const double squared = weight.cwiseProduct((ratio - fitted).cwiseAbs2()).sum();
    error = std::max(kMinPairError, std::sqrt(squared / std::max(weight.sum(), 1e-9)));
  }
  return gains;
}

/// The ratio of each pair of views is estimated separately, then all are balanced. Outliers are
/// downweighted only among the blocks of the same pair: where a lamp makes each view a little
/// darker than the next, all around the object, the pair that closes the circle fits worst, and is
/// correct.
Eigen::VectorXd solve_channel(const ChosenViews& chosen, const BlockMeans& means, int channel,
                              std::size_t views) {
  const auto n = Eigen::Index(views);
  const std::size_t chunk = (means.size() + kGainChunks - 1) / kGainChunks;
  if (chunk == 0) return Eigen::VectorXd::Zero(n);
  PairSums all{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n)};
  Eigen::MatrixXd usual = Eigen::MatrixXd::Zero(n, n);
  for (int round = 0; round < kGainRounds; ++round) {
    // In the first round outliers cannot be identified yet.
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

}  // namespace turnscan::texture
