#include <algorithm>
#include <cmath>
#include <limits>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/reconstruction/texture/blending.hpp>
#include <turnscan/reconstruction/texture/charts.hpp>
#include <turnscan/reconstruction/texture/light.hpp>

namespace turnscan::texture {

namespace {

constexpr float kOutlier = 10.0f;     // levels of 255 from the usual colour, with a weight of a
                                      // quarter
constexpr float kDarkerSays = 0.5f;   // vote of a darker colour against one, relative to that of an
                                      // equal one for it
constexpr float kSaturated = 250.0f;  // levels; such colours have a weight of a tenth
constexpr float kSaturatedWeight = 0.1f;
constexpr float kNearRimWeight = 1e-3f;
constexpr float kShineLevels = 4.0f;  // of a removed highlight, with a weight of a quarter
constexpr float kUnsureShadowWeight = 0.02f;
constexpr double kMaxShift_px = 1.0;
constexpr double kNoise = 3.0;      // levels; weaker patterns do not determine their position
constexpr double kExplained = 0.4;  // share of the squared difference that a shift must explain
constexpr float kMinSharpness = 0.3f, kMaxSharpness = 1.5f;

/// A view's colours as floats of 255, after its correction, to which it refers.
class Corrector {
 public:
  explicit Corrector(const Correction& correction)
      : levels_(correction.levels),
        lamp_(correction.lamp ? &*correction.lamp : nullptr),
        highlight_(correction.highlight ? &*correction.highlight : nullptr) {
    tables_.resize(correction.gains.size());
    for (std::size_t view = 0; view < tables_.size(); ++view)
      for (int c = 0; c < 3; ++c)
        for (int i = 0; i < 256; ++i)
          tables_[view][std::size_t(c * 256 + i)] =
              srgb_of(linear_of(float(i)) * correction.gains[view][c]);
    for (auto& slots : levels_)
      for (Vec3f& level : slots) level = level.array().pow(1.0f / 2.4f).matrix();
  }

  /// Corrections of the colours of a block, in addition to gains and levels.
  struct Surface {
    std::array<Vec3f, kBlockTexels> normal;  ///< if a lamp or a highlight needs it
    std::array<Vec3f, kSlots> half;          ///< if a highlight needs it
  };

  bool takes_out_lamp() const { return lamp_ != nullptr; }
  Surface surface(const TexelBlocks& blocks, const ChosenViews& chosen, std::size_t block) const {
    Surface out;
    if (lamp_ == nullptr && highlight_ == nullptr) return out;
    for (int i = 0; i < kBlockTexels; ++i) {
      if (blocks.triangle(block, i) == kNoTriangle) continue;
      Vec3f& normal = out.normal[std::size_t(i)];
      normal = blocks.normal(block, i);
      if (lamp_ != nullptr) normal += lamp_->tilts.at(block, i);
    }
    if (highlight_ == nullptr) return out;
    const Vec3f position = blocks.surface(block, blocks.middle_texel(block)).position;
    for (std::size_t k = 0; k < kSlots && chosen.view[block][k] != kNoView; ++k)
      out.half[k] = highlight_->half(chosen.view[block][k], position);
    return out;
  }
  /// Linear light of a highlight at a texel in a slot.
  float shine(const Surface& surface, std::size_t slot, int texel) const {
    if (highlight_ == nullptr) return 0.0f;
    return highlight_->highlight().on(surface.normal[std::size_t(texel)].dot(surface.half[slot]));
  }
  Vec3f operator()(std::size_t block, std::size_t slot, std::size_t view, const Sample& s,
                   const Surface& surface, int texel) const {
    const auto& table = tables_[view];
    Vec3f level = Vec3f::Ones();
    if (!levels_.empty()) level = levels_[block][slot];
    if (lamp_ != nullptr) {
      const float light = lamp_->light.on(
          surface.normal[std::size_t(texel)].dot(lamp_->to_lamp[view]), Lit(s.lit) != Lit::kNo);
      level *= std::pow(std::max(kMinLight, light), -1.0f / 2.4f);
    }
    Vec3f color(table[s.r], table[256u + s.g], table[512u + s.b]);
    if (const float light = shine(surface, slot, texel); light > 0.0f)
      for (float& c : color) c = srgb_of(linear_of(c) - light);
    return {scaled(color.x(), level.x()), scaled(color.y(), level.y()),
            scaled(color.z(), level.z())};
  }

 private:
  /// Multiplies linear light by factor^2.4. sRGB plus an offset is a power of it except in the
  /// darkest range; there the offset vanishes with it.
  static float scaled(float srgb, float factor) {
    constexpr float kOffset = 0.055f * 255.0f, kDark = 0.04045f * 255.0f;
    return srgb + (factor - 1.0f) * (srgb + kOffset * std::min(1.0f, srgb / kDark));
  }

  BlockLevels levels_;
  const LampCorrection* lamp_;
  const SeenHighlight* highlight_;
  std::vector<std::array<float, 768>> tables_;
};

/// Sums over the texels of a block for the shift of a view's pattern relative to that of the best
/// one (Lucas and Kanade 1981): the matrix of the gradients, gradients times difference, squared
/// differences.
struct ShiftSums {
  float xx = 0.0f, xy = 0.0f, yy = 0.0f, xe = 0.0f, ye = 0.0f, ee = 0.0f, n = 0.0f;
  void add(const ShiftSums& o) {
    xx += o.xx, xy += o.xy, yy += o.yy, xe += o.xe, ye += o.ye, ee += o.ee, n += o.n;
  }
};

struct Shift {
  double texels = 0.0;
  bool known = false;
  bool explains = false;  ///< it explains the difference of the two views
};

/// Shift along the directions in which the pattern is strong enough.
Shift shift_of(const ShiftSums& s) {
  Shift out;
  if (!(s.n >= 24.0f)) return out;
  Eigen::Matrix2d gradients;
  gradients << double(s.xx), double(s.xy), double(s.xy), double(s.yy);
  const auto eigen = estimation::symmetric_eigen(gradients);
  const Eigen::Vector2d right(double(s.xe), double(s.ye));
  double explained = 0.0, squared = 0.0;
  for (int i = 0; i < 2; ++i) {
    const double value = eigen.values[i];
    if (!(value > double(s.n) * kNoise * kNoise)) continue;
    const double d = eigen.vectors.col(i).dot(right) / value;
    squared += d * d;
    explained += d * d * value;
    out.known = true;
  }
  out.texels = std::sqrt(squared);
  // A highlight or a shadow is a difference without a shift.
  out.explains = explained > kExplained * double(s.ee);
  return out;
}

/// A view's colour of a texel, and its weight.
struct Taken {
  Vec3f color;
  float weight = 0.0f;
  float trust = 1.0f;  ///< share of the weight that remains under a highlight
};

using BlockShifts = std::array<ShiftSums, kSlots>;

class Blender {
 public:
  Blender(const TexelBlocks& blocks, const ChosenViews& chosen, const TexelSamples& samples,
          const Corrector& corrected, float darker_says, const RunContext& context)
      : blocks_(blocks),
        chosen_(chosen),
        samples_(samples),
        corrected_(corrected),
        darker_says_(darker_says),
        context_(context) {}

  void measure_shifts() {
    shifts_.resize(blocks_.count());
    parallel_for(blocks_.count(), 64, [&](std::size_t b) {
      if (!context_.cancelled()) shifts_[b] = shifts_of(b);
    });
  }

  /// One bit per misplaced slot. Appends the shifts of the slots for which they are known.
  std::uint8_t misplaced(std::size_t b, double texels_per_px, std::vector<float>& px) const {
    std::uint8_t out = 0;
    for (std::size_t k = 1; k < kSlots; ++k) {
      if (chosen_.view[b][k] == kNoView) break;
      const Shift shift = shift_of(sum_around(b, k));
      if (!shift.known) continue;
      px.push_back(float(shift.texels / texels_per_px));
      if (shift.explains && shift.texels > kMaxShift_px * texels_per_px)
        out = std::uint8_t(out | 1u << k);
    }
    return out;
  }

  /// Returns the view with the largest weight.
  std::uint16_t blend(std::size_t b, std::uint8_t left_out, Rgb* colors,
                      std::uint8_t* known) const {
    std::array<float, kSlots> total{};
    const Corrector::Surface surface = corrected_.surface(blocks_, chosen_, b);
    for (int i = 0; i < kBlockTexels; ++i) {
      if (blocks_.triangle(b, i) == kNoTriangle) continue;
      std::array<Taken, kSlots> taken;
      std::array<std::size_t, kSlots> slot;
      std::size_t n = 0;
      for (std::size_t k = 0; k < kSlots && chosen_.view[b][k] != kNoView; ++k) {
        const Sample& s = samples_.of(b, k)[i];
        if (s.valid == 0 || (left_out >> k & 1u) != 0) continue;
        taken[n] = take(b, k, s, surface, i);
        slot[n++] = k;
      }
      // A texel that only excluded views show uses those.
      for (std::size_t k = 0; n == 0 && k < kSlots && chosen_.view[b][k] != kNoView; ++k) {
        const Sample& s = samples_.of(b, k)[i];
        if (s.valid == 0) continue;
        taken[0] = take(b, k, s, surface, i);
        slot[0] = k;
        n = 1;
      }
      if (n == 0) continue;
      colors[i] = rounded(robust_mean(taken, n));
      known[i] = 1;
      float sum = 0.0f;
      for (std::size_t j = 0; j < n; ++j) sum += taken[j].weight;
      for (std::size_t j = 0; j < n; ++j) total[slot[j]] += taken[j].weight / sum;
    }
    const auto most = std::max_element(total.begin(), total.end());
    return *most > 0.0f ? chosen_.view[b][std::size_t(most - total.begin())] : kNoView;
  }

 private:
  Taken take(std::size_t b, std::size_t k, const Sample& s, const Corrector::Surface& surface,
             int texel) const {
    const std::uint16_t view = chosen_.view[b][k];
    Taken out{corrected_(b, k, view, s, surface, texel)};
    const float sharp = std::clamp(samples_.sharpness[view], kMinSharpness, kMaxSharpness);
    out.weight = chosen_.weight[b][k] / std::max(chosen_.weight[b][0], 1e-20f) * sharp * sharp;
    if (float(std::max({s.r, s.g, s.b})) >= kSaturated) out.weight *= kSaturatedWeight;
    if (s.valid == Sample::kNearRim) out.weight *= kNearRimWeight;
    if (corrected_.takes_out_lamp() && Lit(s.lit) == Lit::kUnsure)
      out.weight *= kUnsureShadowWeight;
    out.weight = std::max(out.weight, 1e-9f);
    if (const float light = corrected_.shine(surface, k, texel); light > 0.0f) {
      const float dark = out.color.minCoeff();
      const float r = (srgb_of(linear_of(dark) + light) - dark) / kShineLevels;
      out.trust = 1.0f / ((1.0f + r * r) * (1.0f + r * r));
      out.weight *= out.trust;
    }
    return out;
  }

  static Rgb rounded(const Vec3f& c) {
    const auto byte = [](float v) { return std::uint8_t(std::clamp(v + 0.5f, 0.0f, 255.0f)); };
    return {byte(c.x()), byte(c.y()), byte(c.z())};
  }

  /// Weighted mean about the colour that most views agree on. A highlight or a shadow moves over
  /// the surface from view to view: where several views have one, they do not agree with each
  /// other. Sets the weights to those in the mean.
  Vec3f robust_mean(std::array<Taken, kSlots>& taken, std::size_t n) const {
    if (n == 1) return taken[0].color;
    constexpr float kPerLevel = 1.0f / (kOutlier * kOutlier);
    const auto nearness = [&](std::size_t j, std::size_t k) {
      const float r = 1.0f + kPerLevel * (taken[j].color - taken[k].color).squaredNorm();
      return 1.0f / (r * r);
    };
    // The best views see a highlight, so the others vote on the usual colour, too. A highlight adds
    // light, so darker views speak against a colour, and brighter ones do not. Views with a known
    // highlight hardly vote, however many of them there are.
    std::array<float, kSlots> vote{};
    for (std::size_t k = 0; k < n; ++k)
      vote[k] = std::sqrt(std::sqrt(taken[k].weight / taken[k].trust)) * taken[k].trust;
    std::size_t usual = 0;
    float most = -std::numeric_limits<float>::infinity();
    for (std::size_t k = 0; k < n; ++k) {
      float support = 0.0f;
      for (std::size_t j = 0; j < n; ++j) {
        const float near = nearness(j, k);
        support += vote[j] * near;
        if (taken[j].color.sum() < taken[k].color.sum())
          support -= darker_says_ * vote[j] * (1.0f - near);
      }
      if (support > most) most = support, usual = k;
    }
    Vec3f sum = Vec3f::Zero();
    float weights = 0.0f;
    for (std::size_t k = 0; k < n; ++k) {
      taken[k].weight *= nearness(k, usual);
      sum += taken[k].weight * taken[k].color;
      weights += taken[k].weight;
    }
    return sum / weights;
  }

  BlockShifts shifts_of(std::size_t b) const {
    BlockShifts out;
    if (chosen_.view[b][0] == kNoView || chosen_.view[b][1] == kNoView) return out;
    std::array<float, kBlockTexels> best{};
    std::array<std::uint8_t, kBlockTexels> there{};
    const Corrector::Surface surface = corrected_.surface(blocks_, chosen_, b);
    fill(b, 0, surface, best, there);
    for (std::size_t k = 1; k < kSlots && chosen_.view[b][k] != kNoView; ++k) {
      std::array<float, kBlockTexels> other{};
      std::array<std::uint8_t, kBlockTexels> seen{};
      fill(b, k, surface, other, seen);
      ShiftSums& s = out[k];
      for (int y = 1; y + 1 < kBlock_px; ++y) {
        for (int x = 1; x + 1 < kBlock_px; ++x) {
          const auto i = std::size_t(y * kBlock_px + x);
          if (!there[i] || !there[i - 1] || !there[i + 1] || !there[i - kBlock_px] ||
              !there[i + kBlock_px] || !seen[i])
            continue;
          const float gx = 0.5f * (best[i + 1] - best[i - 1]);
          const float gy = 0.5f * (best[i + kBlock_px] - best[i - kBlock_px]);
          const float e = best[i] - other[i];
          s.add({gx * gx, gx * gy, gy * gy, gx * e, gy * e, e * e, 1.0f});
        }
      }
    }
    return out;
  }

  void fill(std::size_t b, std::size_t k, const Corrector::Surface& surface,
            std::array<float, kBlockTexels>& light,
            std::array<std::uint8_t, kBlockTexels>& there) const {
    const Sample* s = samples_.of(b, k);
    for (std::size_t i = 0; i < kBlockTexels; ++i) {
      if (s[i].valid != Sample::kWell) continue;
      const Vec3f c = corrected_(b, k, chosen_.view[b][k], s[i], surface, int(i));
      light[i] = 0.3f * c.x() + 0.59f * c.y() + 0.11f * c.z();
      there[i] = 1;
    }
  }

  /// Sums over the block and those around it with the same two views.
  ShiftSums sum_around(std::size_t b, std::size_t k) const {
    ShiftSums sum;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const std::int32_t at =
            blocks_.block_at(blocks_.left(b) + dx * kBlock_px, blocks_.top(b) + dy * kBlock_px);
        if (at < 0) continue;
        const auto other = std::size_t(at);
        if (blocks_.chart(other) != blocks_.chart(b)) continue;
        for (std::size_t l = 1; l < kSlots; ++l)
          if (chosen_.view[other][l] == chosen_.view[b][k]) sum.add(shifts_[other][l]);
      }
    }
    return sum;
  }

  const TexelBlocks& blocks_;
  const ChosenViews& chosen_;
  const TexelSamples& samples_;
  const Corrector& corrected_;
  const float darker_says_;
  const RunContext& context_;
  std::vector<BlockShifts> shifts_;
};

}  // namespace

Result<Blended> blend(const TexelBlocks& blocks, const ChosenViews& chosen,
                      const TexelSamples& samples, const Correction& correction,
                      double texels_per_m, const RunContext& context) {
  const Corrector corrected(correction);
  // After a lamp's correction a darker colour is as likely a missed shadow as a brighter one is a
  // highlight.
  const float darker_says = correction.lamp ? 0.0f : kDarkerSays;
  Blender blender(blocks, chosen, samples, corrected, darker_says, context);
  blender.measure_shifts();
  TURNSCAN_TRY(context.check());
  Blended out;
  out.colors.resize(blocks.count() * kBlockTexels);
  out.known.assign(out.colors.size(), 0);
  out.main_view.assign(blocks.count(), kNoView);
  const double texels_per_px = texels_per_m / std::max(chosen.pixels_per_m, 1e-9);
  struct Part {
    std::vector<float> px;
    std::size_t several = 0, one = 0;
  };
  auto parts = parallel_chunks<Part>(blocks.count(), 512, [&](std::size_t begin, std::size_t end) {
    Part part;
    for (std::size_t b = begin; b < end && !context.cancelled(); ++b) {
      const std::uint8_t left_out = blender.misplaced(b, texels_per_px, part.px);
      out.main_view[b] =
          blender.blend(b, left_out, &out.colors[b * kBlockTexels], &out.known[b * kBlockTexels]);
      std::size_t views = 0, kept = 0;
      for (std::size_t k = 0; k < kSlots && chosen.view[b][k] != kNoView; ++k) {
        ++views;
        kept += (left_out >> k & 1u) == 0 ? 1 : 0;
      }
      part.several += views > 1 ? 1 : 0;
      part.one += views > 1 && kept == 1 ? 1 : 0;
    }
    return part;
  });
  TURNSCAN_TRY(context.check());
  std::vector<float> px;
  std::size_t several = 0, one = 0;
  for (const Part& part : parts) {
    px.insert(px.end(), part.px.begin(), part.px.end());
    several += part.several, one += part.one;
  }
  out.disagreement_px = median(px);
  out.one_view_share = several > 0 ? double(one) / double(several) : 0.0;
  return out;
}

}  // namespace turnscan::texture
