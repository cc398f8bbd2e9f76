#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <turnscan/simulator/sample_kernel.hpp>
#include <turnscan/simulator/samples.hpp>
#include <turnscan/simulator/scene_impl.hpp>

namespace turnscan {

using sampling::BodyView;
using sampling::Frame;

namespace {

constexpr double kNearest_m = 1e-3;  // a corner nearer than this may be anywhere in the image
constexpr double kRight = std::numbers::pi / 2;

constexpr std::array<std::string_view, kMissCount> kMissNames{
    "none",        "nothing",         "too-near",         "too-far",
    "out-of-view", "emitter-blocked", "receiver-blocked", "grazing",
    "too-dark",    "rejected"};

/// Outside of it no pixel sees anything of the box; it has a border of a pixel.
PixelRect rect_of(const CameraIntrinsics& camera, const Box& box, const Pose& T_sensor_box) {
  const PixelRect all{0, 0, camera.width, camera.height};
  if (box.empty()) return {};
  Eigen::Vector2d low(1e300, 1e300), high(-1e300, -1e300);
  int behind = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d p((corner & 1 ? box.max : box.min).x(), (corner & 2 ? box.max : box.min).y(),
                  (corner & 4 ? box.max : box.min).z());
    const Vec3d q = T_sensor_box * p;
    if (q.z() < kNearest_m) {
      ++behind;
      continue;
    }
    low = low.cwiseMin(camera.project(q));
    high = high.cwiseMax(camera.project(q));
  }
  if (behind == 8) return {};
  // Distortion may bulge between the corners.
  if (behind > 0 || camera.distorted()) return all;
  const auto pixel = [](double v, int size) {
    return static_cast<int>(std::clamp(v, 0.0, double(size)));
  };
  return {
      pixel(std::floor(low.x()) - 1, camera.width), pixel(std::floor(low.y()) - 1, camera.height),
      pixel(std::ceil(high.x()) + 2, camera.width), pixel(std::ceil(high.y()) + 2, camera.height)};
}

PixelRect united(const PixelRect& a, const PixelRect& b) {
  if (a.width() == 0 || a.height() == 0) return b;
  if (b.width() == 0 || b.height() == 0) return a;
  return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right),
          std::max(a.bottom, b.bottom)};
}

void copy(const Vec3d& from, float* to) {
  for (int k = 0; k < 3; ++k) to[k] = static_cast<float>(from[k]);
}

BodyView view_of(const Body& body, std::size_t position, const ScannerModel& model,
                 const Pose& T_world_sensor) {
  if (body.scene == nullptr) throw std::invalid_argument("SampleTracer: a body has no scene");
  const Pose T = body.T_world_body.inverse() * T_world_sensor;
  BodyView view;
  view.scene = body.scene->impl().scene.get();
  view.objects = body.scene->impl().objects.data();
  view.platter_radius_squared = body.scene->impl().platter_radius_squared;
  view.id = static_cast<std::uint32_t>(position << sampling::kObjectBits);
  for (int i = 0; i < 9; ++i) view.rotation[i] = static_cast<float>(T.linear()(i / 3, i % 3));
  copy(T.translation(), view.origin);
  copy(T * model.other_eye_m(), view.other);
  const PixelRect rect = rect_of(model.camera, body.scene->box(), T.inverse());
  view.frame = {rect.left, rect.top, rect.right, rect.bottom};
  return view;
}

/// The bodies as one pose sees them, in a form for the kernels.
struct Views {
  std::vector<BodyView> bodies;
  sampling::View view;

  Views(std::span<const Body> all, const ScannerModel& model, const Pose& T_world_sensor) {
    if (all.size() > kMaxBodies) throw std::invalid_argument("SampleTracer: too many bodies");
    bodies.reserve(all.size());
    for (std::size_t b = 0; b < all.size(); ++b) {
      bodies.push_back(view_of(all[b], b, model, T_world_sensor));
      for (const float x : bodies.back().origin) view.size = std::max(view.size, std::abs(x));
    }
    view.bodies = bodies.data();
    view.body_count = static_cast<int>(bodies.size());
    view.two_eyed = model.two_eyed();
    copy(model.other_eye_m(), view.other);
    view.blocked =
        int(model.kind == ScannerKind::kLine ? Miss::kReceiverBlocked : Miss::kEmitterBlocked);
    view.near_m = static_cast<float>(model.near_m);
    view.far_m = static_cast<float>(model.far_m);
    // At a right angle nothing is too flat, whatever the rounding.
    view.least_cosine = model.max_incidence_rad < kRight
                            ? static_cast<float>(std::cos(model.max_incidence_rad))
                            : 0.0f;
  }
};

/// Depth of the nearest corner of what the body holds.
double nearest_of(const Body& body, const Pose& T_world_sensor) {
  const Pose T = T_world_sensor.inverse() * body.T_world_body;
  const Box box = body.scene->box();
  double nearest = 1e300;
  for (int corner = 0; corner < 8; ++corner)
    nearest = std::min(nearest, (T * Vec3d((corner & 1 ? box.max : box.min).x(),
                                           (corner & 2 ? box.max : box.min).y(),
                                           (corner & 4 ? box.max : box.min).z()))
                                    .z());
  return nearest;
}

/// Whether the frame ends at the border of the image on the side of the other eye: the body may go
/// on beyond it.
bool cut_off(const Frame& frame, const sampling::View& view, const CameraIntrinsics& camera) {
  if (view.baseline_along_rows)
    return view.baseline > 0.0f ? frame.right >= camera.width : frame.left <= 0;
  return view.baseline > 0.0f ? frame.bottom >= camera.height : frame.top <= 0;
}

void set_baseline(std::span<const Body> bodies, const ScannerModel& model,
                  const Pose& T_world_sensor, sampling::View& view) {
  const Vec3d& eye = model.other_eye_m();
  const CameraIntrinsics& camera = model.camera;
  const bool rows = eye.x() != 0.0;
  if (eye.z() != 0.0 || (rows && eye.y() != 0.0) || camera.distorted()) return;
  view.baseline_along_rows = rows;
  view.baseline = static_cast<float>(rows ? eye.x() : eye.y());
  view.pixel = static_cast<float>(1.0 / (rows ? camera.fx : camera.fy));
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (bodies[b].scene->box().empty() || !cut_off(view.bodies[b].frame, view, camera)) continue;
    const double nearest = std::max(nearest_of(bodies[b], T_world_sensor), 1e-6);
    view.border_nearness = std::max(view.border_nearness, static_cast<float>(1.0 / nearest));
  }
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
  OcclusionMethod occlusion;
  int tile_width;           ///< of a packet: a square, or as near to it as the image allows
  std::vector<float> x, y;  ///< per column and row, or with distortion per pixel
  sampling::Directions directions;

  Impl(const ScannerModel& m, OcclusionMethod o)
      : model(m), occlusion(o), tile_width(m.camera.width >= 3 ? 4 : m.camera.width) {
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
};

SampleTracer::SampleTracer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SampleTracer::SampleTracer(SampleTracer&&) noexcept = default;
SampleTracer& SampleTracer::operator=(SampleTracer&&) noexcept = default;
SampleTracer::~SampleTracer() = default;

Result<SampleTracer> SampleTracer::create(const ScannerModel& model, OcclusionMethod occlusion) {
  TURNSCAN_TRY(model.check());
  return SampleTracer(std::make_unique<Impl>(model, occlusion));
}

const ScannerModel& SampleTracer::model() const { return impl_->model; }

Vec3d SampleTracer::direction(double u, double v) const { return impl_->model.camera.ray(u, v); }

void SampleTracer::trace(std::span<const Body> bodies, const Pose& T_world_sensor,
                         SampleGrid& out) const {
  Views views(bodies, impl_->model, T_world_sensor);
  if (impl_->occlusion == OcclusionMethod::kDoubtful && impl_->model.kind == ScannerKind::kMatrix)
    set_baseline(bodies, impl_->model, T_world_sensor, views.view);
  out.width = impl_->model.camera.width;
  out.height = impl_->model.camera.height;
  out.rect = {};
  for (const BodyView& body : views.bodies)
    out.rect =
        united(out.rect, {body.frame.left, body.frame.top, body.frame.right, body.frame.bottom});
  out.resize(std::size_t(out.rect.width()) * std::size_t(out.rect.height()));
  const Frame frame{out.rect.left, out.rect.top, out.rect.right, out.rect.bottom};
  sampling::kernel().trace_image(views.view, impl_->directions, frame, impl_->tile_width,
                                 output_of(out));
}

void SampleTracer::trace(std::span<const Body> bodies, const Pose& T_world_sensor,
                         std::span<const float> x, std::span<const float> y, Samples& out) const {
  if (x.size() != y.size()) throw std::invalid_argument("SampleTracer::trace: sizes differ");
  const Views views(bodies, impl_->model, T_world_sensor);
  out.resize(x.size());
  sampling::kernel().trace_list(views.view, x.data(), y.data(), x.size(), output_of(out));
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
