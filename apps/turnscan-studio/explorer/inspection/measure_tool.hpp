#pragma once
// Picks points on models, and draws measurements over the picture.

#include <QString>
#include <functional>
#include <turnscan/evaluation/inspection/measurement.hpp>
#include <vector>

#include "view/scene_view.hpp"

namespace turnscan::studio {

/// Collects points on what is drawn; on the background the mouse rotates the camera.
class MeasureTool : public ViewTool {
 public:
  using Done = std::function<void(const std::vector<Vec3d>&)>;

  /// `clicked` is called after each point, `done` after the last of `count`; then it starts anew.
  MeasureTool(SceneView& view, std::function<void()> clicked, Done done);

  void begin(std::size_t count);
  std::size_t clicked() const { return places_.size(); }

  bool press(const QPointF& at, Qt::KeyboardModifiers keys) override;
  void paint(QPainter& painter) override;

 private:
  SceneView& view_;
  std::function<void()> clicked_;
  Done done_;
  std::size_t count_ = 1;
  std::vector<Vec3d> places_;
};

/// Draws its lines and points, with the text on a card next to them.
void paint_measurement(QPainter& painter, const SceneView& view, const Measurement& measurement,
                       const QString& text, bool highlighted);

}  // namespace turnscan::studio
