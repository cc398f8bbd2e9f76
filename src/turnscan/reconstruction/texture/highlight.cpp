#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/texture/highlight.hpp>
#include <turnscan/reconstruction/texture/lamp.hpp>

namespace turnscan::texture {

namespace {

constexpr std::size_t kShineBlocks = 4000;  // blocks used for the search
constexpr float kBrightestShine = 0.96f;    // linear light; images are clipped above it
// Usual differences between colours of a point: relative, and in linear light.
constexpr float kUsualShare = 0.1f, kUsualLight = 0.02f;
// Linear light of a highlight at which a view's weight in a point's light is one half.
constexpr float kDoubtful = 0.05f;
constexpr double kMinShineExplained = 0.2;  // of the disagreement
constexpr float kNothing = 1e-3f;           // linear light
constexpr float kMuch = 0.1f;               // of the light of the darkest channel
constexpr int kMaxShineRounds = 40;
constexpr double kMinShineStep = 0.004;
// Exponents that are tried, and accepted: the widest lobe fits best to the shading of a lamp.
constexpr double kWidest = 12.0, kWidestTaken = 16.0, kNarrowest = 2000.0;

/// A block as used in the search: its darkest channel, in which a highlight is most visible.
struct ShineBlock {
  std::array<Vec3f, kSlots> normal, to_eye;  ///< rig's frame, unit
  std::array<float, kSlots> light{};
  std::size_t count = 0;
};

int darkest_channel(const std::array<Vec3f, kSlots>& means) {
  Vec3f sum = Vec3f::Zero();
  for (const Vec3f& mean : means)
    if (mean.x() >= 0.0f) sum += mean;
  int darkest = 0;
  sum.minCoeff(&darkest);
  return darkest;
}

std::vector<ShineBlock> shine_blocks(const TexelBlocks& blocks, const ChosenViews& chosen,
                                     const BlockMeans& means, const Viewpoints& from) {
  std::vector<ShineBlock> out;
  const std::size_t step = std::max<std::size_t>(1, means.size() / kShineBlocks);
  for (std::size_t b = 0; b < means.size(); b += step) {
    ShineBlock block;
    const int channel = darkest_channel(means[b]);
    const int texel = blocks.middle_texel(b);
    const Vec3f normal = blocks.normal(b, texel), position = blocks.surface(b, texel).position;
    for (std::size_t k = 0; k < kSlots; ++k) {
      const float light = means[b][k][channel];
      if (!(light >= 0.0f && light < kBrightestShine)) continue;
      const std::size_t view = chosen.view[b][k];
      block.normal[block.count] = from.rotation[view] * normal;
      block.to_eye[block.count] = from.rotation[view] * (from.eye[view] - position).normalized();
      block.light[block.count++] = light;
    }
    if (block.count >= 3) out.push_back(block);
  }
  return out;
}

struct Lobe {
  double azimuth = 0.0, elevation = 0.0, log_exponent = 0.0, log_strength = 0.0;
};

/// Evaluates highlights.
class HighlightSearch {
 public:
  HighlightSearch(std::vector<ShineBlock> blocks, const RunContext& context)
      : blocks_(std::move(blocks)), context_(context) {}

  void start() {
    const std::vector<double> exponents{std::log(20.0), std::log(60.0), std::log(200.0)};
    const std::vector<double> strengths{std::log(0.1), std::log(0.25), std::log(0.6)};
    even_ = least_ = score_all({}, {0.0}, {-100.0});
    for (int e = -2; e <= 5; ++e) {
      const int around = std::max(1, int(std::lround(20.0 * std::cos(e * kTurn / 20))));
      for (int a = 0; a < around; ++a)
        look({a * kTurn / around, e * kTurn / 20, 0.0, 0.0}, exponents, strengths);
    }
  }

  void refine() {
    double angle = kTurn / 36, log_step = 0.5;
    for (int round = 0;
         round < kMaxShineRounds && angle > kMinShineStep && found() && !context_.cancelled();
         ++round) {
      const Lobe at = best_;
      const double before = least_;
      const double wide = angle / std::max(0.2, std::cos(at.elevation));
      const std::vector<double> exponents{at.log_exponent - log_step, at.log_exponent,
                                          at.log_exponent + log_step};
      const std::vector<double> strengths{at.log_strength - log_step, at.log_strength,
                                          at.log_strength + log_step};
      for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j)
          look({at.azimuth + i * wide, at.elevation + j * angle, 0.0, 0.0}, exponents, strengths);
      if (least_ == before) angle *= 0.5, log_step *= 0.6;
    }
  }

  std::optional<Highlight> best() const {
    const double explained = even_ > 0.0 ? 1.0 - least_ / even_ : 0.0;
    if (!(explained > kMinShineExplained && best_.log_exponent > std::log(kWidestTaken)))
      return std::nullopt;
    return Highlight{rig_direction(best_.azimuth, best_.elevation),
                     float(std::exp(best_.log_strength)), float(std::exp(best_.log_exponent))};
  }

 private:
  bool found() const { return least_ < even_; }

  void look(Lobe lobe, const std::vector<double>& exponents, const std::vector<double>& strengths) {
    if (std::abs(lobe.elevation) > kTurn / 4 + 1e-9 || context_.cancelled()) return;
    score_all(lobe, exponents, strengths);
  }

  /// The minimum of all, which is stored if it is the best so far.
  double score_all(Lobe lobe, const std::vector<double>& exponents,
                   const std::vector<double>& strengths) {
    const Vec3f to_lamp = rig_direction(lobe.azimuth, lobe.elevation);
    const std::size_t tried = exponents.size() * strengths.size();
    const auto parts = parallel_chunks<std::vector<double>>(
        blocks_.size(), 256, [&](std::size_t begin, std::size_t end) {
          std::vector<double> sums(tried, 0.0);
          for (std::size_t b = begin; b < end; ++b)
            add_block(blocks_[b], to_lamp, exponents, strengths, sums);
          return sums;
        });
    double least = 1e300;
    for (std::size_t t = 0; t < tried; ++t) {
      double sum = 0.0;
      for (const auto& part : parts) sum += part[t];
      least = std::min(least, sum);
      lobe.log_exponent = exponents[t / strengths.size()];
      lobe.log_strength = strengths[t % strengths.size()];
      const double exponent = std::exp(lobe.log_exponent);
      if (sum < least_ && exponent >= kWidest && exponent <= kNarrowest) least_ = sum, best_ = lobe;
    }
    return least;
  }

  static void add_block(const ShineBlock& block, const Vec3f& to_lamp,
                        const std::vector<double>& exponents, const std::vector<double>& strengths,
                        std::vector<double>& sums) {
    std::array<float, kSlots> log_cosine{}, lobe{}, light{}, weight{};
    for (std::size_t k = 0; k < block.count; ++k) {
      const float cosine = block.normal[k].dot((to_lamp + block.to_eye[k]).normalized());
      log_cosine[k] =
          block.normal[k].dot(to_lamp) > 0.0f ? std::log(std::max(cosine, 1e-6f)) : -20.0f;
    }
    std::size_t t = 0;
    for (const double exponent : exponents) {
      const auto power = float(std::exp(exponent));
      for (std::size_t k = 0; k < block.count; ++k) {
        const float x = power * log_cosine[k];
        lobe[k] = x > -10.0f ? std::exp(x) : 0.0f;
      }
      for (const double strength : strengths) {
        const auto s = float(std::exp(strength));
        for (std::size_t k = 0; k < block.count; ++k) {
          light[k] = block.light[k] - s * lobe[k];
          const float r = s * lobe[k] / kDoubtful;
          weight[k] = 1.0f / (1.0f + r * r);
        }
        sums[t++] += double(disagreement(light, weight, block.count));
      }
    }
  }

  static float disagreement(const std::array<float, kSlots>& light,
                            const std::array<float, kSlots>& weight, std::size_t n) {
    float mean = 0.0f, total = 0.0f;
    for (std::size_t k = 0; k < n; ++k) mean += weight[k] * light[k], total += weight[k];
    mean /= total;
    const float over = 1.0f / (kUsualShare * std::max(0.0f, mean) + kUsualLight);
    float sum = 0.0f;
    for (std::size_t k = 0; k < n; ++k) {
      const float r = (light[k] - mean) * over;
      sum += r * r / (1.0f + r * r);
    }
    return sum;
  }

  const std::vector<ShineBlock> blocks_;
  const RunContext& context_;
  double even_ = 0.0, least_ = 0.0;
  Lobe best_;
};

}  // namespace

float Highlight::on(float cosine) const {
  if (!(cosine > 0.5f)) return 0.0f;
  const float light = strength * std::pow(cosine, exponent);
  return light > kNothing ? light : 0.0f;
}

SeenHighlight::SeenHighlight(const Highlight& highlight, const Viewpoints& viewpoints)
    : highlight_(highlight), eye_(viewpoints.eye) {
  for (const Eigen::Matrix3f& rotation : viewpoints.rotation)
    to_lamp_.push_back(rotation.transpose() * highlight.direction);
}

Result<std::optional<Highlight>> solve_highlight(const TexelBlocks& blocks,
                                                 const ChosenViews& chosen, const BlockMeans& means,
                                                 const Viewpoints& viewpoints,
                                                 const RunContext& context) {
  HighlightSearch search(shine_blocks(blocks, chosen, means, viewpoints), context);
  search.start();
  search.refine();
  TURNSCAN_TRY(context.check());
  return search.best();
}

BlockMeans without_highlight(BlockMeans means, const TexelBlocks& blocks, const ChosenViews& chosen,
                             const SeenHighlight& seen, const std::vector<Vec3f>& gains) {
  parallel_for(means.size(), 256, [&](std::size_t b) {
    const int texel = blocks.middle_texel(b);
    const Vec3f normal = blocks.normal(b, texel), position = blocks.surface(b, texel).position;
    for (std::size_t k = 0; k < kSlots && chosen.view[b][k] != kNoView; ++k) {
      const std::size_t view = chosen.view[b][k];
      const float light = seen.highlight().on(normal.dot(seen.half(view, position)));
      if (light == 0.0f) continue;
      means[b][k] -= light * gains[view].cwiseInverse();
      if (light > kMuch * means[b][k].cwiseProduct(gains[view]).minCoeff())
        means[b][k] = Vec3f::Constant(-1.0f);
    }
  });
  return means;
}

}  // namespace turnscan::texture
