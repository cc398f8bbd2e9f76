#pragma once
// Measuring, cutting and the lasso: what the mouse does in the Explorer beside the camera.

#include <QPointer>
#include <QWidget>
#include <memory>
#include <optional>

#include "explorer/edits.hpp"
#include "view/scene_view.hpp"

class QButtonGroup;
class QComboBox;
class QLabel;
class QLayout;
class QPushButton;
class QSlider;

namespace turnscan::studio {

class MeasureTool;
class LassoTool;

class ToolPanel : public QWidget {
  Q_OBJECT
 public:
  explicit ToolPanel(SceneView& view, QWidget* parent = nullptr);
  ~ToolPanel() override;

  /// The box of the selected model, for the range of the plane; empty: none is selected.
  void set_box(const Box& box);
  /// Back to the camera alone.
  void stop();
  std::optional<double> measured_m() const;

 Q_SIGNALS:
  void cut_wanted(const Vec3d& normal, double offset);
  void lassoed(const Outline& outline, const Eigen::Matrix4d& to_pixels);

 private:
  QLayout* make_tool_buttons();
  QWidget* make_plane_box();
  void choose(int tool, bool on);
  void show_plane();
  std::pair<Vec3d, double> plane() const;

  SceneView& view_;
  QPointer<SceneView> alive_;
  std::unique_ptr<MeasureTool> measure_;
  std::unique_ptr<LassoTool> lasso_;
  QButtonGroup* buttons_;
  QLabel* text_;
  QWidget* plane_box_;
  QComboBox* axis_;
  QSlider* place_;
  QPushButton* flip_;
  Box box_;
};

}  // namespace turnscan::studio
