#include <Eigen/LU>
#include <algorithm>
#include <map>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/geometry/estimation/robust.hpp>
#include <turnscan/turntable/depth/gauge_ball.hpp>
#include <turnscan/turntable/detection/plane_fit.hpp>

namespace turnscan {

namespace {

using detection::ScanPixels;

constexpr Range kDiameter{0.02, 1.0};
constexpr double kMinCosine = 0.42;  // 65 degrees
constexpr double kFree = 0.6;        // minimum share of the expected pixels of the ball
constexpr double kHuber = 2.0;
constexpr std::size_t kMinPixels = 60;
constexpr int kRounds = 12;
constexpr double kSystematic_m = 3e-5;  // difference of depth between perpendicular and grazing
                                        // incidence
constexpr int kBlock = 4;               // side in pixels, over which errors may be correlated

struct Ball {
  Vec3d center = Vec3d::Zero();
  double offset_m = 0.0;
};

struct BallPixels {
  std::vector<std::int32_t> pixels;  ///< on the ball, within the tolerance
  std::size_t expected = 0;          ///< pixels that an unoccluded ball would show
  double share() const { return expected > 0 ? double(pixels.size()) / double(expected) : 0.0; }
};

struct BallFit {
  Ball ball;
  double sigma_m = 0.0, rms_m = 0.0;
  BallPixels visible;
};

class BallFinder {
 public:
  BallFinder(const AveragedScan& scan, double radius_m)
      : scan_(scan),
        rays_(scan.intrinsics),
        pixels_(detection::pixels_of(scan)),
        radius_(radius_m),
        noise_(std::max(pixels_.noise_m, 1e-5)) {}

  Result<BallFit> run(const RunContext& context) {
    const auto starts = candidates();
    std::optional<BallFit> best, second;
    for (const Ball& start : starts) {
      TURNSCAN_TRY(context.check());
      auto fit = refine(start);
      if (!fit) continue;
      if (best && (fit->ball.center - best->ball.center).norm() < radius_) {
        if (fit->rms_m < best->rms_m) best = std::move(fit);
        continue;
      }
      if (best) second = std::move(best);
      best = std::move(fit);
    }
    if (!best)
      return fail(ErrorCode::kMissingData,
                  "gauge: no ball of {} is seen freely; put it where the sensor sees most of its "
                  "front, and check --gauge-ball",
                  format_quantity(2.0 * radius_, Quantity::kLength));
    if (second)
      return fail(ErrorCode::kMissingData,
                  "gauge: two balls of that size are seen; leave one in front of the sensor");
    return std::move(*best);
  }

 private:
  Vec3d ray(std::size_t i) const { return {rays_.x()[i], rays_.y()[i], 1.0}; }

  /// Radius of the ball in pixels at a distance.
  double reach(double z) const { return radius_ * scan_.intrinsics.fx / z; }

  /// Plane through a pixel's window, in inverse depth; oriented towards the sensor.
  std::optional<Vec3d> normal_at(int x, int y, int half) const {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    Vec3d right = Vec3d::Zero();
    int count = 0;
    const float here = pixels_.point[at(x, y)].z();
    for (int v = y - half; v <= y + half; ++v) {
      for (int u = x - half; u <= x + half; ++u) {
        const Vec3f& p = pixels_.point[at(u, v)];
        if (!(p.z() > 0.0f) || std::abs(double(p.z()) - here) > radius_) continue;
        // 1 = n . p is 1/z = n . ray.
        const Vec3d r = ray(at(u, v));
        sum += r * r.transpose();
        right += r / double(p.z());
        ++count;
      }
    }
    if (4 * count < 3 * (2 * half + 1) * (2 * half + 1)) return std::nullopt;
    const Vec3d n = estimation::solve_ldlt(sum, right);
    if (!n.allFinite() || !(n.norm() > 0.0)) return std::nullopt;
    return Vec3d(-n.normalized());
  }

  std::size_t at(int x, int y) const {
    return std::size_t(y) * std::size_t(pixels_.width) + std::size_t(x);
  }

  /// Possible centres, assuming a surface of the ball's curvature, from pixels all over the image;
  /// of nearby ones the one that most pixels agree with.
  std::vector<Ball> candidates() const {
    struct Vote {
      Ball ball;
      std::size_t count;
    };
    std::vector<Vote> votes;
    const double tolerance = std::max(0.06 * radius_, 3.0 * noise_);
    int y = 0;
    while (y < pixels_.height) {
      int step = 8;
      for (int x = 0; x < pixels_.width; x += step) {
        const Vec3f p = pixels_.point[at(x, y)];
        if (!(p.z() > 0.0f)) continue;
        const double size = reach(p.z());
        if (size < 4.0 || size > pixels_.width) continue;
        step = std::clamp(int(size / 4.0), 2, 8);
        const int half = std::clamp(int(size / 5.0), 1, 12);
        if (x < half || y < half || x + half >= pixels_.width || y + half >= pixels_.height)
          continue;
        const auto n = normal_at(x, y, half);
        if (!n || -n->dot(ray(at(x, y)).normalized()) < 0.5) continue;
        const Ball ball{p.cast<double>() - radius_ * *n, 0.0};
        const BallPixels visible = visible_pixels(ball, tolerance, 3);
        if (visible.pixels.size() * 9 < kMinPixels || visible.share() < 0.8 * kFree) continue;
        votes.push_back({ball, visible.pixels.size()});
      }
      y += 4;
    }
    std::stable_sort(votes.begin(), votes.end(),
                     [](const Vote& a, const Vote& b) { return a.count > b.count; });
    std::vector<Ball> out;
    for (const Vote& vote : votes) {
      const bool near = std::any_of(out.begin(), out.end(), [&](const Ball& b) {
        return (b.center - vote.ball.center).norm() < radius_;
      });
      if (!near && out.size() < 8) out.push_back(vote.ball);
    }
    return out;
  }

  /// Every stride-th column and row of the pixels that the ball covers, up to 65 degrees incidence.
  BallPixels visible_pixels(const Ball& ball, double tolerance, int stride) const {
    BallPixels out;
    const Vec3d& c = ball.center;
    if (!(c.z() > radius_)) return out;
    const Eigen::Vector2d middle = scan_.intrinsics.project(c);
    const double size = 1.1 * reach(c.z() - radius_);
    const int left = std::max(0, int(middle.x() - size)),
              right = std::min(pixels_.width - 1, int(middle.x() + size)),
              top = std::max(0, int(middle.y() - size)),
              bottom = std::min(pixels_.height - 1, int(middle.y() + size));
    for (int y = top; y <= bottom; y += stride) {
      for (int x = left; x <= right; x += stride) {
        const std::size_t i = at(x, y);
        if (!shows(ball, ray(i))) continue;
        ++out.expected;
        const double z = pixels_.point[i].z();
        if (!(z > 0.0) || !pixels_.still[i]) continue;
        const Vec3d p = ray(i) * (z + ball.offset_m);
        if (std::abs((p - c).norm() - radius_) < tolerance) out.pixels.push_back(std::int32_t(i));
      }
    }
    return out;
  }

  /// Whether the ray meets the ball at an incidence angle below 65 degrees.
  bool shows(const Ball& ball, const Vec3d& direction) const {
    const Vec3d d = direction.normalized();
    const double along = d.dot(ball.center);
    const double aside2 = ball.center.squaredNorm() - along * along;
    const double most2 = radius_ * radius_ * (1.0 - kMinCosine * kMinCosine);
    return along > 0.0 && aside2 < most2;
  }

  std::optional<BallFit> refine(const Ball& start) const {
    BallFit fit{start, 0.0, 0.0, {}};
    double tolerance = std::max(0.12 * radius_, 4.0 * noise_);
    for (int round = 0; round < kRounds; ++round) {
      fit.visible = visible_pixels(fit.ball, tolerance, 1);
      if (fit.visible.pixels.size() < kMinPixels || fit.visible.share() < kFree)
        return std::nullopt;
      if (!step(fit)) return std::nullopt;
      if (std::abs(fit.ball.offset_m) > 0.3 * fit.ball.center.z()) return std::nullopt;
      tolerance = std::max(std::min(tolerance, 5.0 * fit.rms_m), 3.0 * noise_);
    }
    // A surface that is not a ball deviates more than noise explains.
    if (fit.rms_m > std::max(2.0 * noise_, 0.02 * radius_)) return std::nullopt;
    return fit;
  }

  /// One pixel's equation. Unknowns: centre, offset.
  struct PixelRow {
    Eigen::Vector4d a;
    double d;          ///< distance from the ball along its normal, metres
    double sigma;      ///< of d, in standard deviations of depth
    double obliquity;  ///< squared sine of the angle of incidence
    std::int32_t pixel;
  };

  /// nullopt if the ray does not meet the ball.
  std::optional<PixelRow> row_of(const Ball& ball, std::int32_t pixel) const {
    const Vec3d r = ray(std::size_t(pixel));
    const double z = pixels_.point[std::size_t(pixel)].z();
    // Where the ray meets the ball: noise along the ray affects neither that point nor its normal.
    const Vec3d& c = ball.center;
    const double rr = r.squaredNorm(), along = r.dot(c);
    const double root = along * along - rr * (c.squaredNorm() - radius_ * radius_);
    if (!(root > 0.0)) return std::nullopt;
    const double hit = (along - std::sqrt(root)) / rr;
    const Vec3d u = (r * hit - c) / radius_;
    PixelRow row;
    row.a << -u, u.dot(r);
    row.d = u.dot(r) * (z + ball.offset_m - hit);
    const double cosine = u.dot(r.normalized());
    row.obliquity = 1.0 - cosine * cosine;
    // Noise is along the ray; a tenth of it remains for rays tangential to the surface.
    row.sigma = std::sqrt(cosine * cosine + 0.01);
    row.pixel = pixel;
    return row;
  }

  /// One Gauss-Newton step over centre and offset.
  bool step(BallFit& fit) const {
    std::vector<PixelRow> rows;
    std::vector<float> sizes;
    double squares = 0.0;
    for (const std::int32_t i : fit.visible.pixels) {
      const auto row = row_of(fit.ball, i);
      if (!row) continue;
      sizes.push_back(float(std::abs(row->d) / row->sigma));
      squares += row->d * row->d;
      rows.push_back(*row);
    }
    const double scale = std::max(estimation::mad_sigma(sizes), 1e-7);
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero(), systematic = Eigen::Vector4d::Zero();
    for (const PixelRow& row : rows) {
      const double t = std::abs(row.d) / (row.sigma * scale);
      const double w = (t > kHuber ? kHuber / t : 1.0) / std::pow(row.sigma * scale, 2);
      normal += w * row.a * row.a.transpose();
      right -= w * row.d * row.a;
      systematic += w * row.obliquity * row.a;
    }
    const Eigen::LDLT<Eigen::Matrix4d> factors(normal);
    const Eigen::Vector4d moved = factors.solve(right);
    if (!moved.allFinite()) return false;
    fit.ball.center += moved.head<3>();
    fit.ball.offset_m += moved[3];
    fit.rms_m = std::sqrt(squares / double(rows.size()));
    fit.sigma_m =
        std::sqrt(excess_variance(rows, scale) * factors.solve(Eigen::Vector4d::UnitW())[3]);
    // Systematic errors that grow with the obliquity, as at silhouettes.
    fit.sigma_m = std::hypot(fit.sigma_m, kSystematic_m * factors.solve(systematic)[3]);
    return true;
  }

  /// Errors shared by a block of pixels accumulate instead of averaging out: their effect as a
  /// factor of the variance.
  double excess_variance(const std::vector<PixelRow>& rows, double scale) const {
    struct Block {
      double sum = 0.0, count = 0.0;
    };
    std::map<std::pair<int, int>, Block> blocks;
    for (const PixelRow& row : rows) {
      Block& block =
          blocks[{row.pixel % pixels_.width / kBlock, row.pixel / pixels_.width / kBlock}];
      block.sum += std::clamp(row.d / (row.sigma * scale), -kHuber, kHuber);
      block.count += 1.0;
    }
    double shared = 0.0, alone = 0.0;
    for (const auto& [place, block] : blocks) {
      shared += block.sum * block.sum;
      alone += block.count;
    }
    return std::max(1.0, shared / alone);
  }

  const AveragedScan& scan_;
  RayTable rays_;
  ScanPixels pixels_;
  double radius_, noise_;
};

}  // namespace

OptionTable describe(BallOptions& o) {
  OptionTable table;
  table.number("gauge-ball", o.diameter_m, Quantity::kLength, kDiameter,
               "Diameter of a ball that stands still in front of the sensor, for --depth-bias");
  return table;
}

Result<BallGauge> gauge_depth_with_ball(const AveragedScan& scan, double diameter_m,
                                        double recorded_m, const RunContext& context) {
  if (!(diameter_m >= kDiameter.min && diameter_m <= kDiameter.max))
    return fail(ErrorCode::kInvalidOption, "gauge-ball: the diameter {} m is not within {} to {} m",
                diameter_m, kDiameter.min, kDiameter.max);
  TURNSCAN_TRY(context.check());
  TURNSCAN_ASSIGN(const BallFit fit, BallFinder(scan, 0.5 * diameter_m).run(context));
  BallGauge out;
  out.center_m = fit.ball.center;
  out.rms_m = fit.rms_m;
  out.pixels = fit.visible.pixels.size();
  out.gauge.offset_m = recorded_m + fit.ball.offset_m;
  out.gauge.depth_m = fit.ball.center.z() - out.gauge.offset_m;
  out.gauge.sigma_m = fit.sigma_m;
  return out;
}

}  // namespace turnscan
