#pragma once
// The view: what is drawn, the camera, and what a person does with the mouse. VTK stays behind it.

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
  QColor color = QColor(0xb9c4cf);  ///< where the item has no colours of its own
  bool own_colors = true;           ///< draw the colours, or the texture, that it has
  double opacity = 1.0;             ///< 0 to 1
  int pane = 0;                     ///< 1: on the right where the view is split
  double line_width = 1.5;
  double point_scale = 1.0;  ///< of the view's point size
  bool lit = true;
  bool boxed = true;    ///< gets a bounding box, and is cut by the clipping plane
  bool in_view = true;  ///< the camera is set so that it is seen
};

/// What the mouse does in place of turning the camera. Positions in pixels of the widget.
class ViewTool {
 public:
  virtual ~ViewTool() = default;
  /// True: the tool takes the mouse until it is released.
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
  kWireframe,  ///< these alone
  kNormals     ///< coloured by where it faces: x red, y green, z blue
};

enum class StandardView { kFront, kBack, kLeft, kRight, kTop, kBottom, kCorner };

/// Where the camera is, what it turns about, and which way is up on the screen.
struct CameraPlace {
  Vec3d position, focus, up;
};

/// A bar of colours with texts beside it, low values first.
struct Legend {
  QString title;
  struct Entry {
    QColor color;
    QString text;
  };
  std::vector<Entry> entries;
  bool continuous = false;        ///< one bar with the colours blended, texts at even distances
  std::vector<double> histogram;  ///< shares beside the bar; may be empty
  std::vector<QColor> bar;        ///< of a continuous one: finer colours than the entries have
};

class SceneView : public QWidget {
  Q_OBJECT
 public:
  explicit SceneView(QWidget* parent = nullptr);
  ~SceneView() override;

  int add(DrawablePtr drawable, const ItemStyle& style);
  /// Other geometry for an item; it keeps its style.
  void replace(int item, DrawablePtr drawable);
  void set_style(int item, const ItemStyle& style);
  void remove(int item);

  void set_theme(const Theme& theme);
  void set_point_size(double pixels);
  void set_camera_speed(double factor);
  void set_boxes(bool on);
  void set_split(bool on, const QString& left = {}, const QString& right = {});
  /// What it shows comes many times a second: edges are not smoothed, which costs a software
  /// renderer as much as all else.
  void set_live(bool live);
  void set_legend(const Legend& legend);
  /// Shown in the middle while nothing is drawn.
  void set_empty_text(const QString& title, const QString& text);
  /// Buttons below that text; the first one is what most people want.
  struct Action {
    QString text;
    std::function<void()> run;
  };
  void set_empty_actions(const std::vector<Action>& actions);
  /// One line at the top, e.g. what to click next; empty: none.
  void set_hint(const QString& text);
  void set_tool(ViewTool* tool);  ///< nullptr: the camera alone
  ViewTool* tool() const { return tool_; }
  /// Painted above the picture whichever tool is active, e.g. measurements; empty: nothing.
  void set_marks(std::function<void(QPainter&)> paint);
  /// Up on the screen: +Y of the table's frame, -Y of a sensor's.
  void set_up(const Vec3d& up);
  /// A plane (normal . p >= offset is shown) that everything is cut by; normal 0: none.
  void set_clip(const Vec3d& normal, double offset);
  /// The same, of another plane: that of a person who looks inside, beside that of a tool.
  void set_view_clip(const Vec3d& normal, double offset);

  void set_surface_look(SurfaceLook look);
  /// Places that little light reaches are darker; off by itself while the view moves.
  void set_ambient_occlusion(bool on);

  void reset_camera();
  CameraPlace camera() const;
  /// As if a person had moved it there.
  void set_camera(const CameraPlace& place);
  /// Whether all of a box is seen, and no smaller than a twentieth of the view.
  bool sees(const Box& box) const;
  /// The camera moves until it does, if it does not yet.
  void bring_into_view(const Box& box);
  /// Turns the camera about the vertical through its centre of rotation.
  void turn(double angle_rad);
  /// reset_camera(), unless somebody has moved the camera.
  void fit_unless_moved();
  void look(StandardView from);
  /// The camera moves to look at a point from a direction (0: as now), `size_m` filling the view.
  void fly_to(const Vec3d& center, double size_m, const Vec3d& from);
  /// As if the sensor looked: from the origin along +z, y down.
  void look_as_sensor(const Vec3d& target);

  /// Where what is drawn under a pixel lies; nothing on the background.
  std::optional<Vec3d> pick(const QPointF& at);
  /// Pixel of a point, if it is before the camera.
  std::optional<QPointF> project(const Vec3d& p) const;
  /// Origin and direction (unit length) of the line of sight through a pixel.
  std::pair<Vec3d, Vec3d> sight(const QPointF& at) const;
  /// Takes homogeneous points to pixels of the widget times depth (x, y, _, depth > 0).
  Eigen::Matrix4d to_pixels() const;
  /// Metres per pixel at the point that the camera turns about.
  double metres_per_pixel() const;

  QImage screenshot();
  void request_render();
  void update_overlay();
  /// Whether everything is drawn that is to be drawn while nothing moves.
  bool settled() const;
  /// Points that the last frame while moving drew, and the longest such frame.
  std::size_t points_while_moving() const;
  /// As many points as this machine draws without a pause that shows.
  std::size_t points_at_once() const;
  double longest_frame_ms() const;

 Q_SIGNALS:
  void camera_changed();

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

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
};

}  // namespace turnscan::studio
