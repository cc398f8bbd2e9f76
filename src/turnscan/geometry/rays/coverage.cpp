#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <turnscan/core/morton.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/rays/coverage.hpp>

namespace turnscan {

namespace {

constexpr std::size_t kGroup = 16;    // points traced together, as one packet
constexpr float kRayStart_m = 1e-6f;  // rounding of the origin must not count as an occluder
constexpr std::size_t kPointsPerTask = 4 * kGroup;

/// Positions of the points along a Morton curve: neighbours in the order are neighbours in space.
std::vector<std::uint32_t> order_in_space(std::span<const Vec3f> points) {
  Box box;
  for (const Vec3f& p : points)
    if (p.allFinite()) box.add(p.cast<double>());
  const Vec3d scale = 2097151.0 * box.size().cwiseMax(1e-12).cwiseInverse();
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) {
      keys[i] = {~std::uint64_t(0), i};
      continue;
    }
    const Vec3d q = (points[i].cast<double>() - box.min).cwiseProduct(scale);
    keys[i] = {morton_code(std::uint64_t(q.x()), std::uint64_t(q.y()), std::uint64_t(q.z())), i};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = keys[i].second;
  return order;
}

/// Order of views in which neighbours are far apart (golden ratio steps), so that a visible point
/// soon is seen enough.
std::vector<std::size_t> scattered(std::size_t n) {
  std::size_t step = std::max<std::size_t>(1, std::size_t(0.6180339887498949 * double(n)));
  while (std::gcd(step, n) != 1) ++step;
  std::vector<std::size_t> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = i * step % n;
  return order;
}

/// A view in the table frame.
struct TableView {
  const CoverageView* view;
  Pose T_sensor_table;
  Viewpoint viewpoint;

  explicit TableView(const CoverageView& v)
      : view(&v),
        T_sensor_table(v.T_table_sensor.inverse()),
        viewpoint(v.viewpoint.transformed(v.T_table_sensor)) {}

  bool in_field_of_view(const Vec3d& p_table) const {
    if (!view->intrinsics) return true;
    const CameraIntrinsics& camera = *view->intrinsics;
    const Vec3d p = T_sensor_table * p_table;
    if (!(p.z() > 0.0)) return false;
    const Eigen::Vector2d uv = camera.project(p);
    return uv.x() >= -0.5 && uv.y() >= -0.5 && uv.x() < camera.width - 0.5 &&
           uv.y() < camera.height - 0.5;
  }
};

class ViewSums {
 public:
  ViewSums(const Scene& scene, std::vector<TableView> views, std::span<const Vec3f> points,
           std::span<const Vec3f> normals, const CoverageOptions& options)
      : scene_(scene),
        views_(std::move(views)),
        points_(points),
        normals_(normals),
        options_(options),
        least_cosine_(std::cos(options.max_incidence_rad)) {}

  /// Adds the views of up to kGroup neighbouring points.
  void add(std::span<const std::uint32_t> group, std::span<float> sums) const {
    std::array<Ray, kGroup> rays;
    std::array<std::uint32_t, kGroup> who{};
    std::array<std::uint8_t, kGroup> blocked{};
    std::array<float, kGroup> worth{};
    for (const TableView& view : views_) {
      std::size_t n = 0;
      bool all_done = true;
      for (const std::uint32_t i : group) {
        if (done(sums[i])) continue;
        all_done = false;
        const double cosine = faces(view, i, rays[n]);
        if (cosine > 0.0) worth[n] = float(cosine * cosine), who[n++] = i;
      }
      if (all_done) return;
      scene_.occluded(std::span(rays).first(n), std::span(blocked).first(n), RayOrder::kCoherent);
      for (std::size_t k = 0; k < n; ++k) sums[who[k]] += blocked[k] ? 0.0f : worth[k];
    }
  }

 private:
  bool done(float sum) const { return options_.enough > 0.0 && double(sum) >= options_.enough; }

  /// Cosine of incidence if only an occluder can prevent the view from seeing the point, else 0;
  /// ray: towards it.
  double faces(const TableView& view, std::uint32_t i, Ray& ray) const {
    const Vec3d p = points_[i].cast<double>(), normal = normals_[i].cast<double>();
    const Vec3d to_sensor = view.viewpoint.direction_from(p);
    const double cosine = normal.dot(to_sensor);
    if (!(cosine > least_cosine_) || !view.in_field_of_view(p)) return 0.0;
    const Vec3d start = p + options_.offset_m * normal;
    const bool parallel = view.viewpoint.parallel;
    const Vec3d way = parallel ? to_sensor : Vec3d(view.viewpoint.value - start);
    ray.origin = start.cast<float>();
    ray.direction = way.cast<float>();
    ray.t_min = kRayStart_m / std::max(float(way.norm()), kRayStart_m);
    ray.t_max = parallel ? std::numeric_limits<float>::infinity() : 1.0f;
    return cosine;
  }

  const Scene& scene_;
  std::vector<TableView> views_;
  std::span<const Vec3f> points_, normals_;
  CoverageOptions options_;
  double least_cosine_;
};

Result<Pose> pose_of(const FrameInfo& frame, const FrameInfo& first, const SequenceHeader& header) {
  if (frame.T_table_sensor) return *frame.T_table_sensor;
  const auto& T = header.sensors[frame.sensor].T_table_sensor;
  if (!T)
    return fail(ErrorCode::kMissingData,
                "frame {}: neither it nor its sensor has a pose; calibrate the recording",
                frame.index);
  double angle = frame.angle_rad.value_or(std::numeric_limits<double>::quiet_NaN());
  if (!frame.angle_rad && header.turntable && header.turntable->speed_rad_s)
    angle = *header.turntable->speed_rad_s * (frame.time_s - first.time_s);
  if (!std::isfinite(angle))
    return fail(ErrorCode::kMissingData,
                "frame {}: it has no angle, nor a time and the turntable a speed", frame.index);
  return rotation_about_y(-angle) * *T;
}

}  // namespace

Result<std::vector<float>> view_information(const Scene& scene, std::span<const CoverageView> views,
                                            std::span<const Vec3f> points,
                                            std::span<const Vec3f> normals,
                                            const CoverageOptions& options,
                                            const RunContext& context) {
  if (points.size() != normals.size())
    throw std::invalid_argument("view_information: points and normals differ in number");
  std::vector<float> sums(points.size(), 0.0f);
  if (views.empty() || points.empty()) return sums;
  std::vector<TableView> table_views;
  table_views.reserve(views.size());
  for (const std::size_t i : scattered(views.size())) table_views.emplace_back(views[i]);
  const ViewSums view_sums(scene, std::move(table_views), points, normals, options);
  const std::vector<std::uint32_t> order = order_in_space(points);
  context.begin_phase("coverage", points.size());
  parallel_for((order.size() + kPointsPerTask - 1) / kPointsPerTask, 1, [&](std::size_t chunk) {
    const std::size_t end = std::min(order.size(), (chunk + 1) * kPointsPerTask);
    for (std::size_t i = chunk * kPointsPerTask; i < end && !context.cancelled(); i += kGroup)
      view_sums.add(std::span(order).subspan(i, std::min(kGroup, end - i)), sums);
    context.advance(end - chunk * kPointsPerTask);
  });
  TURNSCAN_TRY(context.check());
  return sums;
}

CoverageView view_of(const SensorInfo& sensor, const Pose& T_table_sensor) {
  CoverageView view{T_table_sensor, std::nullopt, sensor.viewpoint};
  if (sensor.kind == SensorKind::kDepthCamera) view.intrinsics = sensor.intrinsics;
  return view;
}

Result<std::vector<CoverageView>> views_of(const FrameSequence& sequence) {
  const SequenceHeader& header = sequence.header();
  std::vector<CoverageView> views;
  for (const FrameInfo& frame : sequence.frames()) {
    if (frame.status == FrameStatus::kDropped) continue;
    if (frame.sensor >= header.sensors.size())
      return fail(ErrorCode::kFormat, "frame {}: there is no sensor {}", frame.index, frame.sensor);
    TURNSCAN_ASSIGN(const Pose pose, pose_of(frame, sequence.frames().front(), header));
    views.push_back(view_of(header.sensors[frame.sensor], pose));
  }
  return views;
}

Result<std::vector<std::uint8_t>> seen_mask(const Scene& scene, const FrameSequence& sequence,
                                            std::span<const Vec3f> points,
                                            std::span<const Vec3f> normals,
                                            const RunContext& context) {
  TURNSCAN_ASSIGN(const std::vector<CoverageView> views, views_of(sequence));
  TURNSCAN_ASSIGN(const std::vector<float> sums,
                  view_information(scene, views, points, normals, {}, context));
  std::vector<std::uint8_t> seen(sums.size());
  std::transform(sums.begin(), sums.end(), seen.begin(),
                 [](float sum) { return std::uint8_t(sum >= kSeenInformation ? 1 : 0); });
  return seen;
}

}  // namespace turnscan
