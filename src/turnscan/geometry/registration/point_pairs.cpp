#include <turnscan/geometry/registration/point_pairs.hpp>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace turnscan {

namespace {

constexpr std::size_t kMinPointPairs = 3;

/// Points as columns, about their mean.
struct Centred {
  Vec3d mean;
  Eigen::Matrix3Xd points;
};

Centred centre(std::span<const PointPair> pairs, Vec3d PointPair::*side) {
  Centred out;
  out.points.resize(3, Eigen::Index(pairs.size()));
  for (std::size_t i = 0; i < pairs.size(); ++i) out.points.col(Eigen::Index(i)) = pairs[i].*side;
  out.mean = out.points.rowwise().mean();
  out.points.colwise() -= out.mean;
  return out;
}

Result<> check_spread(const Eigen::Matrix3Xd& points, double min_spread_m) {
  if (!points.allFinite())
    return fail(ErrorCode::kInvalidOption, "point pairs: a point is not finite");
  const Eigen::Matrix3d scatter = points * points.transpose() / double(points.cols());
  const Vec3d spread = scatter.jacobiSvd().singularValues().cwiseSqrt();
  // Written such that coincident points fail even without a limit.
  if (!(spread[0] > min_spread_m))
    return fail(ErrorCode::kTooFewPoints,
                "point pairs: the points lie too near to each other; choose places farther apart");
  if (!(spread[1] > std::max(min_spread_m, 1e-6 * spread[0])))
    return fail(ErrorCode::kTooFewPoints,
                "point pairs: the points lie almost on one straight line, about which anything "
                "may turn; choose one beside it");
  return {};
}

/// Umeyama (40), (43) without scale.
Eigen::Matrix3d rotation_of(const Eigen::Matrix3d& covariance) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vec3d sign = Vec3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) sign.z() = -1.0;
  return svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
}

}  // namespace

Result<PairFit> fit_point_pairs(std::span<const PointPair> pairs, const PairLimits& limits) {
  if (pairs.size() < kMinPointPairs)
    return fail(ErrorCode::kTooFewPoints, "point pairs: {} of at least {}", pairs.size(),
                kMinPointPairs);
  const Centred source = centre(pairs, &PointPair::source);
  const Centred target = centre(pairs, &PointPair::target);
  TURNSCAN_TRY(check_spread(source.points, limits.min_spread_m));
  TURNSCAN_TRY(check_spread(target.points, limits.min_spread_m));
  PairFit out;
  out.T_target_source.linear() = rotation_of(target.points * source.points.transpose());
  out.T_target_source.translation() = target.mean - out.T_target_source.linear() * source.mean;
  double sum = 0.0;
  for (const PointPair& pair : pairs) {
    const double residual = (out.T_target_source * pair.source - pair.target).norm();
    out.residuals_m.push_back(residual);
    sum += residual * residual;
  }
  out.rms_m = std::sqrt(sum / double(pairs.size()));
  const auto worst = std::max_element(out.residuals_m.begin(), out.residuals_m.end());
  if (*worst > limits.max_residual_m)
    return fail(ErrorCode::kInvalidOption,
                "point pairs: pair {} lies {:.1f} mm apart where the others are brought together; "
                "choose the same place on both",
                worst - out.residuals_m.begin() + 1, *worst * 1e3);
  return out;
}

}  // namespace turnscan
