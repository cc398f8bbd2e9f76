#pragma once

#include <QWidget>
#include <map>
#include <memory>
#include <optional>

#include "explorer/models.hpp"
#include "view/scene_view.hpp"

class QCheckBox;
class QLabel;
class QPushButton;
class QSlider;
class QSpinBox;

namespace turnscan {
class CloudCubes;
}

namespace turnscan::studio {

class JobRunner;

/// Draws clouds with counts, such as voxels, as cubes, those above a threshold only.
class VoxelPanel : public QWidget {
  Q_OBJECT
 public:
  explicit VoxelPanel(ModelStore& store, QWidget* parent = nullptr);
  ~VoxelPanel() override;

  /// Voxels and sub-voxels that a stage has made become cubes. 0: no model.
  void show_model(int id);
  /// Whether that model has counts.
  bool applies() const;
  /// The cubes of a model; nullptr: it is not shown so.
  DrawablePtr drawable_of(const Model& model) const;
  /// The threshold of its cubes; 0: it has none.
  int least_of(const Model& model) const;
  /// Of the cubes of the model that is shown; nullopt: there are none.
  std::optional<Legend> legend() const;

 Q_SIGNALS:
  void changed();
  /// The threshold is to be used as voxel-min-points.
  void threshold_wanted(int least);

 private:
  struct Cubes {
    bool on = false;
    int least = 0;
    std::shared_ptr<const CloudCubes> cubes;
    DrawablePtr drawable;
  };
  void build();
  const ModelDataPtr& data() const;
  void set_on(bool on);
  void set_least(int least);
  void show_kept();
  void rebuild();
  void forget_removed();

  ModelStore& store_;
  JobRunner* quick_;
  int model_ = 0;
  std::map<ModelDataPtr, Cubes> cubes_;
  std::vector<float> counts_;  ///< of the shown model, ascending
  bool again_ = false;         ///< the threshold has changed while cubes were made
  QCheckBox* on_;
  QSpinBox* least_;
  QSlider* slider_;
  QLabel* kept_;
  QPushButton* use_;
};

}  // namespace turnscan::studio
