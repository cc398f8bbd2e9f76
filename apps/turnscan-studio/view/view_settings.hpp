#pragma once
// View settings shared by the three modes, and their controls at the top of every panel.

#include <QObject>
#include <QWidget>

namespace turnscan::studio {

class SceneView;
struct Theme;

class ViewSettings : public QObject {
  Q_OBJECT
 public:
  explicit ViewSettings(QObject* parent = nullptr);

  double camera_speed() const { return camera_speed_; }
  double point_size() const { return point_size_; }
  bool boxes() const { return boxes_; }
  bool dark() const { return dark_; }
  const Theme& theme() const;

  void set_camera_speed(double factor);
  void set_point_size(double pixels);
  void set_boxes(bool on);
  void set_dark(bool on);

  /// Applies these settings to the view, now and after changes.
  void attach(SceneView* view);

 Q_SIGNALS:
  void changed();

 private:
  void store();
  double camera_speed_ = 1.0, point_size_ = 2.0;
  bool boxes_ = false, dark_ = false;
};

/// Reset camera, standard views, camera speed, point size, bounding boxes.
class ViewPanel : public QWidget {
  Q_OBJECT
 public:
  ViewPanel(ViewSettings& settings, SceneView& view, QWidget* parent = nullptr);
};

}  // namespace turnscan::studio
