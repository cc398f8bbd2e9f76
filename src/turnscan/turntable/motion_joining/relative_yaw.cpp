#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/estimation/robust.hpp>
#include <turnscan/turntable/motion/motion_state.hpp>
#include <turnscan/turntable/motion_joining/relative_yaw.hpp>

namespace turnscan::motion {

namespace {

constexpr int kHeadings = 180;                          // number of yaws tried
constexpr std::size_t kCostSamples = 700;               // per yaw
constexpr double kMissingCost = 0.7;                    // of a point without a correspondence
constexpr double kSeparate = 20.0 * kRadiansPerDegree;  // yaws this far apart are different
constexpr double kAmbiguousRatio = 1.1;  // of costs, below which two yaws are equally good
/// Number of nearby samples that count as one, since they share their errors from frame to frame.
constexpr double kCorrelatedSamples = 30.0;
/// Minimum ratio of the normals' information about the rotation to the effect of their noise alone.
constexpr double kMinSignal = 2.0;

Vec3d point_of(const SurfaceSample& s) { return s.p.cast<double>(); }
Vec3d normal_of(const SurfaceSample& s) { return s.n.cast<double>(); }

class HeadingSearch {
 public:
  HeadingSearch(const SensorMotion& first, const SensorMotion& second)
      : first_(first.model),
        second_(second.model),
        gate_(std::max({0.004, 3.0 * std::max(first.noise_m, second.noise_m),
                        2.0 * std::max(first.spacing_m, second.spacing_m)})) {
    std::vector<Vec3f> points;
    for (const SurfaceSample& s : first_) points.push_back(s.p);
    tree_ = KdTree(points);
    // Without a platter both heights are those of the lowest points.
    heights_ = {0.0};
    if (!(first.platter && second.platter)) {
      for (int k = 1; k <= 6; ++k)
        for (const double sign : {1.0, -1.0}) heights_.push_back(sign * 0.005 * k);
    }
  }

  Result<RelativeYaw> run(const RunContext& context) {
    const auto candidates = ranked_headings();
    TURNSCAN_TRY(context.check());
    std::optional<RelativeYaw> best;
    double least = 1.0, next = 1.0;
    std::vector<RelativeYaw> tried;
    for (const Candidate& t : candidates) {
      const bool near = std::any_of(tried.begin(), tried.end(), [&](const RelativeYaw& h) {
        return apart(h, t.at) < kSeparate;
      });
      if (near || tried.size() >= 5) continue;
      tried.push_back(t.at);
      const auto fine = refined(t.at);
      if (!fine) continue;
      const double cost = cost_of(*fine, gate_);
      const bool same = best && apart(*best, *fine) < kSeparate;
      if (cost < least) {
        if (!same) next = least;
        least = cost;
        best = fine;
      } else if (!same) {
        next = std::min(next, cost);
      }
    }
    if (!best || least > 0.6)
      return fail(ErrorCode::kMissingData,
                  "the sensors see no part of the object in common; move them nearer in height, or "
                  "take a whole turn");
    best->determined = shows_turn() && least * kAmbiguousRatio < next;
    return *best;
  }

 private:
  struct Candidate {
    RelativeYaw at;
    double cost;
  };

  /// All yaws with their best height, best fit first.
  std::vector<Candidate> ranked_headings() const {
    std::vector<Candidate> out(kHeadings);
    parallel_for(out.size(), 1, [&](std::size_t k) {
      out[k].cost = 1.0;
      for (const double height : heights_) {
        RelativeYaw at;
        at.turn_rad = 360.0 / kHeadings * double(k) * kRadiansPerDegree;
        at.height_m = height;
        const double cost = cost_of(at, 3.0 * gate_);
        if (cost < out[k].cost) out[k] = {at, cost};
      }
    });
    std::stable_sort(out.begin(), out.end(),
                     [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
    return out;
  }

  static double apart(const RelativeYaw& a, const RelativeYaw& b) {
    return std::abs(std::remainder(a.turn_rad - b.turn_rad, kTurn));
  }

  /// Mean truncated squared distance of the second's points from the first's surface. Points that
  /// the first did not see have a fixed cost.
  double cost_of(const RelativeYaw& at, double gate) const {
    const Pose T = at.pose();
    const std::size_t n = std::min(kCostSamples, second_.size());
    double sum = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      const SurfaceSample& s = second_[k * second_.size() / n];
      const auto off = distance(T * point_of(s), T.linear() * normal_of(s), gate);
      sum += off ? std::min(1.0, std::pow(*off / gate, 2)) : kMissingCost;
    }
    return sum / double(n);
  }

  /// Distance from the plane of the nearest sample with a similar normal.
  std::optional<double> distance(const Vec3d& q, const Vec3d& n, double gate,
                                 const SurfaceSample** partner = nullptr) const {
    std::uint32_t index = 0;
    float squared = 0.0f;
    if (tree_.knn(q.cast<float>(), 1, &index, &squared) == 0 || squared > 4.0 * gate * gate)
      return std::nullopt;
    const SurfaceSample& there = first_[index];
    if (normal_of(there).dot(n) < 0.6) return std::nullopt;
    if (partner != nullptr) *partner = &there;
    return normal_of(there).dot(q - point_of(there));
  }

  /// Gauss-Newton steps over yaw and height; nullopt if there are hardly any correspondences.
  std::optional<RelativeYaw> refined(RelativeYaw at) const {
    double gate = 3.0 * gate_;
    for (int round = 0; round < 20; ++round) {
      const Pose T = at.pose();
      Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
      Eigen::Vector2d right = Eigen::Vector2d::Zero();
      std::vector<std::pair<Eigen::Vector2d, double>> rows;
      std::vector<float> sizes;
      for (const SurfaceSample& s : second_) {
        const SurfaceSample* there = nullptr;
        const Vec3d q = T * point_of(s);
        const auto off = distance(q, T.linear() * normal_of(s), gate, &there);
        if (!off || std::abs(*off) > gate) continue;
        const Vec3d m = normal_of(*there);
        rows.emplace_back(Eigen::Vector2d(m.dot(Vec3d::UnitY().cross(q)), m.y()), *off);
        sizes.push_back(float(std::abs(*off)));
      }
      if (rows.size() < 200 || rows.size() * 5 < second_.size()) return std::nullopt;
      const double scale = std::max(estimation::mad_sigma(sizes), 1e-6);
      double squares = 0.0;
      for (const auto& [a, r] : rows) {
        const double t = std::abs(r) / (kHuber * scale), w = t > 1.0 ? 1.0 / t : 1.0;
        normal += w * a * a.transpose();
        right -= w * r * a;
        squares += w * r * r;
      }
      // The lever of a round object is close to zero: its yaw stays fixed.
      normal(0, 0) += 1e-9 * double(rows.size());
      normal(1, 1) += 1e-6 * double(rows.size());
      const Eigen::Matrix2d inverse = normal.inverse();
      const Eigen::Vector2d step = inverse * right;
      if (!step.allFinite()) return std::nullopt;
      at.turn_rad += std::clamp(step[0], -0.1, 0.1);
      at.height_m += std::clamp(step[1], -0.01, 0.01);
      at.rms_m = std::sqrt(squares / double(rows.size()));
      at.turn_sigma_rad = scale * std::sqrt(kCorrelatedSamples * inverse(0, 0));
      at.height_sigma_m = scale * std::sqrt(kCorrelatedSamples * inverse(1, 1));
      gate = std::max(0.7 * gate, std::max(gate_, 4.0 * scale));
      if (round > 6 && std::abs(step[0]) < 1e-6 && std::abs(step[1]) < 1e-7) break;
    }
    at.turn_rad = std::remainder(at.turn_rad, kTurn);
    return at;
  }

  /// Whether normals constrain the rotation beyond their own noise.
  bool shows_turn() const {
    double signal = 0.0, noise = 0.0;
    for (const SurfaceSample& s : second_) {
      const Vec3d sweep = Vec3d::UnitY().cross(point_of(s));
      signal += std::pow(normal_of(s).dot(sweep), 2);
      noise += sweep.squaredNorm() * std::pow(double(s.normal_sigma), 2);
    }
    return signal > kMinSignal * noise;
  }

  const std::vector<SurfaceSample>& first_;
  const std::vector<SurfaceSample>& second_;
  double gate_;
  KdTree tree_;
  std::vector<double> heights_;
};

}  // namespace

Pose RelativeYaw::pose() const {
  Pose out = rotation_about_y(turn_rad);
  out.translation().y() = height_m;
  return out;
}

Result<RelativeYaw> find_relative_yaw(const SensorMotion& first, const SensorMotion& second,
                                      const RunContext& context) {
  if (first.model.size() < 200 || second.model.size() < 200)
    return fail(ErrorCode::kMissingData, "too little of the object is seen to compare two sensors");
  return HeadingSearch(first, second).run(context);
}

}  // namespace turnscan::motion
