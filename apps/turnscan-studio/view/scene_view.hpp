#pragma once
// The view: drawing, camera, and mouse interaction. Encapsulates VTK.

#include <QColor>
#include <QCursor>
#include <QImage>
#include <QPointF>
#include <QWidget>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "view/drawable.hpp"

class QPainter;
class vtkActor;

namespace turnscan::studio {

struct Theme;

inline QColor to_color(const Rgb& c) { return {c.r, c.g, c.b}; }

struct ItemStyle {
  bool visible = true;
  QColor color = QColor(0xb9c4cf);  ///< if the item has no colours of its own
  bool own_colors = true;           ///< draw its own colours or texture
  double opacity = 1.0;             ///< 0 to 1
  int pane = 0;                     ///< 1: on the right in a split view
  double line_width = 1.5;
  double point_scale = 1.0;  ///< relative to the view's point size
  bool lit = true;
  bool boxed = true;    ///< has a bounding box, and is cut by the clipping plane
  bool in_view = true;  ///< included when the camera is fitted
};

/// Mouse interaction that replaces the rotation of the camera. Positions are in pixels of the
/// widget.
class ViewTool {
 public:
  virtual ~ViewTool() = default;
  /// True: the tool receives the mouse events until release.
  virtual bool press(const QPointF& at, Qt::KeyboardModifiers keys) = 0;
  virtual void drag(const QPointF& /*at*/, Qt::KeyboardModifiers /*keys*/) {}
  virtual void release(const QPointF& /*at*/) {}
  virtual void paint(QPainter& /*painter*/) {}
  virtual QCursor cursor() const { return Qt::CrossCursor; }
};

/// How the surfaces of all models are drawn.
enum class SurfaceLook {
  kShaded,
  kEdges,      ///< with the edges of its triangles
  kWireframe,  ///< only the edges
  kNormals     ///< coloured by the normal: x red, y green, z blue
};

enum class StandardView { kFront, kBack, kLeft, kRight, kTop, kBottom, kCorner };

/// Position of the camera, its centre of rotation, and the up direction on the screen.
struct CameraPlace {
  Vec3d position, focus, up;
};

/// A colour bar with labels, low values first.
struct Legend {
  QString title;
  struct Entry {
    QColor color;
    QString text;
  };
  std::vector<Entry> entries;
  bool continuous = false;        ///< one bar with blended colours and evenly spaced labels
  std::vector<double> histogram;  ///< shares shown next to the bar; may be empty
  std::vector<QColor> bar;        ///< for a continuous one: finer colours than the entries
};

class SceneView : public QWidget {
  Q_OBJECT
 public:
  explicit SceneView(QWidget* parent = nullptr);
  ~SceneView() override;

  int add(DrawablePtr drawable, const ItemStyle& style);
  /// Replaces the geometry of an item, which keeps its style.
  void replace(int item, DrawablePtr drawable);
  void set_style(int item, const ItemStyle& style);
  void remove(int item);

  void set_theme(const Theme& theme);
  void set_point_size(double pixels);
  void set_camera_speed(double factor);
  void set_boxes(bool on);
  void set_split(bool on, const QString& left = {}, const QString& right = {});
  /// For content that changes many times per second: disables antialiasing, which costs a software
  /// renderer as much as everything else.
  void set_live(bool live);
  void set_legend(const Legend& legend);
  /// Shown in the middle if nothing is drawn.
  void set_empty_text(const QString& title, const QString& text);
  /// Buttons below that text; the first is the one that most users want.
  struct Action {
    QString text;
    std::function<void()> run;
  };
  void set_empty_actions(const std::vector<Action>& actions);
  /// One line at the top, e.g. what to click next; empty: none.
  void set_hint(const QString& text);
  void set_tool(ViewTool* tool);  ///< nullptr: the camera gets the mouse
  ViewTool* tool() const { return tool_; }
  /// Painted over the picture whichever tool is active, e.g. measurements; empty: nothing.
  void set_marks(std::function<void(QPainter&)> paint);
  /// Up direction on the screen: +Y of the table's frame, -Y of a sensor's.
  void set_up(const Vec3d& up);
  /// Clips everything at a plane (normal . p >= offset is shown); normal 0: none.
  void set_clip(const Vec3d& normal, double offset);
  /// The same for a second plane, set by the user to look inside, in addition to that of a tool.
  void set_view_clip(const Vec3d& normal, double offset);

  void set_surface_look(SurfaceLook look);
  /// Darkens places that little ambient light reaches; switched off while the view moves.
  void set_ambient_occlusion(bool on);

  void reset_camera();
  CameraPlace camera() const;
  /// As if the user had moved it there.
  void set_camera(const CameraPlace& place);
  /// Whether a box is completely visible, and at least a twentieth of the view in size.
  bool sees(const Box& box) const;
  /// Moves the camera until sees() is true, if necessary.
  void bring_into_view(const Box& box);
  /// Rotates the camera about the vertical through its centre of rotation.
  void turn(double angle_rad);
  /// reset_camera(), unless the user has moved the camera.
  void fit_unless_moved();
  void look(StandardView from);
  /// Moves the camera to look at a point from a direction (0: the current one), with `size_m`
  /// filling the view.
  void fly_to(const Vec3d& center, double size_m, const Vec3d& from);
  /// Views from the sensor: from the origin along +z, y down.
  void look_as_sensor(const Vec3d& target);

  /// Position of what is drawn at a pixel; nullopt on the background.
  std::optional<Vec3d> pick(const QPointF& at);
  /// Pixel of a point, if it is in front of the camera.
  std::optional<QPointF> project(const Vec3d& p) const;
  /// Origin and direction (unit length) of the line of sight through a pixel.
  std::pair<Vec3d, Vec3d> sight(const QPointF& at) const;
  /// Projects homogeneous points to pixels of the widget times depth (x, y, _, depth > 0).
  Eigen::Matrix4d to_pixels() const;
  /// Metres per pixel at the camera's centre of rotation.
  double metres_per_pixel() const;

  QImage screenshot();
  void request_render();
  void update_overlay();
  /// Whether everything that is drawn at rest has been drawn.
  bool settled() const;
  /// Number of points that the last frame drew while moving, and the longest duration of such a
  /// frame.
  std::size_t points_while_moving() const;
  /// Number of points that this machine draws without a noticeable pause.
  std::size_t points_at_once() const;
  double longest_frame_ms() const;

 Q_SIGNALS:
  void camera_changed();

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

 private:
  friend class VtkCanvas;
  friend class ViewOverlay;
  struct Parts;
  struct Item;

  bool on_mouse(QEvent* event);
  void on_press(class QMouseEvent* event);
  void on_drag(class QMouseEvent* event);
  void on_wheel(class QWheelEvent* event);
  void orbit(double dx, double dy);
  void pan(double dx, double dy);
  void zoom(double factor);
  void camera_moved();
  void render_now();
  void draw_coarse();
  void show_first(bool moving_now);
  vtkActor* actor_of(Item& item, std::size_t chunk);
  void style_actor(const Item& item, vtkActor* actor);
  void draw_rest();
  void bring_textures();
  void apply_style(Item& item);
  void update_box(Item& item);
  void update_clip();
  Box scene_box() const;
  void set_clipping_range();
  void paint_overlay(QPainter& painter);
  void paint_scale_bar(QPainter& painter);
  void paint_axes(QPainter& painter);
  void paint_legend(QPainter& painter);
  void paint_texts(QPainter& painter);
  void place_actions();

  std::unique_ptr<Parts> parts_;
  ViewTool* tool_ = nullptr;
  bool focus_shown_ = false;
};

}  // namespace turnscan::studio
