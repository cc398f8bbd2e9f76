#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/estimation/normal_equations.hpp>
#include <turnscan/geometry/estimation/robust.hpp>
#include <turnscan/geometry/estimation/se3.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/registration/registration.hpp>
#include <turnscan/geometry/search/closest_point.hpp>
#include <turnscan/geometry/search/knn.hpp>

namespace turnscan {
namespace {

constexpr std::size_t kMinPairs = 6;
constexpr double kHeldEigenvalue = 1e-3;  // relative to the largest

struct Pair {
  Vec3d p, normal;  // target frame
  double residual;  // along the normal
  double distance;
};

struct Step {
  Pose T = Pose::Identity();
  double farthest_move_m = 0.0;
  double rms_m = 0.0;
  int held_directions = 0;
};

class PointToPlaneIcp {
 public:
  PointToPlaneIcp(std::span<const Vec3f> source, const IcpLookup& target, const Pose& start,
                  const IcpOptions& options)
      : target_(target), options_(options), T_(start), start_(start) {
    for (const Vec3f& p : source) {
      if (p.allFinite()) source_.push_back(p.cast<double>());
    }
    for (const Vec3d& p : source_) middle_ += p / double(source_.size());
  }

  Result<IcpResult> run(const RunContext& context) {
    for (int i = 1; i <= options_.max_iterations; ++i) {
      TURNSCAN_TRY(context.check());
      TURNSCAN_TRY(find_pairs(context));
      const Step step = solve();
      T_ = step.T * T_;
      TURNSCAN_TRY(check_motion());
      last_move_ = step.farthest_move_m;
      if (last_move_ <= options_.tolerance_m) {
        return IcpResult{T_, step.rms_m, overlap_, i, step.held_directions};
      }
    }
    return fail(ErrorCode::kLibrary,
                "alignment: not converged after {} steps, the last one moved by {:.4f} mm; start "
                "nearer or allow more steps",
                options_.max_iterations, last_move_ * 1e3);
  }

 private:
  Result<> find_pairs(const RunContext& context) {
    std::vector<IcpTarget> found(source_.size());
    TURNSCAN_TRY(parallel_for(source_.size(), 512, context, [&](std::size_t i) {
      found[i] = target_(T_ * source_[i], options_.max_distance_m);
    }));
    pairs_.clear();
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!found[i].found) continue;
      const Vec3d p = T_ * source_[i];
      const Vec3d between = p - found[i].point;
      pairs_.push_back({p, found[i].normal, between.dot(found[i].normal), between.norm()});
    }
    overlap_ = source_.empty() ? 0.0 : double(pairs_.size()) / double(source_.size());
    if (pairs_.size() < kMinPairs || overlap_ < options_.min_overlap) {
      return fail(ErrorCode::kTooFewPoints,
                  "alignment: {} of {} points lie within {} of the target; start nearer or allow a "
                  "larger distance",
                  pairs_.size(), source_.size(),
                  format_quantity(options_.max_distance_m, Quantity::kLength));
    }
    trim();
    return {};
  }

  /// Keeps the nearest pairs, in their order.
  void trim() {
    const auto keep = std::max(kMinPairs, std::size_t(options_.keep * double(pairs_.size()) + 0.5));
    if (keep >= pairs_.size()) return;
    std::vector<double> distances;
    for (const Pair& pair : pairs_) distances.push_back(pair.distance);
    std::nth_element(distances.begin(), distances.begin() + std::ptrdiff_t(keep - 1),
                     distances.end());
    const double limit = distances[keep - 1];
    std::erase_if(pairs_, [&](const Pair& pair) { return pair.distance > limit; });
  }

  double huber_limit() const {
    std::vector<double> sizes;
    for (const Pair& pair : pairs_) sizes.push_back(std::abs(pair.residual));
    return estimation::kHuber95 * estimation::kMadToSigma * median(sizes);
  }

  /// Rotation (times a length, so that all six unknowns are lengths) about the pairs' centre, and
  /// translation.
  Step solve() const {
    Vec3d center = Vec3d::Zero();
    for (const Pair& pair : pairs_) center += pair.p / double(pairs_.size());
    double radius2 = 0.0, squares = 0.0;
    for (const Pair& pair : pairs_) {
      radius2 += (pair.p - center).squaredNorm() / double(pairs_.size());
      squares += pair.residual * pair.residual;
    }
    const double length = std::max(std::sqrt(radius2), 1e-12), limit = huber_limit();
    estimation::NormalEquations<6> equations;
    for (const Pair& pair : pairs_) {
      estimation::Vector6d row;
      row << (pair.p - center).cross(pair.normal) / length, pair.normal;
      const double size = std::abs(pair.residual);
      equations.add(row, -pair.residual, limit > 0.0 ? estimation::huber_weight(size, limit) : 1.0);
    }
    const auto [twist, held] = estimation::solve_firm(equations, kHeldEigenvalue);
    Step step{estimation::exp_about(center, twist, length), 0.0,
              std::sqrt(squares / double(pairs_.size())), held};
    for (const Vec3d& p : source_) {
      const Vec3d at = T_ * p;
      step.farthest_move_m = std::max(step.farthest_move_m, (step.T * at - at).norm());
    }
    return step;
  }

  Result<> check_motion() const {
    const double shift = (T_ * middle_ - start_ * middle_).norm();
    const double turn = Eigen::AngleAxisd(T_.linear() * start_.linear().transpose()).angle();
    if (!(shift <= options_.max_shift_m) || !(turn <= options_.max_turn_rad)) {
      return fail(
          ErrorCode::kLibrary,
          "alignment: moved by {:.1f} mm and turned by {:.1f} deg, more than allowed; start "
          "nearer or allow more",
          shift * 1e3, turn * kDegreesPerRadian);
    }
    return {};
  }

  const IcpLookup& target_;
  const IcpOptions& options_;
  Pose T_, start_;
  std::vector<Vec3d> source_;
  Vec3d middle_ = Vec3d::Zero();
  std::vector<Pair> pairs_;
  double overlap_ = 0.0, last_move_ = 0.0;
};

}  // namespace

OptionTable describe(IcpOptions& options) {
  OptionTable table;
  table.number("icp-iterations", options.max_iterations, {1, 100000},
               "Most steps of the alignment.");
  table.number("icp-distance", options.max_distance_m, Quantity::kLength, {1e-7, 1e3},
               "Points farther than this from the target do not take part in the alignment.");
  table.number("icp-keep", options.keep, Quantity::kNone, {0.05, 1.0},
               "Fraction of the nearest pairs that takes part in the alignment.");
  table.number("icp-overlap", options.min_overlap, Quantity::kNone, {0.0, 1.0},
               "The alignment fails when a smaller fraction of the points is near the target.");
  table.number("icp-tolerance", options.tolerance_m, Quantity::kLength, {1e-12, 1.0},
               "The alignment is done when a step moves no point farther than this.");
  table.number("icp-shift", options.max_shift_m, Quantity::kLength, {0.0, 1e3},
               "The alignment fails when it shifts the mesh farther than this.");
  table.number("icp-turn", options.max_turn_rad, Quantity::kAngle, {0.0, 3.2},
               "The alignment fails when it turns the mesh farther than this.");
  return table;
}

Result<IcpResult> icp(std::span<const Vec3f> source, const IcpLookup& target, const Pose& start,
                      const IcpOptions& options, const RunContext& context) {
  IcpOptions checked = options;
  TURNSCAN_TRY(describe(checked).check());
  return PointToPlaneIcp(source, target, start, options).run(context);
}

Result<IcpResult> icp(std::span<const Vec3f> source, std::span<const Vec3f> target_points,
                      std::span<const Vec3f> target_normals, const Pose& start,
                      const IcpOptions& options, const RunContext& context) {
  if (target_points.size() != target_normals.size()) {
    return fail(ErrorCode::kInvalidOption, "alignment: {} points and {} normals; give one for each",
                target_points.size(), target_normals.size());
  }
  const KdTree tree(target_points);
  const IcpLookup lookup = [&](const Vec3d& p, double max_distance) -> IcpTarget {
    std::uint32_t i = 0;
    float squared = 0.0f;
    if (tree.knn(p.cast<float>(), 1, &i, &squared) == 0) return {};
    const Vec3d q = target_points[i].cast<double>();
    return {q, target_normals[i].cast<double>(), (p - q).norm() <= max_distance};
  };
  return icp(source, lookup, start, options, context);
}

Result<IcpResult> icp(std::span<const Vec3f> source, const TriangleMesh& target, const Pose& start,
                      const IcpOptions& options, const RunContext& context) {
  TURNSCAN_TRY(validate_mesh(target, "alignment target"));
  TURNSCAN_ASSIGN(const MeshDistance distance, MeshDistance::create(target, context));
  const IcpLookup lookup = [&](const Vec3d& p, double max_distance) -> IcpTarget {
    const auto hit = distance.closest(p, max_distance);
    if (hit.triangle == MeshDistance::kNone) return {};
    const auto& [a, b, c] = target.triangles[hit.triangle];
    const Vec3d o = target.vertices[a].cast<double>();
    const Vec3d normal = (target.vertices[b].cast<double>() - o)
                             .cross(target.vertices[c].cast<double>() - o)
                             .normalized();
    return {hit.point, normal, true};
  };
  return icp(source, lookup, start, options, context);
}

}  // namespace turnscan
