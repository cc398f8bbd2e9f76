#include <Eigen/LU>
#include <algorithm>
#include <turnscan/core/figure_text.hpp>
#include <turnscan/turntable/detection/detect.hpp>
#include <turnscan/turntable/detection/platter_refinement.hpp>

namespace turnscan::detection {

namespace {

constexpr int kMaxPlanes = 14;
constexpr std::size_t kMinPixels = 150;
constexpr std::size_t kMaxRefined = 3;
constexpr double kMinWorth = 0.35;  // relative to the best candidate

Vec3d middle_of(const ScanPixels& scan, const std::vector<std::int32_t>& pixels) {
  Vec3d sum = Vec3d::Zero();
  for (const std::int32_t i : pixels) sum += scan.point[std::size_t(i)].cast<double>();
  return sum / double(pixels.size());
}

/// The plane's pixels well inside the circle.
std::vector<std::int32_t> inside(const PlaneView& view, const RimCircle& circle) {
  std::vector<std::int32_t> out;
  for (std::size_t i = 0; i < view.in.size(); ++i) {
    if (!view.in[i]) continue;
    const auto q = view.frame.to_plane(view.scan.point[i].cast<double>());
    if ((q - circle.center).norm() < 0.97 * circle.radius_m)
      out.push_back(static_cast<std::int32_t>(i));
  }
  return out;
}

class PlatterDetector {
 public:
  PlatterDetector(const AveragedScan& scan, const DetectOptions& options)
      : camera_(scan.intrinsics), rays_(camera_), pixels_(pixels_of(scan)), options_(options) {}

  Result<DetectedPlatter> run(const RunContext& context) {
    const auto planes = find_planes(pixels_, rays_, kMaxPlanes, kMinPixels, context);
    context.begin_phase("look for the platter", planes.size());
    for (std::size_t i = 0; i < planes.size(); ++i) {
      TURNSCAN_TRY(context.check());
      examine(planes[i], i, context);
      context.advance();
    }
    refine_best(context);
    TURNSCAN_TRY(context.check());
    return choose(planes.size());
  }

 private:
  /// Adds the plane's platter to the candidates, if it has a round rim. The rim determines the
  /// platter's pixels, and these give the plane that contains the rim.
  void examine(const FoundPlane& found, std::uint64_t seed, const RunContext& context) {
    Plane plane = found.plane;
    for (int round = 0; round < 3; ++round) {
      const PlaneView view = view_of({pixels_, camera_, rays_}, plane, found.tolerance_m,
                                     middle_of(pixels_, found.pixels));
      if (context.cancelled()) return;
      const auto circle = circle_of(view, round > 0, seed);
      if (context.cancelled()) return;
      if (!circle && round == 0) return;
      if (!circle) break;
      const auto own = inside(view, *circle);
      const auto estimate = fit_plane(pixels_, rays_, own);
      if (!estimate || own.size() < kMinPixels) {
        if (round == 0) return;
        break;
      }
      keep(*estimate, *circle, view.frame.to_space(circle->center), support_of(view, *circle),
           own.size());
      plane = estimate->plane;
    }
    last_.tolerance_m = found.tolerance_m;
    candidates_.push_back(last_);
  }

  /// Refines only possible platters, since it is expensive. If the best ones are no platters, as
  /// half discs of clutter are, one with a lower worth before refinement may be.
  void refine_best(const RunContext& context) {
    std::stable_sort(candidates_.begin(), candidates_.end(),
                     [](const auto& l, const auto& r) { return worth(l) > worth(r); });
    if (candidates_.size() > kMaxRefined) candidates_.resize(kMaxRefined);
    std::vector<PlatterCandidate> refined;
    for (const PlatterCandidate& c : candidates_) {
      if (!refined.empty() && worth(c) < kMinWorth * worth(candidates_.front())) break;
      auto better = refine_platter({pixels_, camera_, rays_}, c, options_.radius_m, context);
      if (better) refined.push_back(std::move(*better));
    }
    if (refined.empty() && !candidates_.empty())
      unmeasured_m_ = candidates_.front().platter.radius_m;
    candidates_ = std::move(refined);
  }

  /// refined: last_ is an estimate of the same platter.
  std::optional<RimCircle> circle_of(const PlaneView& view, bool refined,
                                     std::uint64_t seed) const {
    const double low = options_.radius_m ? 0.8 * *options_.radius_m : options_.min_radius_m;
    const double high = options_.radius_m ? 1.25 * *options_.radius_m : options_.max_radius_m;
    auto ends = rim_points(view);
    if (refined) {
      const Eigen::Vector2d center = view.frame.to_plane(last_.platter.center_m);
      const Eigen::Vector2d to_sensor = view.frame.to_plane(Vec3d::Zero()) - center;
      drop_false_ends(center, to_sensor.normalized(), ends);
    }
    const auto best = best_of(view, find_circles(ends, low, high, options_.radius_m, seed));
    if (refined || (best && worth(support_of(view, *best)) > 0.5)) return best;
    // A filter may leave no clear end anywhere, but then the surface itself is round.
    auto circles = find_circles(part_ends(view), low, high, options_.radius_m, seed);
    if (best) circles.push_back(*best);
    return best_of(view, circles);
  }

  static std::optional<RimCircle> best_of(const PlaneView& view,
                                          const std::vector<RimCircle>& circles) {
    std::optional<RimCircle> best;
    double best_worth = 0.0;
    for (const RimCircle& circle : circles) {
      const double value = worth(support_of(view, circle));
      if (best && value <= best_worth) continue;
      best = circle;
      best_worth = value;
    }
    return best;
  }

  /// Stores the result; its centre is where the ray through the rim's centre meets the refined
  /// plane.
  void keep(const PlaneEstimate& estimate, const RimCircle& circle, const Vec3d& center,
            const DiscSupport& support, std::size_t count) {
    DetectedPlatter p;
    p.axis = estimate.plane.normal;
    p.center_m = center * (estimate.plane.offset / estimate.plane.normal.dot(center));
    p.radius_m = circle.radius_m;
    p.plane_rms_m = estimate.rms_m;
    p.rim_rms_m = circle.rms_m;
    p.rim_share = support.rim_share;
    p.confidence = support.agreement * support.filled;
    p.plane_pixels = count;
    p.rim_points = circle.points;
    p.center_sigma_m = std::sqrt(circle.center_covariance.trace());
    p.radius_sigma_m = circle.radius_sigma_m;
    // m = normal / offset: changes perpendicular to its direction rotate the plane.
    const Vec3d n = estimate.plane.normal;
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - n * n.transpose();
    const double d = std::abs(estimate.plane.offset);
    p.axis_sigma_rad = d * std::sqrt((across * estimate.covariance * across).trace());
    p.height_sigma_m = d * std::sqrt(p.center_m.dot(estimate.covariance * p.center_m));
    last_ = {p, support};
  }

  static double worth(const DiscSupport& support) {
    return support.agreement * support.filled * std::min(1.0, support.rim_share / 0.5);
  }

  /// Worth of a candidate's disc: of two good ones the larger is the platter.
  static double worth(const PlatterCandidate& c) {
    return c.platter.confidence * std::min(1.0, c.platter.rim_share / 0.5);
  }

  Result<DetectedPlatter> choose(std::size_t planes) const {
    if (planes == 0)
      return fail(ErrorCode::kMissingData,
                  "platter: no plane is seen; move the sensor so that it sees the platter, or give "
                  "points on its rim with --points");
    const PlatterCandidate* best = nullptr;
    for (const PlatterCandidate& c : candidates_) {
      if (best == nullptr || worth(c) > worth(*best)) best = &c;
    }
    if (best == nullptr && unmeasured_m_)
      return fail(ErrorCode::kMissingData,
                  "platter: too little of the best disc (radius {}) and its rim is seen to measure "
                  "it; move the sensor nearer or higher, or give points with --points",
                  length_text(*unmeasured_m_));
    if (best == nullptr)
      return fail(ErrorCode::kMissingData,
                  "platter: none of the {} planes seen has a round rim; make room around the "
                  "platter, or give points on its rim with --points",
                  planes);
    TURNSCAN_TRY(check(*best));
    for (const PlatterCandidate& c : candidates_) {
      if (&c != best && check(c) && worth(c) > 0.7 * worth(*best) && apart(c, *best))
        return ambiguous(*best, c);
    }
    return best->platter;
  }

  Result<> check(const PlatterCandidate& c) const {
    const DetectedPlatter& p = c.platter;
    if (!(p.rim_share >= options_.min_rim_share))
      return fail(ErrorCode::kMissingData,
                  "platter: only {:.0f} % of the rim of the best disc (radius {}) is seen; move "
                  "what hides it, or give points with --points",
                  100.0 * p.rim_share, length_text(p.radius_m));
    if (!(c.support.agreement >= options_.min_agreement))
      return fail(ErrorCode::kMissingData,
                  "platter: the best disc (radius {}) is not round, only {:.0f} % of what is seen "
                  "beside its rim fits it; make room around the platter, or give points with "
                  "--points",
                  length_text(p.radius_m), 100.0 * c.support.agreement);
    if (!(p.confidence >= options_.min_confidence))
      return fail(ErrorCode::kMissingData,
                  "platter: the best disc (radius {}) is doubtful, confidence {:.2f}; make room "
                  "around the platter, or give points with --points",
                  length_text(p.radius_m), p.confidence);
    if (!(p.axis_sigma_rad < 0.01 && p.center_sigma_m < 0.003))
      return fail(ErrorCode::kMissingData,
                  "platter: the best disc (radius {}) is too coarse to measure, its centre is "
                  "uncertain by {}; move the sensor nearer or higher",
                  length_text(p.radius_m), length_text(p.center_sigma_m));
    return {};
  }

  static bool apart(const PlatterCandidate& a, const PlatterCandidate& b) {
    return (a.platter.center_m - b.platter.center_m).norm() >
           0.3 * std::max(a.platter.radius_m, b.platter.radius_m);
  }

  static Result<DetectedPlatter> ambiguous(const PlatterCandidate& a, const PlatterCandidate& b) {
    return fail(ErrorCode::kMissingData,
                "platter: two round surfaces are seen, of radius {} and {}; say which with "
                "--platter-radius",
                length_text(a.platter.radius_m), length_text(b.platter.radius_m));
  }

  CameraIntrinsics camera_;
  RayTable rays_;
  ScanPixels pixels_;
  const DetectOptions& options_;
  PlatterCandidate last_;
  std::vector<PlatterCandidate> candidates_;
  std::optional<double> unmeasured_m_;  ///< radius of the best one, if none can be measured
};

}  // namespace

}  // namespace turnscan::detection

namespace turnscan {

OptionTable describe(DetectOptions& o) {
  OptionTable table;
  table
      .number("platter-radius", o.radius_m, Quantity::kLength, {0.01, 10.0},
              "Radius of the platter; auto: found")
      .number("platter-min-radius", o.min_radius_m, Quantity::kLength, {0.01, 10.0},
              "Smallest radius of a platter that is looked for")
      .number("platter-max-radius", o.max_radius_m, Quantity::kLength, {0.01, 10.0},
              "Largest radius of a platter that is looked for")
      .number("platter-rim", o.min_rim_share, Quantity::kNone, {0.05, 1.0},
              "Share of the platter's rim that must be seen")
      .number("platter-confidence", o.min_confidence, Quantity::kNone, {0.0, 1.0},
              "Confidence below which a platter is refused");
  return table;
}

Result<DetectedPlatter> detect_platter(const AveragedScan& scan, const DetectOptions& options,
                                       const RunContext& context) {
  DetectOptions checked = options;
  TURNSCAN_TRY(describe(checked).check());
  if (options.min_radius_m > options.max_radius_m)
    return fail(ErrorCode::kInvalidOption,
                "platter-min-radius = {} is above platter-max-radius = {}",
                length_text(options.min_radius_m), length_text(options.max_radius_m));
  return detection::PlatterDetector(scan, options).run(context);
}

Calibration calibration_of(const DetectedPlatter& platter, const AveragedScan& scan) {
  Calibration out;
  out.method = CalibrationMethod::kDetected;
  out.table.axis = platter.axis;
  out.table.center_m = platter.center_m;
  out.table.radius_m = platter.radius_m;
  out.axis_sigma_rad = platter.axis_sigma_rad;
  out.center_sigma_m = platter.center_sigma_m;
  out.height_sigma_m = platter.height_sigma_m;
  out.radius_sigma_m = platter.radius_sigma_m;
  out.residual_rms_m = platter.plane_rms_m;
  out.rim_share = platter.rim_share;
  out.confidence = platter.confidence;
  const std::string frames =
      scan.frames == 1 ? "one frame" : fmt::format("the mean of {} frames", scan.frames);
  out.axis_found = out.height_found =
      fmt::format("normal of the platter's surface, {} pixels of {}", platter.plane_pixels, frames);
  out.center_found = out.radius_found =
      fmt::format("the platter's rim, {} places, {:.0f} % of it seen", platter.rim_points,
                  100.0 * platter.rim_share);
  return out;
}

}  // namespace turnscan
