#pragma once
// Rectangle, lasso and brush: select what the mouse encloses or paints over on the screen.

#include <functional>
#include <optional>
#include <turnscan/geometry/selection/screen_selection.hpp>
#include <vector>

#include "view/scene_view.hpp"

namespace turnscan::studio {

class SelectionTool : public ViewTool {
 public:
  enum Shape { kRectangle, kLasso, kBrush };
  /// `how` as given by the keys: Shift adds, Ctrl subtracts; nullopt: as set in the panel.
  using Done = std::function<void(const ScreenRegion& region, std::optional<SelectHow> how)>;

  SelectionTool(SceneView& view, Shape shape, Done done);

  void set_radius(double pixels);

  bool press(const QPointF& at, Qt::KeyboardModifiers keys) override;
  void drag(const QPointF& at, Qt::KeyboardModifiers keys) override;
  void release(const QPointF& at) override;
  void paint(QPainter& painter) override;

 private:
  ScreenRegion region() const;

  SceneView& view_;
  Shape shape_;
  Done done_;
  double radius_px_ = 12.0;
  std::optional<SelectHow> how_;
  std::vector<Eigen::Vector2d> path_;
};

/// The current view of the user.
ScreenView screen_of(const SceneView& view);

}  // namespace turnscan::studio
