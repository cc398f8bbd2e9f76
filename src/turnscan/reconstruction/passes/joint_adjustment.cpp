#include <turnscan/reconstruction/passes/joint_adjustment.hpp>

#include <cmath>
#include <map>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/estimation/normal_equations.hpp>
#include <turnscan/geometry/estimation/robust.hpp>
#include <turnscan/geometry/estimation/se3.hpp>
#include <turnscan/reconstruction/passes/color_match.hpp>

namespace turnscan::passes {

namespace {

constexpr float kPlaneCos = 0.85f;
constexpr double kTukey = 4.0, kMinSigma = 3e-5, kConverged = 3e-6;
/// Errors of a fitted mesh are correlated over several of its cells, and where the same frames saw
/// it.
constexpr double kBlock = 0.012;
/// Systematic errors that the scatter of the distances does not show: a sensor looking down sees
/// upward surface better than downward surface, and a pass's surface is shifted along its table's
/// axis by about this share of a depth's noise; and rotated, by another share at its rms distance
/// from the axis of rotation. From simulated scans.
constexpr double kRaised = 0.018, kTilted = 0.0045;
/// The effect of a sensor's own filter on curved surfaces is the same in all frames of a pass, too:
/// rotation at the rms distance from its axis, and translation in each direction, relative to the
/// square of the pixel spacing over the object's extent. From simulated scans with a Kinect v2's
/// physics (bench/pass_motion).
constexpr double kFilterTilted = 1.7, kFilterShifted = 0.7;
constexpr std::size_t kMinPairs = 50;
constexpr double kMinColorSigma = 0.02;

/// A point and a tangent plane of another pass, in the first pass's frame.
struct PlanePair {
  Vec3f point, normal;
  float distance = 0.0f, weight = 0.0f;  ///< weight 0: no partner
};

/// The colours of such a pair: their residual, and their gradients along the surface, one channel
/// per row. NaN: not known.
struct ColorPair {
  Vec3f difference;
  Eigen::Matrix3f gradient;
  float up_source, up_target;
};

struct DirectedPairs {
  std::size_t source, target;
  bool by_colors;
  std::vector<PlanePair> pairs;
  std::vector<ColorPair> colors;  ///< the same number, or none
  double color_sigma = 0.0;
};

using Row = Eigen::Matrix<double, 12, 1>;

/// Derivatives by the source's step, then by the target's.
Row row_of(const Vec3f& direction, const Vec3f& point, const Vec3d& center) {
  const Vec3d n = direction.cast<double>(), p = point.cast<double>() - center;
  Row row;
  row << p.cross(n), n, -p.cross(n), -n;
  return row;
}

class JointAdjustment {
 public:
  JointAdjustment(std::span<const PreparedPass* const> passes, std::span<const PassPair> pairs,
                  std::vector<Pose> poses, const AdjustEffort& effort)
      : passes_(passes), effort_(effort) {
    out_.T_first_pass = std::move(poses);
    out_.center = bounds(passes[0]->surface->points).center();
    for (const PassPair& pair : pairs) {
      directed_.push_back({pair.a, pair.b, pair.by_colors, {}, {}});
      directed_.push_back({pair.b, pair.a, pair.by_colors, {}, {}});
    }
  }

  Result<Adjustment> run(double reach_m, const RunContext& context) {
    for (int i = 0; i < effort_.iterations; ++i) {
      TURNSCAN_TRY(context.check());
      TURNSCAN_TRY(pair_up(reach_m));
      reach_m = std::max(3.0 * kTukey * out_.sigma_m, 0.5 * reach_m);
      if (step() < kConverged && i > 3) break;
    }
    state_covariance();
    return std::move(out_);
  }

 private:
  /// Adds the systematic shift and tilt of each pass. Those of the first move all others relative
  /// to it.
  void add_systematic(Eigen::MatrixXd& covariance) const {
    for (std::size_t k = 0; k < passes_.size(); ++k) {
      const PassSurface& surface = *passes_[k]->surface;
      const double bending_m =
          surface.filtered ? surface.spacing_m * surface.spacing_m / passes_[k]->extent_m : 0.0;
      const double raised = kRaised * surface.noise_m, shifted = kFilterShifted * bending_m;
      const double tilted = std::hypot(kTilted * surface.noise_m, kFilterTilted * bending_m);
      const Vec3d up = out_.T_first_pass[k].linear().col(1);
      Matrix6 own = Matrix6::Zero();
      own.topLeftCorner<3, 3>() = tilted * tilted * squared_levers(k).inverse();
      own.bottomRightCorner<3, 3>() =
          raised * raised * up * up.transpose() + shifted * shifted * Eigen::Matrix3d::Identity();
      for (Eigen::Index i = 0; i < covariance.rows(); i += 6) {
        for (Eigen::Index j = 0; j < covariance.rows(); j += 6)
          if (k == 0 || (i == j && i == Eigen::Index(6 * (k - 1))))
            covariance.block<6, 6>(i, j) += own;
      }
    }
  }

  /// x^T M x: mean square distance of a pass's surface from an axis x through its middle. For a
  /// slender object it is small along its length, about which the same error is a larger rotation.
  Eigen::Matrix3d squared_levers(std::size_t k) const {
    const std::vector<Vec3f>& points = passes_[k]->coarse.samples.points;
    Vec3d middle = Vec3d::Zero();
    for (const Vec3f& p : points) middle += p.cast<double>() / double(points.size());
    Eigen::Matrix3d sum = 1e-8 * Eigen::Matrix3d::Identity();
    for (const Vec3f& p : points) {
      const Vec3d d = out_.T_first_pass[k].linear() * (p.cast<double>() - middle);
      sum += (d.squaredNorm() * Eigen::Matrix3d::Identity() - d * d.transpose()) /
             double(points.size());
    }
    return sum;
  }

  std::size_t unknowns() const { return 6 * (passes_.size() - 1); }

  Result<> pair_up(double reach_m) {
    std::vector<float> distances;
    for (DirectedPairs& directed : directed_) {
      find_partners(directed, reach_m);
      for (const PlanePair& pair : directed.pairs)
        if (pair.weight > 0.0f) distances.push_back(std::abs(pair.distance));
    }
    out_.pairs = distances.size();
    if (out_.pairs < kMinPairs)
      return fail(ErrorCode::kTooFewPoints, "the passes' surfaces do not meet");
    out_.sigma_m = std::max(kMinSigma, estimation::mad_sigma(distances));
    for (DirectedPairs& directed : directed_)
      if (directed.by_colors) take_out_light(directed);
    return {};
  }

  /// Removes the shading, and estimates the scatter of the remainder.
  void take_out_light(DirectedPairs& directed) const {
    std::vector<ShadingFit::Pair> pairs;
    for (std::size_t i = 0; i < directed.pairs.size(); ++i) {
      const ColorPair& c = directed.colors[i];
      if (directed.pairs[i].weight > 0.0f && c.difference.allFinite())
        pairs.push_back({c.difference, c.up_source, c.up_target, directed.pairs[i].weight});
    }
    std::vector<float> sizes;
    const auto scatter_of = [&](const ShadingFit& light) {
      sizes.clear();
      for (const ShadingFit::Pair& p : pairs)
        sizes.push_back((p.difference - light.at(p.up_a, p.up_b)).norm());
      // The median length of three normal deviates is 1.54 of their standard deviation.
      return std::max(kMinColorSigma, median(sizes) / 1.54);
    };
    ShadingFit light(pairs, float(kTukey * scatter_of({})));
    directed.color_sigma = scatter_of(light);
    for (ColorPair& c : directed.colors) c.difference -= light.at(c.up_source, c.up_target);
  }

  void find_partners(DirectedPairs& directed, double reach_m) const {
    const PassSurface& source = *passes_[directed.source]->surface;
    const PreparedPass& target = *passes_[directed.target];
    const Eigen::Isometry3f T_first_target = out_.T_first_pass[directed.target].cast<float>();
    const Eigen::Isometry3f T =
        (out_.T_first_pass[directed.target].inverse() * out_.T_first_pass[directed.source])
            .cast<float>();
    const std::size_t stride = std::max<std::size_t>(1, source.points.size() / effort_.sources);
    directed.pairs.assign(source.points.size() / stride, {});
    directed.colors.resize(directed.by_colors ? directed.pairs.size() : 0);
    parallel_for(directed.pairs.size(), 256, [&](std::size_t k) {
      const std::size_t i = k * stride;
      const Vec3f q = T * source.points[i], nq = T.linear() * source.normals[i];
      std::uint32_t near = 0;
      float squared = 0.0f;
      if (target.tree.knn(q, 1, &near, &squared, float(reach_m)) == 0) return;
      const Vec3f& np = target.surface->normals[near];
      if (np.dot(nq) < kPlaneCos) return;
      const Vec3f n = (np + nq).normalized(), apart = target.surface->points[near] - q;
      const float r = n.dot(apart);
      // At the rim of the target's measured surface its nearest point is beside it.
      if ((apart - r * n).squaredNorm() > target.beside_m * target.beside_m) return;
      const float wq = source.weights[i], wp = target.surface->weights[near];
      directed.pairs[k] = {T_first_target * q, T_first_target.linear() * n, r,
                           source.areas[i] * wq * wp / (wq + wp)};
      if (directed.by_colors)
        directed.colors[k] =
            colors_of(*passes_[directed.source], i, target, near, apart, T, T_first_target);
    });
  }

  static ColorPair colors_of(const PreparedPass& source, std::size_t i, const PreparedPass& target,
                             std::uint32_t near, const Vec3f& apart,
                             const Eigen::Isometry3f& T_target_source,
                             const Eigen::Isometry3f& T_first_target) {
    const Eigen::Matrix3f gradient =
        0.5f * (target.color_gradients[near] +
                source.color_gradients[i] * T_target_source.linear().transpose());
    ColorPair out;
    out.difference = source.surface->colors[i] - target.surface->colors[near] + gradient * apart;
    out.gradient = gradient * T_first_target.linear().transpose();
    out.up_source = source.surface->normals[i].y();
    out.up_target = target.surface->normals[near].y();
    return out;
  }

  double tukey(const PlanePair& pair) const {
    return estimation::tukey_weight(double(pair.distance) / (kTukey * out_.sigma_m)) *
           double(pair.weight);
  }

  /// Calls use(weight, residual, row) for the equations of a pair of points.
  template <class Use>
  void each_row(const DirectedPairs& directed, std::size_t i, const Use& use) const {
    const PlanePair& pair = directed.pairs[i];
    const double w = tukey(pair);
    if (!(w > 0.0)) return;
    use(w, double(pair.distance), row_of(pair.normal, pair.point, out_.center));
    if (!directed.by_colors) return;
    const ColorPair& colors = directed.colors[i];
    const double u = double(colors.difference.norm()) / (kTukey * directed.color_sigma);
    if (!(u < 1.0)) return;
    const double per_color = out_.sigma_m / directed.color_sigma;
    const double color_weight = w * (1.0 - u * u) * (1.0 - u * u) * per_color * per_color;
    for (int c = 0; c < 3; ++c)
      use(color_weight, double(colors.difference[c]),
          row_of(colors.gradient.row(c).transpose(), pair.point, out_.center));
  }

  /// Adds a 12-vector or 12 x 12 matrix of two passes at the positions of their unknowns; the first
  /// has none.
  template <class Add>
  void scatter(const DirectedPairs& directed, const Add& add) const {
    const std::array<std::size_t, 2> pass{directed.source, directed.target};
    for (std::size_t i = 0; i < 2; ++i)
      if (pass[i] > 0) add(Eigen::Index(6 * (pass[i] - 1)), Eigen::Index(6 * i));
  }

  void accumulate() {
    normal_.setZero(Eigen::Index(unknowns()), Eigen::Index(unknowns()));
    gradient_.setZero(Eigen::Index(unknowns()));
    for (const DirectedPairs& directed : directed_) {
      estimation::NormalEquations<12> sum;
      for (std::size_t i = 0; i < directed.pairs.size(); ++i)
        each_row(directed, i,
                 [&](double w, double residual, const Row& row) { sum.add(row, residual, w); });
      scatter(directed, [&](Eigen::Index at, Eigen::Index from) {
        gradient_.segment<6>(at) += sum.right.segment<6>(from);
        scatter(directed, [&](Eigen::Index to, Eigen::Index other) {
          normal_.block<6, 6>(at, to) += sum.normal.block<6, 6>(from, other);
        });
      });
    }
  }

  /// Largest motion of a pass, at the size of the object.
  double step() {
    accumulate();
    Eigen::MatrixXd damped = normal_;
    damped.diagonal() *= 1.0 + 1e-9;
    const Eigen::VectorXd x = estimation::solve_ldlt(damped, gradient_);
    double largest = 0.0;
    for (std::size_t k = 1; k < passes_.size(); ++k) {
      const estimation::Twist own = x.segment<6>(Eigen::Index(6 * (k - 1)));
      largest =
          std::max(largest, own.head<3>().norm() * passes_[k]->extent_m + own.tail<3>().norm());
      Pose& T = out_.T_first_pass[k];
      T = estimation::orthonormalised(estimation::exp_about(out_.center, own) * T);
    }
    return largest;
  }

  /// H^-1 (sum of g g^T over blocks of the surface) H^-1 (Huber 1967), g a block's gradient.
  void state_covariance() {
    using Key = std::array<int, 4>;
    std::map<Key, Eigen::VectorXd> blocks;
    for (std::size_t d = 0; d < directed_.size(); ++d) {
      for (std::size_t i = 0; i < directed_[d].pairs.size(); ++i) {
        const Vec3f& point = directed_[d].pairs[i].point;
        each_row(directed_[d], i, [&](double w, double residual, const Row& row) {
          const Eigen::Vector3i at = (point / float(kBlock)).array().floor().cast<int>();
          // Both directions compare the same two surfaces.
          auto& block = blocks[{int(d / 2), at.x(), at.y(), at.z()}];
          if (block.size() == 0) block.setZero(Eigen::Index(unknowns()));
          const Row g = w * residual * row;
          scatter(directed_[d], [&](Eigen::Index to, Eigen::Index from) {
            block.segment<6>(to) += g.segment<6>(from);
          });
        });
      }
    }
    accumulate();
    Eigen::MatrixXd middle = Eigen::MatrixXd::Zero(normal_.rows(), normal_.cols());
    for (const auto& [key, g] : blocks) middle += g * g.transpose();
    const Eigen::MatrixXd inverse = estimation::DenseLdlt(normal_).inverse();
    Eigen::MatrixXd covariance = estimation::sandwich_covariance(inverse, middle);
    add_systematic(covariance);
    for (std::size_t k = 0; k < passes_.size(); ++k) {
      const auto at = Eigen::Index(6 * (k == 0 ? 0 : k - 1));
      out_.covariances.push_back(k == 0 ? Matrix6(Matrix6::Zero())
                                        : Matrix6(covariance.block<6, 6>(at, at)));
      out_.information.push_back(k == 0 ? Matrix6(Matrix6::Zero())
                                        : Matrix6(normal_.block<6, 6>(at, at)));
    }
  }

  std::span<const PreparedPass* const> passes_;
  AdjustEffort effort_;
  std::vector<DirectedPairs> directed_;
  Eigen::MatrixXd normal_;
  Eigen::VectorXd gradient_;
  Adjustment out_;
};

}  // namespace

Result<Adjustment> adjust(std::span<const PreparedPass* const> passes,
                          std::span<const PassPair> pairs, std::vector<Pose> T_first_pass,
                          double reach_m, const AdjustEffort& effort, const RunContext& context) {
  return JointAdjustment(passes, pairs, std::move(T_first_pass), effort).run(reach_m, context);
}

}  // namespace turnscan::passes
