#pragma once
// Picks corresponding points on two models shown side by side.

#include <functional>
#include <turnscan/geometry/registration/point_pairs.hpp>
#include <vector>

#include "view/scene_view.hpp"

namespace turnscan::studio {

/// The nth point on the left and the nth on the right form a pair, in whichever order they are
/// clicked. On the background, and with a modifier key, the mouse rotates the camera.
class PairTool : public ViewTool {
 public:
  PairTool(SceneView& view, std::function<void()> changed);

  void clear();
  void undo();  ///< removes the last click
  std::size_t places(int pane) const;
  bool empty() const { return clicks_.empty(); }
  /// The complete pairs; the source is on the right.
  std::vector<PointPair> pairs() const;

  bool press(const QPointF& at, Qt::KeyboardModifiers keys) override;
  void paint(QPainter& painter) override;

 private:
  struct Click {
    int pane;
    Vec3d place;
  };
  void change();

  SceneView& view_;
  std::function<void()> changed_;
  std::vector<Click> clicks_;
};

}  // namespace turnscan::studio
