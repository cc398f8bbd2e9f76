#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <turnscan/simulator/sample_packet.hpp>
#include <turnscan/simulator/samples.hpp>

namespace turnscan {

using sampling::BodyView;
using sampling::kLanes;
using sampling::Packet;
using sampling::View;

namespace {

constexpr double kNearest_m = 1e-3;  // a corner nearer than this may be anywhere in the image
constexpr double kRight = std::numbers::pi / 2;

constexpr std::array<std::string_view, kMissCount> kMissNames{
    "none",        "nothing",         "too-near",         "too-far",
    "out-of-view", "emitter-blocked", "receiver-blocked", "grazing",
    "too-dark",    "rejected"};

/// Pixels of a packet: a square, or as near to it as the image's width allows.
struct Tile {
  int width = 4, height = 4;
  explicit Tile(int image_width)
      : width(image_width >= 3 ? 4 : image_width), height(kLanes / width) {}
};

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

bool overlap(const PixelRect& a, const PixelRect& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

void copy(const Vec3d& from, float* to) {
  for (int k = 0; k < 3; ++k) to[k] = static_cast<float>(from[k]);
}

BodyView view_of(const Body& body, std::size_t position, const ScannerModel& model,
                 const Pose& T_world_sensor) {
  if (body.scene == nullptr) throw std::invalid_argument("SampleTracer: a body has no scene");
  const Pose T = body.T_world_body.inverse() * T_world_sensor;
  BodyView view;
  view.scene = &body.scene->impl();
  view.id = static_cast<std::uint32_t>(position << 24);
  for (int i = 0; i < 9; ++i) view.rotation[i] = static_cast<float>(T.linear()(i / 3, i % 3));
  copy(T.translation(), view.origin);
  copy(T * model.other_eye_m(), view.other);
  view.size = static_cast<float>(T.translation().cwiseAbs().maxCoeff());
  view.rect = rect_of(model.camera, body.scene->box(), T.inverse());
  return view;
}

View view_of(std::span<const Body> bodies, const ScannerModel& model, const Pose& T_world_sensor) {
  if (bodies.size() > kMaxBodies) throw std::invalid_argument("SampleTracer: too many bodies");
  View view;
  copy(model.other_eye_m(), view.other);
  view.one_way = !model.two_eyed();
  view.blocked =
      int(model.kind == ScannerKind::kLine ? Miss::kReceiverBlocked : Miss::kEmitterBlocked);
  view.near_m = static_cast<float>(model.near_m);
  view.far_m = static_cast<float>(model.far_m);
  // At a right angle nothing is too flat, whatever the rounding.
  view.least_cosine = model.max_incidence_rad < kRight
                          ? static_cast<float>(std::cos(model.max_incidence_rad))
                          : 0.0f;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    view.bodies.push_back(view_of(bodies[b], b, model, T_world_sensor));
    view.size = std::max(view.size, view.bodies.back().size);
  }
  return view;
}

RTCIntersectContext coherent() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

void store(const Packet& p, int lane, std::size_t at, int count, Samples& out) {
  for (int i = 0; i < count; ++i) {
    out.z[at + i] = p.z[lane + i];
    out.surface[at + i] = p.surface[lane + i];
    out.triangle[at + i] = p.triangle[lane + i];
    out.miss[at + i] = static_cast<Miss>(p.miss[lane + i]);
  }
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
  Tile tile;
  bool separable;           ///< x depends on the column alone, y on the row alone
  std::vector<float> x, y;  ///< directions, per column and row or per pixel

  explicit Impl(const ScannerModel& m)
      : model(m), tile(m.camera.width), separable(!m.camera.distorted()) {
    const CameraIntrinsics& camera = m.camera;
    if (!separable) {
      const RayTable table(camera);
      x = table.x();
      y = table.y();
      return;
    }
    for (int u = 0; u < camera.width; ++u) x.push_back(static_cast<float>(camera.ray(u, 0).x()));
    for (int v = 0; v < camera.height; ++v) y.push_back(static_cast<float>(camera.ray(0, v).y()));
  }

  /// Lanes beyond the rect repeat its last column or row.
  void load(int left, int top, const PixelRect& rect, Packet& p) const {
    for (int i = 0; i < kLanes; ++i) {
      const int u = std::min(left + i % tile.width, rect.right - 1);
      const int v = std::min(top + i / tile.width, rect.bottom - 1);
      const std::size_t pixel = std::size_t(v) * std::size_t(model.camera.width) + std::size_t(u);
      p.x[i] = x[separable ? std::size_t(u) : pixel];
      p.y[i] = y[separable ? std::size_t(v) : pixel];
    }
  }

  void trace_tile(const View& view, int left, int top, RTCIntersectContext& context,
                  std::vector<std::uint32_t>& bodies, SampleGrid& out) const {
    const PixelRect here{left, top, std::min(left + tile.width, out.rect.right),
                         std::min(top + tile.height, out.rect.bottom)};
    bodies.clear();
    for (std::uint32_t b = 0; b < view.bodies.size(); ++b)
      if (overlap(view.bodies[b].rect, here)) bodies.push_back(b);
    Packet packet;
    load(left, top, out.rect, packet);
    sampling::trace(view, bodies, context, packet);
    for (int v = here.top; v < here.bottom; ++v)
      store(packet, (v - top) * tile.width, out.index(left, v), here.width(), out);
  }
};

SampleTracer::SampleTracer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SampleTracer::SampleTracer(SampleTracer&&) noexcept = default;
SampleTracer& SampleTracer::operator=(SampleTracer&&) noexcept = default;
SampleTracer::~SampleTracer() = default;

Result<SampleTracer> SampleTracer::create(const ScannerModel& model) {
  TURNSCAN_TRY(model.check());
  return SampleTracer(std::make_unique<Impl>(model));
}

const ScannerModel& SampleTracer::model() const { return impl_->model; }

Vec3d SampleTracer::direction(double u, double v) const { return impl_->model.camera.ray(u, v); }

void SampleTracer::trace(std::span<const Body> bodies, const Pose& T_world_sensor,
                         SampleGrid& out) const {
  const View view = view_of(bodies, impl_->model, T_world_sensor);
  out.width = impl_->model.camera.width;
  out.height = impl_->model.camera.height;
  out.rect = {};
  for (const BodyView& body : view.bodies) out.rect = united(out.rect, body.rect);
  out.resize(std::size_t(out.rect.width()) * std::size_t(out.rect.height()));
  RTCIntersectContext context = coherent();
  std::vector<std::uint32_t> near_tile;
  for (int top = out.rect.top; top < out.rect.bottom; top += impl_->tile.height)
    for (int left = out.rect.left; left < out.rect.right; left += impl_->tile.width)
      impl_->trace_tile(view, left, top, context, near_tile, out);
}

void SampleTracer::trace(std::span<const Body> bodies, const Pose& T_world_sensor,
                         std::span<const float> x, std::span<const float> y, Samples& out) const {
  if (x.size() != y.size()) throw std::invalid_argument("SampleTracer::trace: sizes differ");
  const View view = view_of(bodies, impl_->model, T_world_sensor);
  out.resize(x.size());
  RTCIntersectContext context = coherent();
  std::vector<std::uint32_t> all(view.bodies.size());
  for (std::uint32_t b = 0; b < all.size(); ++b) all[b] = b;
  for (std::size_t at = 0; at < x.size(); at += kLanes) {
    const int count = static_cast<int>(std::min<std::size_t>(kLanes, x.size() - at));
    Packet packet;
    for (int i = 0; i < kLanes; ++i) {
      packet.x[i] = x[at + std::size_t(std::min(i, count - 1))];
      packet.y[i] = y[at + std::size_t(std::min(i, count - 1))];
    }
    sampling::trace(view, all, context, packet);
    store(packet, 0, at, count, out);
  }
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
