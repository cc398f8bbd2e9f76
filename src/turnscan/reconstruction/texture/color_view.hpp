#pragma once
// The camera of a colour image relative to the object, and the surface visible in it.

#include <turnscan/core/camera.hpp>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/lens.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan::texture {

/// Image point (pixels) and depth (metres) of a point of the object.
struct Projection {
  float u = 0.0f, v = 0.0f, z = 0.0f;
};

/// p_camera = rotation * p_object + translation.
struct ColorView {
  std::size_t position = 0;  ///< of its frame in the sequence
  std::uint32_t sensor = 0;
  Pose T_sensor_object = Pose::Identity();
  Pose T_object_table = Pose::Identity();  ///< the object turns about the table's Y
  CameraIntrinsics camera;                 ///< set by set_camera()
  bool distorted = false;                  ///< camera.distorted()
  BrownConrady<float> lens{};              ///< camera.lens()
  Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();
  Vec3f translation = Vec3f::Zero();

  void set_camera(const CameraIntrinsics& intrinsics);
  void set_pose(const Pose& T_color_sensor);
  /// Moves the camera as if the object had turned further by this angle when the image was taken.
  void turn(double angle_rad);
  Vec3f eye() const { return -(rotation.transpose() * translation); }
  float focal_px() const { return float(0.5 * (camera.fx + camera.fy)); }
  /// If z <= 0 the point is behind the camera, and u and v are meaningless.
  Projection project(const Vec3f& p_object) const;
};

/// Visibility of a point in a view: near a rim, colours of two surfaces may mix.
enum class Shown : std::uint8_t { kNot, kNearRim, kWell };

/// The mesh rendered from a view: depths of the pixels in a window of its image, and which of them
/// are well inside a surface.
class DrawnMesh {
 public:
  /// Distance from a rim within which colours of two surfaces may mix.
  static constexpr int kRim_px = 2;

  DrawnMesh(const ColorView& view, const TriangleMesh& mesh);

  bool empty() const { return width_ == 0; }
  int left() const { return left_; }
  int top() const { return top_; }
  int width() const { return width_; }
  int height() const { return height_; }
  /// 0 for background; column and row are relative to the window.
  float depth(int column, int row) const { return depth_[index(column, row)]; }
  bool covered(int column, int row) const {
    return column >= 0 && row >= 0 && column < width_ && row < height_ && depth(column, row) > 0.0f;
  }
  /// Visibility of a point of the mesh that projects to p.
  Shown shows(const Projection& p) const;
  /// Whether p is near a rim of the rendered mesh, or beside the mesh.
  bool near_rim(const Projection& p) const;

 private:
  /// -1: outside the window.
  std::ptrdiff_t pixel_of(const Projection& p) const;
  std::size_t index(int column, int row) const {
    return std::size_t(row) * std::size_t(width_) + std::size_t(column);
  }
  void draw(const Projection& a, const Projection& b, const Projection& c);
  void find_rims();

  int left_ = 0, top_ = 0, width_ = 0, height_ = 0;
  float footprint_ = 0.0f;  // of a pixel, relative to depth
  std::vector<float> depth_;
  std::vector<std::uint8_t> rim_;  // 0: none near, 1: near one, 2: on one
};

/// The views of a sequence's colour images from depth cameras, with their own colour camera or the
/// depth camera's parameters; only those of `pass`, if given. T_table_sensor per frame.
/// T_object_table per pass; empty: identity.
std::vector<ColorView> color_views(const FrameSequence& sequence,
                                   const std::vector<Pose>& T_table_sensor,
                                   const std::vector<Pose>& T_object_table,
                                   std::optional<std::uint32_t> pass);

/// A subset of the views whose viewing directions towards `center` cover all that exist, with a
/// minimum angle of some degrees between them.
std::vector<ColorView> spread_views(const std::vector<ColorView>& views, const Vec3f& center);

}  // namespace turnscan::texture
