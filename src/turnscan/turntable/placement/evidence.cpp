#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/geometry/estimation/robust.hpp>
#include <turnscan/turntable/placement/evidence.hpp>

namespace turnscan::placement {

namespace {

/// Standard deviations of a pair's estimate beyond noise: silhouettes, occluded parts, warped
/// depth.
constexpr double kShiftFloor_m = 1e-4, kTurnFloor = 0.03 * kRadiansPerDegree;
constexpr double kTurnPerApart = 0.004;
/// Standard deviation of the apparent additional rotation between two views from different sides,
/// relative to their rotation.
constexpr double kBiasSigma = 0.003;
/// Median of a chi square over its number of unknowns, for three to six of them.
constexpr double kMedianPerUnknown = 0.87;
/// Prior standard deviations of a model's unknowns, metres: only unobserved ones stay at zero.
constexpr double kValueSigma_m = 0.1, kCalibrationSigma_m = 0.002, kHeldSigma_m = 1e-7;

/// Biases independent of the models: two of rotations, and for the platter's axis two in the
/// sensor's frame and two in the table's.
constexpr Eigen::Index kBiases = 6;
constexpr double kPlatterBias_rad = 1.0 * kRadiansPerDegree;
/// Occluders of the platter, and light reflected by the object, change with the rotation.
constexpr double kTiltFloor_rad = 0.1 * kRadiansPerDegree;
constexpr std::size_t kMinTilts = 12;

using TiltRows = Eigen::Matrix<double, 2, Eigen::Dynamic>;

RelativeTwist both_ways(const PairConstraint& a, const PairConstraint* b, double variance) {
  RelativeTwist out;
  out.pair = a.pair;
  out.information = a.normal / variance;
  out.right = a.right / variance;
  if (b != nullptr) {
    out.information += b->normal / variance;
    out.right -= b->right / variance;
  }
  return out;
}

/// Combines the noise of a pair with the errors shared by all its points: (H^-1 + S)^-1, where H
/// may be singular.
void add_floor(RelativeTwist& twist, double lever_m) {
  const double turn = lever_m * std::hypot(kTurnFloor, kTurnPerApart * twist.apart_rad);
  Twist floor;
  floor << turn, turn, turn, kShiftFloor_m, kShiftFloor_m, kShiftFloor_m;
  const Matrix6d both = Matrix6d::Identity() + twist.information * floor.cwiseAbs2().asDiagonal();
  const Matrix6d information = estimation::solve_lu(both, twist.information);
  twist.information = 0.5 * (information + information.transpose());
  twist.right = estimation::solve_lu(both, twist.right);
}

/// Effective number of informative eigenvalues.
double rank_of(const Matrix6d& information) {
  const Twist values = estimation::symmetric_eigen(information).values;
  return double((values.array() > 1e-6 * values[5]).count());
}

/// Derivative of the platter's axis in the table frame, (x, z), by the unknowns of a model.
TiltRows tilted_by(ModelKind kind, const Basis& basis, double lever_m) {
  TiltRows out = TiltRows::Zero(2, basis.cols());
  if (kind == ModelKind::kObject) return out;  // It moves on the platter.
  out.row(0) = basis.row(2) / lever_m;
  out.row(1) = -basis.row(0) / lever_m;
  return out;
}

double sigma_of(const DisturbanceModel& model) {
  if (model.held) return kHeldSigma_m;
  return model.kind == ModelKind::kCalibration ? kCalibrationSigma_m : kValueSigma_m;
}

}  // namespace

Evidence::Evidence(const Keyframes& frames, const PoseGraph& graph,
                   const std::vector<Pose>& believed, std::vector<ModelFrame> model_frames,
                   const ModelScene& scene)
    : model_frames_(std::move(model_frames)), scene_(scene) {
  find_excess(graph);
  scale_m_ = graph.scale_m;
  std::map<std::pair<std::uint32_t, std::uint32_t>, const PairConstraint*> all;
  for (const PairConstraint& c : graph.constraints) all[{c.pair.from, c.pair.to}] = &c;
  std::vector<Twist> offset;
  for (std::size_t i = 0; i < frames.size(); ++i)
    offset.push_back(estimation::log_about(frames.middle, graph.poses[i] * believed[i].inverse(),
                                           frames.lever_m));
  const double variance = excess_ * graph.scale_m * graph.scale_m;
  for (const auto& [key, constraint] : all) {
    const auto reverse = all.find({key.second, key.first});
    if (reverse != all.end() && key.second < key.first) continue;
    RelativeTwist twist =
        both_ways(*constraint, reverse != all.end() ? reverse->second : nullptr, variance);
    twist.apart_rad = turn_between(graph.poses[key.first], graph.poses[key.second]);
    twist.right += twist.information * (offset[key.first] - offset[key.second]);
    if (constraint->count < 50) continue;
    twist.shown = rank_of(twist.information);
    add_floor(twist, frames.lever_m);
    twists_.push_back(twist);
  }
  find_tilts(frames, believed);
}

/// Their noise is estimated from the differences of successive tilts.
void Evidence::find_tilts(const Keyframes& frames, const std::vector<Pose>& believed) {
  std::vector<double> steps;
  std::optional<Vec3d> last;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto& sight = frames.data.frames[i].platter;
    if (!sight) continue;
    if (!last) {
      beside_axis_.col(0) = sight->axis.unitOrthogonal();
      beside_axis_.col(1) = sight->axis.cross(beside_axis_.col(0));
    }
    PlatterTilt tilt;
    tilt.frame = i;
    tilt.to_level.row(0) = believed[i].linear().row(0);
    tilt.to_level.row(1) = believed[i].linear().row(2);
    tilt.level = tilt.to_level * sight->axis;
    tilts_.push_back(tilt);
    if (last) steps.push_back((sight->axis - *last).squaredNorm() / 4.0);
    last = sight->axis;
  }
  if (tilts_.size() < kMinTilts) tilts_.clear();
  // For two degrees of freedom.
  tilt_sigma_ = std::sqrt(median(steps) / std::numbers::ln2);
  tilt_sigma_ = std::hypot(tilt_sigma_, kTiltFloor_rad);
}

/// Estimates of an unknown by single pairs scatter more than independent noise explains.
void Evidence::find_excess(const PoseGraph& graph) {
  for (int k = 0; k < 6; ++k) {
    std::vector<double> ratios;
    for (const PairConstraint& c : graph.constraints) {
      if (c.count < 50 || !(c.normal(k, k) > 0.0)) continue;
      ratios.push_back(c.right[k] * c.right[k] / (c.normal(k, k) * graph.scale_m * graph.scale_m));
    }
    excess_ = std::max(excess_, median(ratios) / estimation::kMedianOfSquare);
  }
  // Both directions of a pair, and pairs of one frame, share the noise of their frames.
  excess_ *= 2.0;
}

/// The normal equations of some models: the biases, then their unknowns.
struct Evidence::System {
  std::vector<Basis> basis;             ///< per frame
  std::vector<Basis> between;           ///< per pair
  std::vector<Basis> weighted;          ///< between times the information
  std::vector<TiltRows> tilted;         ///< per tilt, over its standard deviation
  Eigen::MatrixXd matrix, tilt_matrix;  ///< of everything, and of the tilts alone
  Eigen::VectorXd right, tilt_right;
  estimation::DenseLdlt factors;
};

Evidence::System Evidence::system_of(const std::vector<DisturbanceModel>& models) const {
  Eigen::Index n = kBiases;
  for (const DisturbanceModel& model : models) n += unknowns_of(model.kind);
  System out;
  out.basis.assign(model_frames_.size(), Basis::Zero(6, n));
  Eigen::VectorXd weak = Eigen::VectorXd::Zero(n);
  weak.head<2>().setConstant(std::pow(kBiasSigma * scene_.lever_m, -2));
  weak.segment<4>(2).setConstant(std::pow(kPlatterBias_rad, -2));
  out.tilted.assign(tilts_.size(), TiltRows::Zero(2, n));
  Eigen::Index at = kBiases;
  for (const DisturbanceModel& model : models) {
    const Eigen::Index count = unknowns_of(model.kind);
    for (std::size_t i = 0; i < out.basis.size(); ++i)
      out.basis[i].middleCols(at, count) = basis_of(model, model_frames_[i], scene_);
    for (std::size_t k = 0; k < tilts_.size(); ++k)
      out.tilted[k].middleCols(at, count) =
          tilted_by(model.kind, out.basis[tilts_[k].frame].middleCols(at, count), scene_.lever_m) /
          tilt_sigma_;
    weak.segment(at, count).setConstant(std::pow(sigma_of(model), -2));
    at += count;
  }
  out.matrix = weak.asDiagonal();
  out.right = Eigen::VectorXd::Zero(n);
  Twist about_axis;
  about_axis << Vec3d::UnitY(), Vec3d::UnitY().cross(scene_.middle) / scene_.lever_m;
  for (const RelativeTwist& t : twists_) {
    Basis between = out.basis[t.pair.from] - out.basis[t.pair.to];
    between.col(0) = t.apart_rad * about_axis;
    between.col(1) = t.apart_rad * std::abs(t.apart_rad) * about_axis;
    Basis weighted = t.information * between;
    out.matrix.noalias() += between.transpose() * weighted;
    out.right.noalias() += between.transpose() * t.right;
    out.between.push_back(std::move(between));
    out.weighted.push_back(std::move(weighted));
  }
  out.tilt_matrix = Eigen::MatrixXd::Zero(n, n);
  out.tilt_right = Eigen::VectorXd::Zero(n);
  for (std::size_t k = 0; k < tilts_.size(); ++k) {
    TiltRows& rows = out.tilted[k];
    rows.middleCols(2, 2) = tilts_[k].to_level * beside_axis_ / tilt_sigma_;
    rows.middleCols(4, 2) = Eigen::Matrix2d::Identity() / tilt_sigma_;
    out.tilt_matrix.noalias() += rows.transpose() * rows;
    out.tilt_right.noalias() += rows.transpose() * tilts_[k].level / tilt_sigma_;
  }
  out.matrix += out.tilt_matrix;
  out.right += out.tilt_right;
  out.factors.compute(out.matrix);
  return out;
}

/// Uses the median, since a step that is not among the models yet is seen by few pairs.
double Evidence::spread_of(const System& system, const Eigen::VectorXd& values) const {
  std::vector<double> ratios;
  for (std::size_t k = 0; k < twists_.size(); ++k) {
    const RelativeTwist& t = twists_[k];
    if (t.shown < 1.0) continue;
    const Twist left = t.right - system.weighted[k] * values;
    // The remaining chi square, with the pseudo-inverse of the information.
    ratios.push_back(left.dot(estimation::solve_least_norm(t.information, left)) / t.shown);
  }
  return std::max(1.0, median(ratios) / kMedianPerUnknown);
}

double Evidence::gain_of(const System& system, const DisturbanceModel& candidate) const {
  const Eigen::Index count = unknowns_of(candidate.kind);
  std::vector<Basis> basis;
  for (const ModelFrame& frame : model_frames_) basis.push_back(basis_of(candidate, frame, scene_));
  Eigen::MatrixXd own =
      Eigen::VectorXd::Constant(count, std::pow(sigma_of(candidate), -2)).asDiagonal();
  Eigen::MatrixXd mixed = Eigen::MatrixXd::Zero(system.right.size(), count);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  for (std::size_t k = 0; k < twists_.size(); ++k) {
    const RelativeTwist& t = twists_[k];
    const Basis between = basis[t.pair.from] - basis[t.pair.to];
    if (between.isZero(0.0)) continue;
    own.noalias() += between.transpose() * t.information * between;
    mixed.noalias() += system.weighted[k].transpose() * between;
    right.noalias() += between.transpose() * t.right;
  }
  for (std::size_t k = 0; k < tilts_.size(); ++k) {
    const TiltRows rows =
        tilted_by(candidate.kind, basis[tilts_[k].frame], scene_.lever_m) / tilt_sigma_;
    own.noalias() += rows.transpose() * rows;
    mixed.noalias() += system.tilted[k].transpose() * rows;
    right.noalias() += rows.transpose() * tilts_[k].level / tilt_sigma_;
  }
  own -= mixed.transpose() * system.factors.solve(mixed);
  right -= mixed.transpose() * system.factors.solve(system.right);
  return right.dot(estimation::solve_ldlt(own, right));
}

std::vector<double> Evidence::gains(const std::vector<DisturbanceModel>& models,
                                    const std::vector<DisturbanceModel>& candidates) const {
  const System system = system_of(models);
  std::vector<double> out(candidates.size());
  parallel_for(candidates.size(), 8,
               [&](std::size_t k) { out[k] = gain_of(system, candidates[k]); });
  return out;
}

ModelFit Evidence::fit(std::vector<DisturbanceModel> models) const {
  const System system = system_of(models);
  const Eigen::VectorXd values = system.factors.solve(system.right);
  ModelFit out;
  out.tilt_gain = 2.0 * values.dot(system.tilt_right) - values.dot(system.tilt_matrix * values);
  out.gain = values.dot(system.right) - out.tilt_gain;
  out.spread = spread_of(system, values);
  Eigen::Index at = kBiases;
  for (DisturbanceModel& model : models) {
    const Eigen::Index count = unknowns_of(model.kind);
    model.values = values.segment(at, count);
    Basis mean = Basis::Zero(6, count);
    for (const Basis& b : system.basis)
      mean += b.middleCols(at, count) / double(system.basis.size());
    double squares = 0.0;
    for (const Basis& b : system.basis)
      squares = std::max(squares, ((b.middleCols(at, count) - mean) * model.values).squaredNorm());
    out.sizes_m.push_back(std::sqrt(squares));
    at += count;
  }
  out.models = std::move(models);
  return out;
}

}  // namespace turnscan::placement
