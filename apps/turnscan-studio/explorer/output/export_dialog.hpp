#pragma once

#include <QDialog>

#include "explorer/output/export_model.hpp"

class QComboBox;
class QLabel;
class QLineEdit;

namespace turnscan::studio {

/// Options for exporting a model: format, unit, up axis, triangles, colours. Remembers the last
/// choices.
class ExportDialog : public QDialog {
  Q_OBJECT
 public:
  ExportDialog(const ModelData& model, const QString& name, QWidget* parent = nullptr);

  ExportOptions options() const;
  QString ending() const;  ///< including the dot
  void accept() override;

 private:
  void follow();
  std::size_t triangles() const;

  const ModelKind kind_;
  const bool colored_, textured_;
  const std::size_t all_triangles_;
  QComboBox *format_, *unit_, *up_, *colors_;
  QLineEdit* triangles_;
  QLabel* note_;
};

}  // namespace turnscan::studio
