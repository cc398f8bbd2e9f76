#pragma once
// A colour image's camera before the object, and what of the object it can see.

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
  /// As if the object had turned further by that when the image was taken.
  void turn(double angle_rad);
  Vec3f eye() const { return -(rotation.transpose() * translation); }
  float focal_px() const { return float(0.5 * (camera.fx + camera.fy)); }
  /// z <= 0: it lies behind the camera, u and v say nothing.
  Projection project(const Vec3f& p_object) const;
};

/// How a view shows a place: near a rim colours of two surfaces may mix.
enum class Shown : std::uint8_t { kNot, kNearRim, kWell };

/// The mesh as a view sees it: depths of the pixels of a window of its image, and which of them lie
/// well within a surface.
class DrawnMesh {
 public:
  /// Pixels about a rim in which colours of two surfaces may mix.
  static constexpr int kRim_px = 2;

  DrawnMesh(const ColorView& view, const TriangleMesh& mesh);

  bool empty() const { return width_ == 0; }
  int left() const { return left_; }
  int top() const { return top_; }
  int width() const { return width_; }
  int height() const { return height_; }
  /// 0 where nothing is; column and row count in the window.
  float depth(int column, int row) const { return depth_[index(column, row)]; }
  bool covered(int column, int row) const {
    return column >= 0 && row >= 0 && column < width_ && row < height_ && depth(column, row) > 0.0f;
  }
  /// How the view shows a point of the mesh that is seen at p.
  Shown shows(const Projection& p) const;
  /// Whether p lies near a rim of what is drawn there, or beside the mesh.
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
  float footprint_ = 0.0f;  // of a pixel, over depth
  std::vector<float> depth_;
  std::vector<std::uint8_t> rim_;  // 0: none near, 1: near one, 2: on one
};

/// The views of a sequence's colour images: of depth cameras, with their own colour camera or that
/// of the depth. T_table_sensor per frame; frames for which use() is false are left out.
/// T_object_table per pass; empty: identity.
std::vector<ColorView> color_views(const FrameSequence& sequence,
                                   const std::vector<Pose>& T_table_sensor,
                                   const std::vector<Pose>& T_object_table,
                                   std::optional<std::uint32_t> pass);

/// Of these, as few as look at `center` from all the directions that there are, no nearer to each
/// other than an angle of some degrees.
std::vector<ColorView> spread_views(const std::vector<ColorView>& views, const Vec3f& center);

}  // namespace turnscan::texture
