#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
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

/// Outside of it no pixel of `all` sees anything of the box; it has a border of a pixel. `all` if
/// a part of the box is behind the eye.
PixelRect rect_of(const CameraIntrinsics& camera, const PixelRect& all, const Box& box,
                  const Pose& T_sensor_box) {
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
  const auto pixel = [](double v, int first, int end) {
    return static_cast<int>(std::clamp(v, double(first), double(end)));
  };
  return {pixel(std::floor(low.x()) - 1, all.left, all.right),
          pixel(std::floor(low.y()) - 1, all.top, all.bottom),
          pixel(std::ceil(high.x()) + 2, all.left, all.right),
          pixel(std::ceil(high.y()) + 2, all.top, all.bottom)};
}

PixelRect image_of(const CameraIntrinsics& camera) { return {0, 0, camera.width, camera.height}; }

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
  const PixelRect rect =
      rect_of(model.camera, image_of(model.camera), body.scene->box(), T.inverse());
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

/// The image and as much beside it on the side of the other eye.
PixelRect widened(const PixelRect& image, const sampling::View& view) {
  PixelRect wide = image;
  const int width = image.width(), height = image.height();
  if (view.baseline_along_rows)
    (view.baseline > 0.0f ? wide.right : wide.left) += view.baseline > 0.0f ? width : -width;
  else
    (view.baseline > 0.0f ? wide.bottom : wide.top) += view.baseline > 0.0f ? height : -height;
  return wide;
}

/// Whether the rect ends at the border on the side of the other eye: the body may go on beyond it.
bool cut_off(const PixelRect& rect, const sampling::View& view, const PixelRect& border) {
  if (view.baseline_along_rows)
    return view.baseline > 0.0f ? rect.right >= border.right : rect.left <= border.left;
  return view.baseline > 0.0f ? rect.bottom >= border.bottom : rect.top <= border.top;
}

bool baseline_along_image(const ScannerModel& model) {
  const Vec3d& eye = model.other_eye_m();
  return model.kind == ScannerKind::kMatrix && model.two_eyed() && eye.z() == 0.0 &&
         (eye.x() == 0.0 || eye.y() == 0.0) && !model.camera.distorted();
}

/// Whether any triangle of a small body reaches, by its box, into a box of the sensor's frame; of a
/// large body it is taken to.
bool reaches_into(const Body& body, const Pose& T_sensor_body, const Box& where) {
  constexpr std::size_t kMostTriangles = 20000;
  const Scene::Impl& scene = body.scene->impl();
  if (scene.triangle_count() > kMostTriangles) return true;
  const auto meets = [&](const Box& box) {
    return (box.min.array() <= where.max.array()).all() &&
           (box.max.array() >= where.min.array()).all();
  };
  for (std::uint32_t object = 0; object < scene.objects.size(); ++object) {
    for (std::uint32_t t = 0; t < scene.objects[object].triangle_count; ++t) {
      Box box;
      for (const Vec3f& p : body.scene->corners(object, t))
        box.add(T_sensor_body * p.cast<double>());
      if (meets(box)) return true;
    }
  }
  const auto radius = body.scene->platter_radius_m();
  if (!radius) return false;
  Box box;
  for (const double x : {-*radius, *radius})
    for (const double z : {-*radius, *radius}) box.add(T_sensor_body * Vec3d(x, 0.0, z));
  return meets(box);
}

/// Where something beyond the border may lie that hides a sample of the image from the other eye at
/// b: between the two, and so no deeper than b / (direction of the border - the sample's).
Box hideout(const CameraIntrinsics& camera, const sampling::View& view, const PixelRect& border) {
  const bool rows = view.baseline_along_rows;
  const double f = rows ? camera.fx : camera.fy, c = rows ? camera.cx : camera.cy;
  const double b = std::abs(double(view.baseline));
  const int last = rows ? camera.width - 1 : camera.height - 1;
  const bool after = view.baseline > 0.0f;
  const double far_end =
      rows ? (after ? border.right : border.left) : (after ? border.bottom : border.top);
  const double edge = std::abs((after ? last : 0) - c) / f, beyond = std::abs(far_end - c) / f;
  const double depth = 1.1 * b / std::max(beyond - edge, 1e-3);
  const double across =
      std::max(rows ? camera.cy : camera.cx,
               (rows ? camera.height : camera.width) - (rows ? camera.cy : camera.cx)) /
      (rows ? camera.fy : camera.fx) * depth;
  const double reach = (after ? 1.0 : -1.0) * 1.1 * (b + edge * depth);
  Box box;
  box.add(rows ? Vec3d(0.0, -across, 0.0) : Vec3d(-across, 0.0, 0.0));
  box.add(rows ? Vec3d(reach, across, depth) : Vec3d(across, reach, depth));
  return box;
}

/// For occlusion along the rows or columns. Returns the part of `border` that the bodies' other
/// sides may be in; what lies beyond it is told by the nearest of it.
PixelRect set_baseline(std::span<const Body> bodies, const ScannerModel& model,
                       const Pose& T_world_sensor, bool beyond, sampling::View& view) {
  const Vec3d& eye = model.other_eye_m();
  const CameraIntrinsics& camera = model.camera;
  const bool rows = eye.x() != 0.0;
  view.baseline_along_rows = rows;
  view.baseline = static_cast<float>(rows ? eye.x() : eye.y());
  view.pixel = static_cast<float>(1.0 / (rows ? camera.fx : camera.fy));
  const PixelRect border = beyond ? widened(image_of(camera), view) : image_of(camera);
  PixelRect all;
  for (const Body& body : bodies) {
    if (body.scene->box().empty()) continue;
    const PixelRect rect =
        rect_of(camera, border, body.scene->box(), T_world_sensor.inverse() * body.T_world_body);
    all = united(all, rect);
    if (!cut_off(rect, view, border)) continue;
    if (beyond && !reaches_into(body, T_world_sensor.inverse() * body.T_world_body,
                                hideout(camera, view, border)))
      continue;
    const double nearest = std::max(nearest_of(body, T_world_sensor), 1e-6);
    view.border_nearness = std::max(view.border_nearness, static_cast<float>(1.0 / nearest));
  }
  return all;
}

/// The rect, and on the side of the other eye as far as `wide` goes.
Frame canvas_frame(const PixelRect& rect, const PixelRect& wide, const sampling::View& view) {
  Frame frame{rect.left, rect.top, rect.right, rect.bottom};
  if (view.baseline == 0.0f) return frame;
  if (view.baseline_along_rows) {
    frame.left = std::min(frame.left, wide.left);
    frame.right = std::max(frame.right, wide.right);
  } else {
    frame.top = std::min(frame.top, wide.top);
    frame.bottom = std::max(frame.bottom, wide.bottom);
  }
  return frame;
}

/// Memory for drawing that the next image uses again.
struct Sheet {
  std::vector<float> nearness, tiles;
  std::vector<std::uint32_t> slot, order;
  std::vector<sampling::GroupView> seen;

  sampling::Canvas canvas(const Frame& frame, int groups) {
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

/// Drawing costs by the triangle, rays by the pixel: up to so many of the one for the other it pays
/// to draw (measured, docs/performance.md).
constexpr double kTrianglesPerPixel = 30.0;
constexpr std::uint64_t kMostSlots = 0xffffff00u;

bool worth_drawing(std::span<const Body> bodies, const PixelRect& rect) {
  double triangles = 0.0;
  for (const Body& body : bodies) triangles += double(body.scene->impl().triangle_count());
  return triangles <= kTrianglesPerPixel * double(rect.width()) * double(rect.height());
}

bool slots_suffice(std::span<const Body> bodies) {
  std::uint64_t slots = 0;
  for (const Body& body : bodies) slots += body.scene->impl().triangle_count() + sampling::kLanes;
  return slots < kMostSlots;
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
  int tile_width;           ///< of a packet: a square, or as near to it as the image allows
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
    // Of one column rays are as fast.
    if (methods.hits == HitMethod::kCheapest && model.kind == ScannerKind::kLine) return false;
    if (methods.hits == HitMethod::kRays || model.camera.distorted() || !slots_suffice(bodies))
      return false;
    return methods.hits == HitMethod::kDrawn || worth_drawing(bodies, rect);
  }

  void draw(std::span<const Body> bodies, Views& views, const Frame& frame, const Frame& wide,
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
    sampling::kernel().draw_image(views.view, directions, frame, sheet->canvas(wide, groups), out);
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
  Views views(bodies, impl_->model, T_world_sensor);
  const CameraIntrinsics& camera = impl_->model.camera;
  out.width = camera.width;
  out.height = camera.height;
  out.rect = {};
  for (const BodyView& body : views.bodies)
    out.rect =
        united(out.rect, {body.frame.left, body.frame.top, body.frame.right, body.frame.bottom});
  out.resize(std::size_t(out.rect.width()) * std::size_t(out.rect.height()));
  if (out.size() == 0) return;
  const bool draw = impl_->draws(bodies, out.rect);
  PixelRect wide;
  if (impl_->methods.occlusion == OcclusionMethod::kDoubtful && baseline_along_image(impl_->model))
    wide = set_baseline(bodies, impl_->model, T_world_sensor, draw, views.view);
  const Frame frame{out.rect.left, out.rect.top, out.rect.right, out.rect.bottom};
  if (draw)
    impl_->draw(bodies, views, frame, canvas_frame(out.rect, wide, views.view), output_of(out));
  else
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
