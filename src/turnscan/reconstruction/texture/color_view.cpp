#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/frame_samples.hpp>
#include <turnscan/reconstruction/texture/color_view.hpp>

namespace turnscan::texture {

namespace {

constexpr float kStepOfSurface = 6.0f;  // of depth from pixel to pixel, in widths of a pixel
constexpr float kBehind = 3.0f;         // a point farther behind what is drawn is hidden; the same
constexpr double kViewStep_deg = 6.5;
constexpr std::size_t kMaxViews = 240;

}  // namespace

void ColorView::set_camera(const CameraIntrinsics& intrinsics) {
  camera = intrinsics;
  distorted = camera.distorted();
  lens = lens_as<float>(camera.lens());
}

void ColorView::set_pose(const Pose& T_color_sensor) {
  const Pose T = T_color_sensor * T_sensor_object;
  rotation = T.linear().cast<float>();
  translation = T.translation().cast<float>();
}

void ColorView::turn(double angle_rad) {
  const Pose turned = T_object_table * rotation_about_y(angle_rad) * T_object_table.inverse();
  T_sensor_object = T_sensor_object * turned;
  translation += rotation * turned.translation().cast<float>();
  rotation *= turned.linear().cast<float>();
}

Projection ColorView::project(const Vec3f& p_object) const {
  const Vec3f p = rotation * p_object + translation;
  if (!(p.z() > 0.0f)) return {};
  float x = p.x() / p.z(), y = p.y() / p.z();
  if (distorted) distort_any(lens, x, y);
  return {x * float(camera.fx) + float(camera.cx), y * float(camera.fy) + float(camera.cy), p.z()};
}

DrawnMesh::DrawnMesh(const ColorView& view, const TriangleMesh& mesh) {
  std::vector<Projection> points(mesh.vertices.size());
  float least_u = 1e9f, least_v = 1e9f, most_u = -1e9f, most_v = -1e9f;
  for (std::size_t v = 0; v < points.size(); ++v) {
    points[v] = view.project(mesh.vertices[v]);
    if (!(points[v].z > 0.0f)) continue;
    least_u = std::min(least_u, points[v].u), most_u = std::max(most_u, points[v].u);
    least_v = std::min(least_v, points[v].v), most_v = std::max(most_v, points[v].v);
  }
  const auto clamped = [](float value, int most) {
    return int(std::clamp(value, -1.0f, float(most + 1)));
  };
  left_ = std::max(0, clamped(std::floor(least_u) - 3.0f, view.camera.width));
  top_ = std::max(0, clamped(std::floor(least_v) - 3.0f, view.camera.height));
  const int right =
      std::min(view.camera.width, clamped(std::ceil(most_u) + 4.0f, view.camera.width));
  const int bottom =
      std::min(view.camera.height, clamped(std::ceil(most_v) + 4.0f, view.camera.height));
  if (right <= left_ || bottom <= top_) return;
  width_ = right - left_;
  height_ = bottom - top_;
  footprint_ = 1.0f / view.focal_px();
  depth_.assign(std::size_t(width_) * std::size_t(height_), 0.0f);  // temporarily inverse depth
  const Vec3f eye = view.eye();
  for (const auto& t : mesh.triangles) {
    const Vec3f& a = mesh.vertices[t[0]];
    const Vec3f normal = (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
    if (!(normal.dot(eye - a) > 0.0f)) continue;
    if (!(points[t[0]].z > 0.0f && points[t[1]].z > 0.0f && points[t[2]].z > 0.0f)) continue;
    draw(points[t[0]], points[t[1]], points[t[2]]);
  }
  for (float& value : depth_)
    if (value > 0.0f) value = 1.0f / value;
  find_rims();
}

/// The inverse depth is linear in the image.
void DrawnMesh::draw(const Projection& a, const Projection& b, const Projection& c) {
  const float ax = a.u - float(left_), ay = a.v - float(top_);
  const float bx = b.u - float(left_), by = b.v - float(top_);
  const float cx = c.u - float(left_), cy = c.v - float(top_);
  const float area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
  if (area == 0.0f) return;
  const int x0 = std::max(0, int(std::ceil(std::min({ax, bx, cx}))));
  const int x1 = std::min(width_ - 1, int(std::floor(std::max({ax, bx, cx}))));
  const int y0 = std::max(0, int(std::ceil(std::min({ay, by, cy}))));
  const int y1 = std::min(height_ - 1, int(std::floor(std::max({ay, by, cy}))));
  const float ia = 1.0f / a.z, ib = 1.0f / b.z, ic = 1.0f / c.z, over = 1.0f / area;
  constexpr float kBeside = -1e-4f;
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const float px = float(x), py = float(y);
      const float wb = ((px - ax) * (cy - ay) - (cx - ax) * (py - ay)) * over;
      const float wc = ((bx - ax) * (py - ay) - (px - ax) * (by - ay)) * over;
      const float wa = 1.0f - wb - wc;
      if (wa < kBeside || wb < kBeside || wc < kBeside) continue;
      float& kept = depth_[index(x, y)];
      kept = std::max(kept, wa * ia + wb * ib + wc * ic);
    }
  }
}

void DrawnMesh::find_rims() {
  std::vector<std::uint8_t> edge(depth_.size(), 0);
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const float z = depth(x, y);
      if (!(z > 0.0f)) {
        edge[index(x, y)] = 1;
        continue;
      }
      const auto step = [&](int column, int row) {
        if (column >= width_ || row >= height_) return;
        const float other = depth(column, row);
        if (other > 0.0f && std::abs(other - z) <= kStepOfSurface * footprint_ * z) return;
        edge[index(x, y)] = 1;
        edge[index(column, row)] = 1;
      };
      step(x + 1, y);
      step(x, y + 1);
    }
  }
  // Dilated by the rim, along rows and then along columns.
  std::vector<std::uint8_t> grown(edge.size(), 0);
  rim_.assign(edge.size(), 0);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      for (int d = -kRim_px; d <= kRim_px && grown[index(x, y)] == 0; ++d)
        if (x + d < 0 || x + d >= width_ || edge[index(x + d, y)] != 0) grown[index(x, y)] = 1;
  for (int y = 0; y < height_; ++y)
    for (int d = -kRim_px; d <= kRim_px; ++d) {
      const bool inside = y + d >= 0 && y + d < height_;
      for (int x = 0; x < width_; ++x) rim_[index(x, y)] |= inside ? grown[index(x, y + d)] : 1;
    }
  for (std::size_t i = 0; i < edge.size(); ++i)
    if (edge[i] != 0) rim_[i] = 2;
}

std::ptrdiff_t DrawnMesh::pixel_of(const Projection& p) const {
  if (!(p.z > 0.0f)) return -1;
  const int x = int(std::floor(p.u + 0.5f)) - left_, y = int(std::floor(p.v + 0.5f)) - top_;
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return -1;
  return std::ptrdiff_t(index(x, y));
}

Shown DrawnMesh::shows(const Projection& p) const {
  const std::ptrdiff_t at = pixel_of(p);
  if (at < 0) return Shown::kNot;
  const auto i = std::size_t(at);
  if (rim_[i] == 2 || !(p.z <= depth_[i] + kBehind * footprint_ * p.z)) return Shown::kNot;
  return rim_[i] == 0 ? Shown::kWell : Shown::kNearRim;
}

bool DrawnMesh::near_rim(const Projection& p) const {
  const std::ptrdiff_t at = pixel_of(p);
  return at < 0 || rim_[std::size_t(at)] != 0;
}

std::vector<ColorView> color_views(const FrameSequence& sequence,
                                   const std::vector<Pose>& T_table_sensor,
                                   const std::vector<Pose>& T_object_table,
                                   std::optional<std::uint32_t> pass) {
  std::vector<ColorView> out;
  for (const std::size_t i : usable_frames(sequence, {.pass = pass})) {
    const FrameInfo& info = sequence.frames()[i];
    const SensorInfo& sensor = sequence.header().sensors[info.sensor];
    if (sensor.kind != SensorKind::kDepthCamera) continue;
    ColorView view;
    if (info.pass < T_object_table.size()) view.T_object_table = T_object_table[info.pass];
    view.position = i;
    view.sensor = info.sensor;
    view.T_sensor_object = (view.T_object_table * T_table_sensor[i]).inverse();
    view.set_camera(sensor.color_intrinsics.value_or(sensor.intrinsics));
    view.set_pose(sensor.color_intrinsics ? sensor.T_color_sensor : Pose::Identity());
    out.push_back(std::move(view));
  }
  return out;
}

std::vector<ColorView> spread_views(const std::vector<ColorView>& views, const Vec3f& center) {
  for (double step_deg = kViewStep_deg;; step_deg *= 1.25) {
    const auto limit = float(std::cos(step_deg / kDegreesPerRadian));
    std::vector<ColorView> kept;
    std::vector<Vec3f> directions;
    for (const ColorView& view : views) {
      const Vec3f direction = (view.eye() - center).normalized();
      if (std::any_of(directions.begin(), directions.end(),
                      [&](const Vec3f& d) { return d.dot(direction) > limit; }))
        continue;
      kept.push_back(view);
      directions.push_back(direction);
    }
    if (kept.size() <= kMaxViews) return kept;
  }
}

}  // namespace turnscan::texture
