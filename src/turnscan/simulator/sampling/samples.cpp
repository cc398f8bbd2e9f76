#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <turnscan/geometry/rays/scene_impl.hpp>
#include <turnscan/simulator/sampling/pose_views.hpp>
#include <turnscan/simulator/sampling/sample_kernel.hpp>
#include <turnscan/simulator/sampling/samples.hpp>

namespace turnscan {

using sampling::BodyView;
using sampling::PoseViews;
using sampling::Window;

namespace {

constexpr std::array<std::string_view, kMissCount> kMissNames{
    "none",        "nothing",         "too-near",         "too-far",
    "out-of-view", "emitter-blocked", "receiver-blocked", "grazing",
    "too-dark",    "rejected"};

/// Memory for drawing that is reused for the next image.
struct Sheet {
  std::vector<float> nearness, tiles;
  std::vector<std::uint32_t> slot, order;
  std::vector<sampling::GroupView> seen;

  sampling::Canvas canvas(const Window& frame, int groups) {
    const auto width = static_cast<std::size_t>(frame.right - frame.left);
    const auto height = static_cast<std::size_t>(frame.bottom - frame.top);
    constexpr std::size_t kTile = sampling::kTile, kMore = sampling::kLanes;
    grow(nearness, width * height + kMore);
    grow(slot, width * height + kMore);
    grow(tiles, ((width + kTile - 1) / kTile) * ((height + kTile - 1) / kTile) + kMore);
    grow(seen, static_cast<std::size_t>(groups));
    grow(order, static_cast<std::size_t>(groups));
    return {frame, nearness.data(), slot.data(), tiles.data(), seen.data(), order.data()};
  }

 private:
  template <class T>
  static void grow(std::vector<T>& v, std::size_t size) {
    if (v.size() < size) v.resize(size);
  }
};

/// The cost of drawing is per triangle, that of rays per pixel: drawing pays up to this ratio
/// (measured, docs/research/performance.md).
constexpr double kTrianglesPerPixel = 30.0;
constexpr std::uint64_t kMaxSlots = 0xffffff00u;

bool worth_drawing(std::span<const Body> bodies, const PixelRect& rect) {
  double triangles = 0.0;
  for (const Body& body : bodies) triangles += double(body.scene->impl().triangle_count());
  return triangles <= kTrianglesPerPixel * double(rect.width()) * double(rect.height());
}

bool slots_suffice(std::span<const Body> bodies) {
  std::uint64_t slots = 0;
  for (const Body& body : bodies) slots += body.scene->impl().triangle_count() + sampling::kLanes;
  return slots < kMaxSlots;
}

sampling::Output output_of(Samples& samples) {
  static_assert(sizeof(Miss) == 1);
  return {samples.z.data(), samples.surface.data(), samples.triangle.data(),
          reinterpret_cast<std::uint8_t*>(samples.miss.data())};
}

}  // namespace

std::string_view name_of(Miss miss) { return kMissNames.at(static_cast<std::size_t>(miss)); }

void Samples::resize(std::size_t n) {
  z.resize(n);
  surface.resize(n);
  triangle.resize(n);
  miss.resize(n);
}

struct SampleTracer::Impl {
  ScannerModel model;
  TraceMethods methods;
  int tile_width;           ///< of a packet: a square, or as close to it as the image allows
  std::vector<float> x, y;  ///< per column and row, or with distortion per pixel
  sampling::Directions directions;
  mutable std::mutex mutex;
  mutable std::vector<std::unique_ptr<Sheet>> spare;  ///< guarded by mutex

  Impl(const ScannerModel& m, const TraceMethods& how)
      : model(m), methods(how), tile_width(m.camera.width >= 3 ? 4 : m.camera.width) {
    const CameraIntrinsics& camera = m.camera;
    if (camera.distorted()) {
      const RayTable table(camera);
      x = table.x();
      y = table.y();
      directions = {x.data(), y.data(), camera.width, camera.width, 1};
      return;
    }
    for (int u = 0; u < camera.width; ++u) x.push_back(static_cast<float>(camera.ray(u, 0).x()));
    for (int v = 0; v < camera.height; ++v) y.push_back(static_cast<float>(camera.ray(0, v).y()));
    directions = {x.data(), y.data(), 0, 1, 0};
  }

  bool draws(std::span<const Body> bodies, const PixelRect& rect) const {
    // For a single column rays are as fast.
    if (methods.hits == HitMethod::kCheapest && model.kind == ScannerKind::kLine) return false;
    if (methods.hits == HitMethod::kRays || model.camera.distorted() || !slots_suffice(bodies))
      return false;
    return methods.hits == HitMethod::kDrawn || worth_drawing(bodies, rect);
  }

  void draw(std::span<const Body> bodies, PoseViews& views, const Window& frame, const Window& wide,
            const sampling::Output& out) const {
    int groups = 0;
    std::uint32_t first = 0;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      BodyView& body = views.bodies[b];
      body.clusters = bodies[b].scene->impl().raster().view();
      body.first_slot = first;
      const int count = body.clusters.levels[0].count;
      first += static_cast<std::uint32_t>(count) * sampling::kLanes;
      groups = std::max(groups, count);
    }
    views.view.fx = static_cast<float>(model.camera.fx);
    views.view.fy = static_cast<float>(model.camera.fy);
    views.view.cx = static_cast<float>(model.camera.cx);
    views.view.cy = static_cast<float>(model.camera.cy);
    std::unique_ptr<Sheet> sheet = take_sheet();
    sampling::SampleKernels::current().draw_image(views.view, directions, frame,
                                                  sheet->canvas(wide, groups), out);
    const std::lock_guard lock(mutex);
    spare.push_back(std::move(sheet));
  }

  std::unique_ptr<Sheet> take_sheet() const {
    const std::lock_guard lock(mutex);
    if (spare.empty()) return std::make_unique<Sheet>();
    auto sheet = std::move(spare.back());
    spare.pop_back();
    return sheet;
  }
};

SampleTracer::SampleTracer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SampleTracer::SampleTracer(SampleTracer&&) noexcept = default;
SampleTracer& SampleTracer::operator=(SampleTracer&&) noexcept = default;
SampleTracer::~SampleTracer() = default;

Result<SampleTracer> SampleTracer::create(const ScannerModel& model, const TraceMethods& methods) {
  TURNSCAN_TRY(model.check());
  return SampleTracer(std::make_unique<Impl>(model, methods));
}

const ScannerModel& SampleTracer::model() const { return impl_->model; }

Vec3d SampleTracer::direction(double u, double v) const { return impl_->model.camera.ray(u, v); }

void SampleTracer::trace(std::span<const Body> bodies, const Pose& T_world_sensor,
                         SampleGrid& out) const {
  PoseViews views(bodies, impl_->model, T_world_sensor);
  const CameraIntrinsics& camera = impl_->model.camera;
  out.width = camera.width;
  out.height = camera.height;
  out.rect = {};
  for (const BodyView& body : views.bodies)
    out.rect = sampling::united(
        out.rect, {body.frame.left, body.frame.top, body.frame.right, body.frame.bottom});
  out.resize(std::size_t(out.rect.width()) * std::size_t(out.rect.height()));
  if (out.size() == 0) return;
  const bool draw = impl_->draws(bodies, out.rect);
  PixelRect wide;
  if (impl_->methods.occlusion == OcclusionMethod::kDoubtful &&
      sampling::baseline_along_image(impl_->model))
    wide = sampling::set_baseline(bodies, impl_->model, T_world_sensor, draw, views.view);
  const Window frame{out.rect.left, out.rect.top, out.rect.right, out.rect.bottom};
  if (draw)
    impl_->draw(bodies, views, frame, sampling::canvas_frame(out.rect, wide, views.view),
                output_of(out));
  else
    sampling::SampleKernels::current().trace_image(views.view, impl_->directions, frame,
                                                   impl_->tile_width, output_of(out));
}

void SampleTracer::trace(std::span<const Body> bodies, const Pose& T_world_sensor,
                         std::span<const float> x, std::span<const float> y, Samples& out) const {
  if (x.size() != y.size()) throw std::invalid_argument("SampleTracer::trace: sizes differ");
  const PoseViews views(bodies, impl_->model, T_world_sensor);
  out.resize(x.size());
  sampling::SampleKernels::current().trace_list(views.view, x.data(), y.data(), x.size(),
                                                output_of(out));
}

SampleHit SampleTracer::hit_of(std::span<const Body> bodies, const Pose& T_world_sensor,
                               const Samples& samples, std::size_t i,
                               const Vec3d& direction) const {
  const Body& body = bodies[samples.body(i)];
  const Pose T = body.T_world_body.inverse() * T_world_sensor;
  const Vec3d o = T.translation(), d = T.linear() * direction;
  SampleHit hit;
  double t = 0.0;
  if (samples.object(i) == kPlatter) {
    hit.normal_body = Vec3d::UnitY();
    t = -o.y() / d.y();
  } else {
    const auto corners = body.scene->corners(samples.object(i), samples.triangle[i]);
    const Vec3d a = corners[0].cast<double>();
    const Vec3d ab = corners[1].cast<double>() - a, ac = corners[2].cast<double>() - a;
    const Vec3d n = ab.cross(ac);
    t = n.dot(a - o) / n.dot(d);
    if (!std::isfinite(t)) t = samples.z[i];
    const Vec3d ap = o + t * d - a;
    hit.u = ap.cross(ac).dot(n) / n.squaredNorm();
    hit.v = ab.cross(ap).dot(n) / n.squaredNorm();
    hit.normal_body = n.normalized();
  }
  hit.p_sensor = t * direction;
  hit.p_body = o + t * d;
  const auto incidence = [&](const Vec3d& way) {
    return std::acos(std::min(1.0, std::abs(hit.normal_body.dot(way.normalized()))));
  };
  hit.back = hit.normal_body.dot(d) > 0.0;
  hit.incidence_rad = incidence(d);
  hit.other_incidence_rad = incidence(hit.p_body - T * impl_->model.other_eye_m());
  return hit;
}

}  // namespace turnscan
