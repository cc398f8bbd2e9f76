#pragma once

#include <QPointer>
#include <QWidget>

#include "view/scene_view.hpp"

class QCheckBox;
class QComboBox;
class QPushButton;
class QSlider;

namespace turnscan::studio {

class ModelStore;

/// Appearance of the models: surfaces, opacity, isolation, a clipping plane, ambient occlusion.
class LookPanel : public QWidget {
  Q_OBJECT
 public:
  LookPanel(SceneView& view, ModelStore& store, QWidget* parent = nullptr);

  /// Sets the model to which the opacity applies; 0: none.
  void show_model(int id);
  /// Whether only the selected model is shown.
  bool isolated() const;

 Q_SIGNALS:
  void isolation_changed();
  void movie_wanted();
  void stages_wanted();

 private:
  QWidget* make_clip_row();
  void follow();
  void clip();

  QPointer<SceneView> view_;
  ModelStore& store_;
  int model_ = 0;
  QComboBox *surface_, *axis_;
  QSlider *opacity_, *place_;
  QPushButton *isolate_, *flip_, *movie_, *stages_;
  QCheckBox* occlusion_;
};

}  // namespace turnscan::studio
