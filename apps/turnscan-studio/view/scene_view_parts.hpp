#pragma once
// Internals of SceneView, for its own sources.

#include <QVTKOpenGLNativeWidget.h>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkPlaneCollection.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>

#include <QPainter>
#include <QTimer>
#include <QVariantAnimation>
#include <algorithm>
#include <array>
#include <map>

#include "view/drawable_parts.hpp"
#include "view/large_texture.hpp"
#include "view/scene_view.hpp"
#include "widgets/theme.hpp"

namespace turnscan::studio {

/// Time without movement after which the camera is at rest.
inline constexpr int kRestAfterMs = 180;
inline constexpr double kViewAngle = 30.0;  ///< degrees, vertical
inline constexpr double kPointSize = 2.0;   ///< pixels, by default

/// The OpenGL surface; mouse events are handled by the view.
class VtkCanvas : public QVTKOpenGLNativeWidget {
 public:
  explicit VtkCanvas(SceneView* view) : QVTKOpenGLNativeWidget(view), view_(view) {}

 protected:
  bool event(QEvent* event) override;

 private:
  SceneView* view_;
};

class ViewOverlay;

/// nullptr if it has none.
vtkSmartPointer<vtkTexture> texture_of(const Drawable& drawable);

struct SceneView::Item {
  DrawablePtr drawable;
  ItemStyle style;
  /// One per chunk, created when it is first drawn: hundreds at once would cause a noticeable
  /// pause.
  std::vector<vtkSmartPointer<vtkActor>> actors;
  vtkSmartPointer<vtkActor> coarse, box;
  vtkSmartPointer<vtkTexture> texture;  ///< made with the first actor
  std::unique_ptr<LargeTexture> large;  ///< being uploaded, or complete and already in `texture`

  bool has_large_texture() const { return large && large->complete(); }
  bool waits_for_texture() const {
    return !has_large_texture() && texture && style.visible && style.own_colors &&
           !drawable->halves.empty();
  }
};

struct SceneView::Parts {
  VtkCanvas* canvas = nullptr;
  ViewOverlay* overlay = nullptr;
  vtkNew<vtkGenericOpenGLRenderWindow> window;
  std::array<vtkNew<vtkRenderer>, 2> renderers;
  vtkNew<vtkCamera> camera;
  vtkNew<vtkPlaneCollection> clip_planes;
  struct ClipPlane {
    Vec3d normal = Vec3d::Zero();
    double offset = 0.0;
    bool operator==(const ClipPlane&) const = default;
  };
  ClipPlane tool_clip, view_clip;
  std::map<int, Item> items;
  int next_item = 1;
  /// Texture of the last item that was dropped: an edit, or undoing it, usually keeps the texture.
  std::unique_ptr<LargeTexture> spare;
  std::shared_ptr<const MeshTexture> spare_of;

  const Theme* theme = nullptr;
  double point_size = kPointSize, speed = 1.0;
  bool boxes = false, split = false, occlusion = false, live = false;
  SurfaceLook look = SurfaceLook::kShaded;
  std::array<QString, 2> pane_titles;
  Legend legend;
  QString empty_title, empty_text, hint;
  QWidget* empty_actions = nullptr;
  std::function<void(QPainter&)> marks;

  Vec3d up = Vec3d::UnitY();
  Vec3d from_focus, from_offset, to_focus, to_offset;  ///< of a camera flight
  QVariantAnimation flight;

  QTimer render;  ///< triggers the next frame
  QTimer rest;    ///< fires when the camera is at rest
  QTimer more;    ///< draws the next part of the missing points
  bool moving = false, complete = false, warm = false;
  std::size_t budget = 40000, chunks_a_frame = 1, points_drawn = 0;
  double longest_ms = 0.0;
  struct Piece {
    Item* item;
    std::size_t chunk;
  };
  std::vector<Piece> pending;

  QPointF last_mouse;
  bool tool_active = false;
  bool touched = false;  ///< the user has moved the camera

  bool waits_for_texture() const {
    return std::any_of(items.begin(), items.end(),
                       [](const auto& entry) { return entry.second.waits_for_texture(); });
  }
  /// Uses the small image for now, or the texture that is already uploaded.
  void give_texture(Item& item) {
    if (spare && spare_of == item.drawable->texture) {
      item.large = std::move(spare);
      item.texture = item.large->texture();
    } else {
      item.texture = texture_of(*item.drawable);
    }
  }
  void fly(double share);
  void aim(const Vec3d& center, double size_m, const Vec3d& from, const QSize& pixels);
  void warm_up();
  void learn_from(double ms);
  void set_up_passes(double scene_size_m);
  void size_points(Item& item, double ratio, double metres_per_pixel);
  void drop(Item& item) {
    for (auto& renderer : renderers) {
      for (const auto& actor : item.actors)
        if (actor) renderer->RemoveActor(actor);
      if (item.coarse) renderer->RemoveActor(item.coarse);
      if (item.box) renderer->RemoveActor(item.box);
    }
    item.actors.clear();
    item.coarse = item.box = nullptr;
    if (item.has_large_texture()) {
      spare = std::move(item.large);
      spare_of = item.drawable->texture;
    }
    item.texture = nullptr;
    item.large = nullptr;
    pending.clear();
  }
};

Segments box_segments(const Box& box);

}  // namespace turnscan::studio
