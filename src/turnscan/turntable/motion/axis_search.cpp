#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/turntable/motion/axis.hpp>
#include <turnscan/turntable/motion/axis_search.hpp>

namespace turnscan::motion {

namespace {

// Views that are compared: close enough to overlap, far enough apart to determine the axis.
constexpr double kMinApart = 8.0 * kRadiansPerDegree, kBestApart = 35.0 * kRadiansPerDegree;
constexpr std::size_t kMaxPairs = 12, kMaxQueries = 32, kMaxSurfacePoints = 600;
/// Search range in mean widths from the middle of the visible scene, with four steps per width.
constexpr int kPlaces = 6;
constexpr double kStep = 0.5;
constexpr double kSameNormal = 0.6;  ///< minimum cosine between normals of one surface

/// A thinned surface of a frame, one point every few millimetres.
struct CoarseSurface {
  std::vector<Vec3f> normals;
  KdTree tree;
  std::vector<Vec3f> points;
};

struct ComparedPair {
  std::size_t to;  ///< index in the surfaces
  double turn_rad;
  std::vector<SurfaceSample> samples;
};

class AxisSearch {
 public:
  AxisSearch(const MotionData& data, const std::vector<double>& angle_rad)
      : data_(data), angle_(angle_rad) {
    choose_pairs();
    find_directions();
  }

  Result<std::vector<AxisTrial>> run(std::size_t most, const RunContext& context) const {
    std::vector<AxisTrial> trials;
    for (const double sign : {1.0, -1.0})
      for (const Vec3d& axis : axes_) add_places(axis, sign, trials);
    TURNSCAN_TRY(parallel_for(trials.size(), 16, context,
                              [&](std::size_t i) { trials[i].cost = cost_of(trials[i]); }));
    std::stable_sort(trials.begin(), trials.end(),
                     [](const AxisTrial& a, const AxisTrial& b) { return a.cost < b.cost; });
    return far_apart(trials, most);
  }

 private:
  void choose_pairs() {
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (const std::size_t from : data_.keys) {
      const std::size_t to = partner_of(from);
      if (to != from) pairs.emplace_back(from, to);
    }
    pairs = evenly_spread(pairs, kMaxPairs);
    surfaces_.resize(pairs.size());
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const auto [from, to] = pairs[k];
      for (const SurfaceSample& s : evenly_spread(data_.frames[to].samples, kMaxSurfacePoints)) {
        surfaces_[k].points.push_back(s.p);
        surfaces_[k].normals.push_back(s.n);
      }
      surfaces_[k].tree = KdTree(surfaces_[k].points);
      pairs_.push_back(
          {k, angle_[to] - angle_[from], evenly_spread(data_.frames[from].samples, kMaxQueries)});
    }
  }

  /// The frame whose view is closest to kBestApart from that of `from`; `from` itself if there is
  /// none.
  std::size_t partner_of(std::size_t from) const {
    std::size_t best = from;
    double least = kTurn;
    for (const std::size_t to : data_.keys) {
      const double apart = std::abs(std::remainder(angle_[to] - angle_[from], kTurn));
      if (data_.frames[to].pass != data_.frames[from].pass || apart < kMinApart) continue;
      if (data_.frames[to].samples.empty() || data_.frames[from].samples.empty()) continue;
      const double off = std::abs(apart - kBestApart);
      if (off < least) best = to, least = off;
    }
    return best;
  }

  /// Candidate axes: upright, for clouds with y or z upright, tilted towards the scanner or away
  /// from it, and slightly sideways. A scanner sees surfaces that face it, so most normals point
  /// along its viewing direction.
  void find_directions() {
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const CoarseSurface& surface : surfaces_)
      for (const Vec3f& n : surface.normals)
        spread += n.cast<double>() * n.cast<double>().transpose();
    const Vec3d normal = estimation::symmetric_eigen(spread).vectors.col(2);
    for (const Vec3d& up : {Vec3d(Vec3d::UnitY()), Vec3d(Vec3d::UnitZ())}) add_tilted(up, normal);
  }

  void add_tilted(const Vec3d& up, const Vec3d& normal) {
    Vec3d view = normal - normal.dot(up) * up;
    view = view.norm() > 0.05 ? Vec3d(view.normalized()) : tangent_basis(up).first;
    const Vec3d right = up.cross(view);
    for (const double tilt : {0.0, 20.0, -20.0, 40.0, -40.0, 60.0, -60.0}) {
      for (const double roll : {0.0, 15.0, -15.0}) {
        if (roll != 0.0 && std::abs(tilt) > 50.0) continue;
        axes_.emplace_back(Eigen::AngleAxisd(roll * kRadiansPerDegree, view) *
                           (Eigen::AngleAxisd(tilt * kRadiansPerDegree, right) * up));
      }
    }
  }

  void add_places(const Vec3d& axis, double sign, std::vector<AxisTrial>& trials) const {
    const Vec3d side = axis.unitOrthogonal(), other = axis.cross(side);
    const double step = kStep * width();
    for (int i = -kPlaces; i <= kPlaces; ++i) {
      for (int k = -kPlaces; k <= kPlaces; ++k) {
        AxisTrial trial;
        trial.state.axis = axis;
        trial.state.center = data_.middle + step * (i * side + k * other);
        trial.sign = sign;
        trials.push_back(std::move(trial));
      }
    }
  }

  /// About half the radius of the visible scene.
  double width() const { return 0.25 * data_.extent_m; }

  /// Point-to-plane distances relative to the motion of a point by one step of position and
  /// direction; points without a neighbour of similar normal have the cost of the maximum distance.
  double cost_of(const AxisTrial& trial) const {
    double sum = 0.0, count = 0.0;
    for (const ComparedPair& pair : pairs_) {
      const CoarseSurface& surface = surfaces_[pair.to];
      const double turn = trial.sign * pair.turn_rad;
      const Eigen::Matrix3d R = Eigen::AngleAxisd(turn, trial.state.axis).toRotationMatrix();
      const double gate =
          std::max(kStep * width() * std::abs(2.0 * std::sin(0.5 * turn)), 3.0 * data_.spacing_m);
      for (const SurfaceSample& sample : pair.samples) {
        const Vec3d q = trial.state.center + R * (sample.p.cast<double>() - trial.state.center);
        const Vec3d m = R * sample.n.cast<double>();
        std::uint32_t index = 0;
        float squared = 0.0f;
        count += 1.0;
        sum += 1.0;
        if (surface.tree.knn(q.cast<float>(), 1, &index, &squared, float(2.0 * gate)) == 0)
          continue;
        const Vec3d n = surface.normals[index].cast<double>();
        if (std::abs(n.dot(m)) < kSameNormal) continue;
        const double off = n.dot(q - surface.points[index].cast<double>()) / gate;
        sum -= std::max(0.0, 1.0 - off * off);
      }
    }
    return count > 0.0 ? sum / count : 1.0;
  }

  /// Removes neighbours of a better trial, which lead to the same solution.
  std::vector<AxisTrial> far_apart(const std::vector<AxisTrial>& trials, std::size_t most) const {
    std::vector<AxisTrial> out;
    for (const AxisTrial& trial : trials) {
      if (out.size() >= most) break;
      const bool same = std::any_of(out.begin(), out.end(), [&](const AxisTrial& kept) {
        return kept.sign == trial.sign &&
               kept.state.axis.dot(trial.state.axis) > std::cos(25.0 * kRadiansPerDegree) &&
               (kept.state.center - trial.state.center).norm() < 2.5 * kStep * width();
      });
      if (!same) out.push_back(trial);
    }
    return out;
  }

  const MotionData& data_;
  const std::vector<double>& angle_;
  std::vector<CoarseSurface> surfaces_;
  std::vector<ComparedPair> pairs_;
  std::vector<Vec3d> axes_;
};

}  // namespace

Result<std::vector<AxisTrial>> search_axes(const MotionData& data,
                                           const std::vector<double>& angle_rad, std::size_t most,
                                           const RunContext& context) {
  return AxisSearch(data, angle_rad).run(most, context);
}

}  // namespace turnscan::motion
