#pragma once

#include <QWidget>
#include <memory>
#include <optional>
#include <turnscan/evaluation/inspection/deviations.hpp>
#include <vector>

#include "explorer/inspection/explorer_parts.hpp"
#include "explorer/models.hpp"
#include "view/scene_view.hpp"

class QComboBox;
class QDoubleSpinBox;
class QPushButton;

namespace turnscan::studio {

class MessageLabel;
class ParagraphLabel;

/// Signed distances of the selected model to a reference, colour-coded with a tolerance band; and
/// its alignment to the reference.
class DeviationPanel : public QWidget {
  Q_OBJECT
 public:
  explicit DeviationPanel(const ExplorerParts& parts, QWidget* parent = nullptr);
  ~DeviationPanel() override;

  /// The model coloured by its deviations; nullptr: it has none.
  DrawablePtr drawable_of(const Model& model) const;
  /// Whether a model must not be drawn because it is the reference of one that is.
  bool hides(int id) const;
  /// Legend of the visible colours; nullopt if none are shown.
  std::optional<Legend> legend() const;
  /// For the deviation at any point on a model; nullptr: not computed for it.
  std::shared_ptr<const SignedDistance> distance_of(const Model& model) const;
  const std::vector<float>& values() const { return shown_.values; }

  /// One line per vertex or point, as deviations_csv().
  void export_csv(const QString& path);

 Q_SIGNALS:
  void changed();
  void said(const QString& text);

 private:
  /// For one model at a time.
  struct Shown {
    ModelDataPtr of;
    int reference = 0;
    QString name, reference_name;
    std::shared_ptr<const SignedDistance> distance;
    std::vector<float> values, weights;
    double range_m = 0.0;  ///< of the colours
    DrawablePtr drawable;
  };

  void fill();
  void enable();
  void run();
  void align();
  void recolor();
  void hide_colors();
  void show_figures();
  void export_dialog();
  const Model* shown_model() const;
  const Model* target() const;
  const Model* reference() const;
  double tolerance_m() const;
  static double range_of(const std::vector<float>& values, double wanted_m);
  static DrawablePtr color(const ModelData& data, const std::vector<float>& values,
                           double tolerance_m, double range_m);

  ExplorerParts parts_;
  QComboBox* reference_;
  QDoubleSpinBox *tolerance_, *range_;
  QPushButton *run_, *align_, *hide_, *export_;
  ParagraphLabel* figures_;
  MessageLabel* error_;
  Shown shown_;
};

}  // namespace turnscan::studio
