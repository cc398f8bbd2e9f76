#include <turnscan/reconstruction/passes/color_match.hpp>

#include <array>
#include <cmath>
#include <map>
#include <turnscan/geometry/estimation/linear_solvers.hpp>

namespace turnscan::passes {

namespace {

/// A pattern of lower contrast is noise, or residual shading.
constexpr double kMinDeviation = 0.05;
/// Ratio to the standard deviation of all colours: a label that is small compared to the object
/// differs by more.
constexpr double kSpread = 2.5;
/// Stride of a permutation of the samples; coprime to most counts.
constexpr std::size_t kOtherOrder = 7919;
constexpr int kFitRounds = 4;
/// Errors of colour are correlated over some pixels of the images.
constexpr float kColorBlock_m = 0.006f;

using Terms = Eigen::Matrix<float, 5, 1>;

Terms terms(float up_a, float up_b) { return {1.0f, up_a, up_a * up_a, up_b, up_b * up_b}; }

/// The colours of samples without what the light of one pass alone explains.
std::vector<Vec3f> unlit(const Samples& samples) {
  std::vector<ShadingFit::Pair> pairs;
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (samples.colors[i].allFinite())
      pairs.push_back({samples.colors[i], samples.normals[i].y(), 0.0f, samples.areas[i]});
  const ShadingFit light(pairs, 1e3f);
  std::vector<Vec3f> out;
  for (const ShadingFit::Pair& p : pairs) out.push_back(p.difference - light.at(p.up_a, 0.0f));
  return out;
}

/// The samples of b that coincide with samples of a, and their colours without the shading.
class MatchedColors {
 public:
  MatchedColors(const PreparedPass& a, const PreparedPass& b, const Pose& T_a_b,
                const ColorScale& scale, double tolerance_m, Density density)
      : spread_(scale.spread) {
    const bool coarse = density == Density::kCoarse;
    const SurfaceLevel& of_a = coarse ? a.coarse : a.medium;
    const SurfaceLevel& of_b = coarse ? b.coarse : b.medium;
    const auto partner = agreeing_partners(a, b, T_a_b, tolerance_m, density);
    const Eigen::Isometry3f T = T_a_b.cast<float>();
    samples_ = partner.size();
    for (std::size_t i = 0; i < partner.size(); ++i) {
      const std::uint32_t k = partner[i];
      if (k == NearestGrid::kNone) continue;
      const Vec3f beside = T * of_b.samples.points[i] - of_a.samples.points[k];
      const Vec3f one = of_a.samples.colors[k] + of_a.color_gradients[k] * beside;
      const Vec3f& other = of_b.samples.colors[i];
      if (!one.allFinite() || !other.allFinite()) continue;
      pairs_.push_back({one - other, of_a.samples.normals[k].y(), of_b.samples.normals[i].y(),
                        of_b.samples.areas[i]});
      first_.push_back(one);
      second_.push_back(other);
      from_.push_back(i);
    }
    light_ = ShadingFit(pairs_, spread_);
  }

  std::size_t size() const { return pairs_.size(); }
  float area(std::size_t j) const { return pairs_[j].weight; }
  /// Mismatch between the colour of b at j and that of a at k.
  float mismatch(std::size_t j, std::size_t k) const {
    const Vec3f difference = first_[k] - second_[j] - light_.at(pairs_[k].up_a, pairs_[j].up_b);
    return std::min(1.0f, difference.squaredNorm() / (spread_ * spread_));
  }
  /// Mismatch per sample of b; -1 if it coincides with none.
  std::vector<float> of_samples() const {
    std::vector<float> out(samples_, -1.0f);
    for (std::size_t j = 0; j < size(); ++j) out[from_[j]] = mismatch(j, j);
    return out;
  }

 private:
  float spread_;
  std::size_t samples_ = 0;
  std::vector<ShadingFit::Pair> pairs_;
  std::vector<Vec3f> first_, second_;
  std::vector<std::size_t> from_;
  ShadingFit light_;
};

}  // namespace

ShadingFit::ShadingFit(std::span<const Pair> pairs, float scale) {
  coefficients_.setZero();
  for (int round = 0; round < kFitRounds; ++round) {
    // Row by row: of the matrix, then the right sides.
    std::array<Eigen::Array<double, 8, 1>, 5> rows;
    rows.fill(Eigen::Array<double, 8, 1>::Zero());
    for (const Pair& pair : pairs) {
      const Terms t = terms(pair.up_a, pair.up_b);
      float u2 = 0.0f;  // the first round uses all
      if (round > 0) {
        Vec3f left = pair.difference;
        for (int k = 0; k < 5; ++k) left -= t[k] * coefficients_.row(k).transpose();
        u2 = left.squaredNorm() / (4.0f * scale * scale);
      }
      if (!(u2 < 1.0f)) continue;
      const double w = double(pair.weight) * double((1.0f - u2) * (1.0f - u2));
      Eigen::Array<double, 8, 1> row;
      for (int k = 0; k < 5; ++k) row[k] = double(t[k]);
      for (int c = 0; c < 3; ++c) row[5 + c] = double(pair.difference[c]);
      for (std::size_t k = 0; k < 5; ++k) rows[k] += (w * row[Eigen::Index(k)]) * row;
    }
    Eigen::Matrix<double, 5, 5> matrix;
    Eigen::Matrix<double, 5, 3> vector;
    for (int k = 0; k < 5; ++k) {
      const Eigen::Array<double, 8, 1>& row = rows[std::size_t(k)];
      matrix.row(k) = row.head<5>().matrix().transpose();
      vector.row(k) = row.tail<3>().matrix().transpose();
    }
    const double weight = matrix(0, 0);
    if (!(weight > 0.0)) return;
    // Sets unobserved coefficients to 0.
    matrix.diagonal().array() += 1e-4 * weight;
    coefficients_ = estimation::solve_ldlt(matrix, vector).cast<float>();
  }
}

Vec3f ShadingFit::at(float up_a, float up_b) const {
  return coefficients_.transpose() * terms(up_a, up_b);
}

ColorScale color_scale(const PreparedPass& a, const PreparedPass& b) {
  ColorScale out;
  if (!a.colored() || !b.colored()) return out;
  const std::vector<Vec3f> of_a = unlit(a.medium.samples), of_b = unlit(b.medium.samples);
  if (of_a.empty() || of_b.empty()) return out;
  double squares = 0.0;
  for (const Vec3f& color : of_a) squares += double(color.squaredNorm()) / double(of_a.size());
  for (const Vec3f& color : of_b) squares += double(color.squaredNorm()) / double(of_b.size());
  const double deviation = std::sqrt(squares / 2.0);
  if (deviation > kMinDeviation) out.spread = float(kSpread * deviation);
  return out;
}

ColorAgreement compare_colors(const PreparedPass& a, const PreparedPass& b, const Pose& T_a_b,
                              const ColorScale& scale, double tolerance_m, Density density) {
  const MatchedColors matched(a, b, T_a_b, scale, tolerance_m, density);
  ColorAgreement out;
  for (std::size_t j = 0; j < matched.size(); ++j) {
    const double area = double(matched.area(j));
    out.area_m2 += area;
    out.mismatch_m2 += area * double(matched.mismatch(j, j));
    out.unrelated_m2 += area * double(matched.mismatch(j, j * kOtherOrder % matched.size()));
  }
  return out;
}

double color_preference(const PreparedPass& a, const PreparedPass& b, const Pose& one,
                        const Pose& other, const ColorScale& scale, double tolerance_m) {
  const std::vector<float> of_one =
      MatchedColors(a, b, one, scale, tolerance_m, Density::kMedium).of_samples();
  const std::vector<float> of_other =
      MatchedColors(a, b, other, scale, tolerance_m, Density::kMedium).of_samples();
  const Samples& samples = b.medium.samples;
  std::map<std::array<int, 3>, double> blocks;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (of_one[i] < 0.0f || of_other[i] < 0.0f) continue;
    const Eigen::Vector3i at = (samples.points[i] / kColorBlock_m).array().floor().cast<int>();
    blocks[{at.x(), at.y(), at.z()}] += double(samples.areas[i] * (of_other[i] - of_one[i]));
  }
  double sum = 0.0, squares = 0.0;
  for (const auto& [at, difference] : blocks) {
    sum += difference;
    squares += difference * difference;
  }
  return squares > 0.0 ? sum / std::sqrt(squares) : 0.0;
}

}  // namespace turnscan::passes
