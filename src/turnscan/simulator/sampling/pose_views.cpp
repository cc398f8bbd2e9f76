#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <turnscan/core/angles.hpp>
#include <turnscan/geometry/rays/scene_impl.hpp>
#include <turnscan/simulator/sampling/pose_views.hpp>

namespace turnscan::sampling {

namespace {

constexpr double kNearest_m = 1e-3;  // a nearer corner may be anywhere in the image

/// Rect outside of which no pixel of `all` sees anything of the box, with a border of one pixel.
/// `all` if a part of the box is behind the eye.
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
  // Distorted edges may bulge between the corners.
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
  view.id = static_cast<std::uint32_t>(position << kObjectBits);
  for (int i = 0; i < 9; ++i) view.rotation[i] = static_cast<float>(T.linear()(i / 3, i % 3));
  copy(T.translation(), view.origin);
  copy(T * model.other_eye_m(), view.other);
  const PixelRect rect =
      rect_of(model.camera, image_of(model.camera), body.scene->box(), T.inverse());
  view.frame = {rect.left, rect.top, rect.right, rect.bottom};
  return view;
}

/// Depth of the nearest corner of the body's bounding box.
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

/// The image, extended by its own size on the side of the other eye.
PixelRect widened(const PixelRect& image, const View& view) {
  PixelRect wide = image;
  const int width = image.width(), height = image.height();
  if (view.baseline_along_rows)
    (view.baseline > 0.0f ? wide.right : wide.left) += view.baseline > 0.0f ? width : -width;
  else
    (view.baseline > 0.0f ? wide.bottom : wide.top) += view.baseline > 0.0f ? height : -height;
  return wide;
}

/// Whether the rect ends at the border on the side of the other eye, so that the body may extend
/// beyond it.
bool cut_off(const PixelRect& rect, const View& view, const PixelRect& border) {
  if (view.baseline_along_rows)
    return view.baseline > 0.0f ? rect.right >= border.right : rect.left <= border.left;
  return view.baseline > 0.0f ? rect.bottom >= border.bottom : rect.top <= border.top;
}

/// Whether the bounding box of any triangle of a small body intersects a box of the sensor's frame;
/// assumed for large bodies.
bool reaches_into(const Body& body, const Pose& T_sensor_body, const Box& where) {
  constexpr std::size_t kMaxTriangles = 20000;
  const Scene::Impl& scene = body.scene->impl();
  if (scene.triangle_count() > kMaxTriangles) return true;
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

/// Space beyond the border in which something may occlude a sample of the image from the other eye
/// at b: between the two, and so no deeper than b / (direction of the border - the sample's).
Box hideout(const CameraIntrinsics& camera, const View& view, const PixelRect& border) {
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

}  // namespace

PoseViews::PoseViews(std::span<const Body> all, const ScannerModel& model,
                     const Pose& T_world_sensor) {
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
  // With a maximum of a right angle nothing is too oblique, whatever the rounding.
  view.least_cosine = model.max_incidence_rad < kTurn / 4
                          ? static_cast<float>(std::cos(model.max_incidence_rad))
                          : 0.0f;
}

PixelRect united(const PixelRect& a, const PixelRect& b) {
  if (a.width() == 0 || a.height() == 0) return b;
  if (b.width() == 0 || b.height() == 0) return a;
  return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right),
          std::max(a.bottom, b.bottom)};
}

bool baseline_along_image(const ScannerModel& model) {
  const Vec3d& eye = model.other_eye_m();
  return model.kind == ScannerKind::kMatrix && model.two_eyed() && eye.z() == 0.0 &&
         (eye.x() == 0.0 || eye.y() == 0.0) && !model.camera.distorted();
}

PixelRect set_baseline(std::span<const Body> bodies, const ScannerModel& model,
                       const Pose& T_world_sensor, bool beyond, View& view) {
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

Window canvas_frame(const PixelRect& rect, const PixelRect& wide, const View& view) {
  Window frame{rect.left, rect.top, rect.right, rect.bottom};
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

}  // namespace turnscan::sampling
