#pragma once
// The same places clicked on two models side by side.

#include <functional>
#include <turnscan/geometry/registration/point_pairs.hpp>
#include <vector>

#include "view/scene_view.hpp"

namespace turnscan::studio {

/// The nth place on the left and the nth on the right are a pair, in whichever order they are
/// clicked. On the background, and with a key held, the mouse turns the camera.
class PairTool : public ViewTool {
 public:
  PairTool(SceneView& view, std::function<void()> changed);

  void clear();
  void undo();  ///< the last click
  std::size_t places(int pane) const;
  bool empty() const { return clicks_.empty(); }
  /// Those that are whole; the source is on the right.
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
