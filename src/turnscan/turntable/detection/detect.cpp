#include <Eigen/LU>
#include <algorithm>
#include <turnscan/turntable/detection/detect.hpp>
#include <turnscan/turntable/detection/rim_estimate.hpp>
#include <turnscan/turntable/detection/rim_fit.hpp>

namespace turnscan::detection {

namespace {

constexpr int kMostPlanes = 14;
constexpr std::size_t kLeastPixels = 150;
constexpr std::size_t kMostRefined = 3;
constexpr double kHeightFloor_m = 1e-5;  // no residual shows how true a sensor's depth is
constexpr double kRoundness = 4e-4;      // of the radius: by how much no platter is rounder

struct PlatterCandidate {
  DetectedPlatter platter;
  DiscSupport support;
  double tolerance_m = 0.0;  ///< of its plane
};

std::string mm(double metres) { return format_quantity(metres, Quantity::kLength); }

std::vector<std::uint8_t> mask_of(const ScanPixels& scan, const Plane& plane, double tolerance) {
  std::vector<std::uint8_t> in(scan.point.size(), 0);
  for (std::size_t i = 0; i < in.size(); ++i) {
    if (scan.still[i] && std::abs(plane.height(scan.point[i].cast<double>())) < tolerance)
      in[i] = 1;
  }
  return in;
}

Vec3d middle_of(const ScanPixels& scan, const std::vector<std::int32_t>& pixels) {
  Vec3d sum = Vec3d::Zero();
  for (const std::int32_t i : pixels) sum += scan.point[std::size_t(i)].cast<double>();
  return sum / double(pixels.size());
}

/// The pixels of the plane well inside the circle.
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

/// Whether all pixels about one lie in the plane, too: at an edge a filter mixes what it joins.
bool amid_plane(const PlaneView& view, int x, int y, int reach) {
  if (x < reach || y < reach || x + reach >= view.scan.width || y + reach >= view.scan.height)
    return false;
  for (int v = y - reach; v <= y + reach; ++v) {
    for (int u = x - reach; u <= x + reach; ++u)
      if (!view.in[std::size_t(v) * std::size_t(view.scan.width) + std::size_t(u)]) return false;
  }
  return true;
}

/// The pixels of the platter's surface that no edge can have changed.
std::vector<std::int32_t> undisturbed(const PlaneView& view, const RimModel& model, int blur_px) {
  const RimView rays(view.camera, view.plane, view.frame);
  std::vector<std::int32_t> out;
  for (int y = 0; y < view.scan.height; ++y) {
    for (int x = 0; x < view.scan.width; ++x) {
      const int i = y * view.scan.width + x;
      if (!view.in[std::size_t(i)]) continue;
      const auto within = rays.disc_px(model, x, y);
      if (within && *within > 1.5 + blur_px && amid_plane(view, x, y, 1 + blur_px))
        out.push_back(i);
    }
  }
  return out;
}

/// A filter over neighbours favours the brighter, which are the nearer ones: by about the change of
/// depth from pixel to pixel, times that change's share of the depth. Along the normal.
double filter_bias(const Plane& plane, const Vec3d& at, const CameraIntrinsics& camera,
                   int blur_px) {
  const double facing = -plane.normal.dot(at) / at.norm();
  const double slant =
      at.z() / std::min(camera.fx, camera.fy) * std::sqrt(1.0 - facing * facing) / facing;
  return blur_px * slant * slant / at.z() * facing;
}

class PlatterDetector {
 public:
  PlatterDetector(const AveragedScan& scan, const DetectOptions& options)
      : camera_(scan.intrinsics), rays_(camera_), pixels_(pixels_of(scan)), options_(options) {}

  Result<DetectedPlatter> run(const RunContext& context) {
    const auto planes = find_planes(pixels_, rays_, kMostPlanes, kLeastPixels);
    context.begin_phase("look for the platter", planes.size());
    for (std::size_t i = 0; i < planes.size(); ++i) {
      TURNSCAN_TRY(context.check());
      examine(planes[i], i);
      context.advance();
    }
    refine_best();
    return choose(planes.size());
  }

 private:
  /// Adds the plane's platter to the candidates, if it has a round rim. The rim says which pixels
  /// are the platter's, and these give the plane that the rim lies in.
  void examine(const FoundPlane& found, std::uint64_t seed) {
    Plane plane = found.plane;
    for (int round = 0; round < 3; ++round) {
      const PlaneView view = view_of(plane, found.tolerance_m, middle_of(pixels_, found.pixels));
      const auto circle = circle_of(view, round > 0, seed);
      if (!circle) return;
      const auto own = inside(view, *circle);
      const auto estimate = fit_plane(pixels_, rays_, own);
      if (!estimate || own.size() < kLeastPixels) return;
      keep(*estimate, *circle, view.frame.to_space(circle->center), support_of(view, *circle),
           own.size());
      plane = estimate->plane;
    }
    last_.tolerance_m = found.tolerance_m;
    candidates_.push_back(last_);
  }

  PlaneView view_of(const Plane& plane, double tolerance_m, const Vec3d& origin) const {
    return {pixels_,
            camera_,
            rays_,
            plane,
            tolerance_m,
            PlaneFrame(plane, origin),
            mask_of(pixels_, plane, tolerance_m)};
  }

  /// Only what may be the platter: it costs time.
  void refine_best() {
    std::stable_sort(candidates_.begin(), candidates_.end(),
                     [](const auto& l, const auto& r) { return worth(l) > worth(r); });
    if (candidates_.size() > kMostRefined) candidates_.resize(kMostRefined);
    for (PlatterCandidate& c : candidates_) {
      last_ = c;
      refine(c.tolerance_m);
      c = last_;
    }
  }

  /// From the rough plane and circle of last_ to their best estimates.
  void refine(double tolerance_m) {
    NoiseCorrelation noise;
    RimModel model{Eigen::Vector2d::Zero(), last_.platter.radius_m, 0.0};
    Plane plane{last_.platter.axis, last_.platter.axis.dot(last_.platter.center_m)};
    Vec3d center = last_.platter.center_m;
    for (int round = 0; round < 2; ++round) {
      const PlaneView view = view_of(plane, tolerance_m, center);
      model.center.setZero();
      const auto own = undisturbed(view, model, noise.blur_px);
      const auto estimate = fit_plane(pixels_, rays_, own);
      if (!estimate || own.size() < kLeastPixels) return;
      noise = correlation_of(pixels_, rays_, estimate->plane, own);
      plane = estimate->plane;
      center *= plane.offset / plane.normal.dot(center);
      const PlaneView better = view_of(plane, tolerance_m, center);
      const auto rim = estimate_rim(better, model, noise, options_.radius_m);
      if (!rim) return;
      model = rim->model;
      center = better.frame.to_space(model.center);
      if (round == 1) keep_refined(*estimate, *rim, noise, center);
      if (round == 1) keep_support(view_of(plane, tolerance_m, center));
    }
  }

  void keep_support(const PlaneView& view) {
    RimCircle circle;
    circle.radius_m = last_.platter.radius_m;
    last_.support = support_of(view, circle);
    last_.platter.rim_share = last_.support.rim_share;
    last_.platter.confidence = last_.support.agreement * last_.support.filled;
  }

  void keep_refined(const PlaneEstimate& estimate, const RimEstimate& rim,
                    const NoiseCorrelation& noise, const Vec3d& center) {
    DetectedPlatter& p = last_.platter;
    p.axis = estimate.plane.normal;
    p.center_m = center;
    p.radius_m = rim.model.radius_m;
    const Vec3d n = p.axis;
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - n * n.transpose();
    const Eigen::Matrix3d covariance = noise.pixels_per_sample * estimate.covariance;
    const double d = std::abs(estimate.plane.offset);
    p.axis_sigma_rad = d * std::sqrt((across * covariance * across).trace());
    p.height_sigma_m = std::hypot(d * std::sqrt(center.dot(covariance * center)), kHeightFloor_m,
                                  filter_bias(estimate.plane, center, camera_, noise.blur_px));
    // The rim is seen in a direction: where the plane is higher, it is nearer.
    const double lean = (across * center).norm() / std::abs(n.dot(center));
    p.center_sigma_m =
        std::sqrt(rim.covariance.topLeftCorner<2, 2>().trace() +
                  std::pow(lean * p.height_sigma_m, 2) + std::pow(kRoundness * p.radius_m, 2));
    p.radius_sigma_m = std::hypot(std::sqrt(rim.covariance(2, 2)), kRoundness * p.radius_m);
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
    return find_circle(ends, low, high, options_.radius_m, seed);
  }

  /// Where the ray through the rim's centre meets the refined plane.
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
    // m = normal / offset: what moves it across its direction turns the plane.
    const Vec3d n = estimate.plane.normal;
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - n * n.transpose();
    const double d = std::abs(estimate.plane.offset);
    p.axis_sigma_rad = d * std::sqrt((across * estimate.covariance * across).trace());
    p.height_sigma_m = d * std::sqrt(p.center_m.dot(estimate.covariance * p.center_m));
    last_ = {p, support};
  }

  /// How much a candidate's disc counts: of two good ones the larger is the platter.
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
                  100.0 * p.rim_share, mm(p.radius_m));
    if (!(p.confidence >= options_.min_confidence))
      return fail(ErrorCode::kMissingData,
                  "platter: the best disc (radius {}) is doubtful, confidence {:.2f}; make room "
                  "around the platter, or give points with --points",
                  mm(p.radius_m), p.confidence);
    if (!(p.axis_sigma_rad < 0.01 && p.center_sigma_m < 0.003))
      return fail(ErrorCode::kMissingData,
                  "platter: the best disc (radius {}) is too coarse to measure, its centre is "
                  "uncertain by {}; move the sensor nearer or higher",
                  mm(p.radius_m), mm(p.center_sigma_m));
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
                mm(a.platter.radius_m), mm(b.platter.radius_m));
  }

  CameraIntrinsics camera_;
  RayTable rays_;
  ScanPixels pixels_;
  const DetectOptions& options_;
  PlatterCandidate last_;
  std::vector<PlatterCandidate> candidates_;
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
                detection::mm(options.min_radius_m), detection::mm(options.max_radius_m));
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
