#pragma once

#include <QWidget>
#include <functional>
#include <memory>
#include <turnscan/evaluation/inspection/measurement.hpp>
#include <vector>

#include "explorer/inspection/explorer_parts.hpp"
#include "explorer/models.hpp"

class QDoubleSpinBox;
class QLabel;
class QPainter;
class QPushButton;
class QTreeWidget;

namespace turnscan {
class SignedDistance;
}

namespace turnscan::studio {

class MeasureTool;
class MessageLabel;

/// Measurements made by clicks, kept in a list, drawn in the view, and exported as a table.
class MeasurePanel : public QWidget {
  Q_OBJECT
 public:
  /// The deviations of a model, or nullptr: see DeviationPanel.
  using DistanceOf = std::function<std::shared_ptr<const SignedDistance>(const Model&)>;

  MeasurePanel(const ExplorerParts& parts, DistanceOf distance_of, QWidget* parent = nullptr);
  ~MeasurePanel() override;

  const std::vector<Measurement>& kept() const { return kept_; }
  void export_csv(const QString& path);

 Q_SIGNALS:
  void said(const QString& text);

 private:
  QWidget* make_kinds();
  QWidget* make_list();
  void begin(MeasurementKind kind);
  void show_hint();
  void finish(const std::vector<Vec3d>& places);
  void keep(const Measurement& made);
  void fill_list();
  void remove_chosen();
  void export_dialog();
  void paint(QPainter& painter) const;

  ExplorerParts parts_;
  DistanceOf distance_of_;
  std::unique_ptr<MeasureTool> tool_;
  std::vector<QPushButton*> kinds_;
  QDoubleSpinBox* patch_;
  QLabel* hint_;
  MessageLabel* error_;
  QTreeWidget* list_;
  QPushButton *remove_, *clear_, *export_;
  MeasurementKind kind_ = MeasurementKind::kDistance;
  std::vector<Measurement> kept_;
};

}  // namespace turnscan::studio
