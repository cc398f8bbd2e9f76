#pragma once
// A contact sheet: what the stages have made, side by side.

#include <QDialog>
#include <QImage>

#include "explorer/models.hpp"

namespace turnscan::studio {

struct ShownStage {
  Model model;
  int least = 0;  ///< smallest count of a cell that is shown
};

/// Meshes, and clouds as cubes, each in a picture of its own from the same side, with its name and
/// size below. Recordings are left out. Runs on a worker thread. Fails with kTooFewPoints if
/// nothing is left, and as render_picture() does.
Result<QImage> stage_sheet(const std::vector<ShownStage>& stages, const RunContext& context);

/// Shows it, and saves it as a picture.
class SheetDialog : public QDialog {
  Q_OBJECT
 public:
  SheetDialog(const QImage& sheet, QWidget* parent);
  void save_as(const QString& path);

 Q_SIGNALS:
  void saved(const QString& path);
  void failed(const QString& text);

 private:
  QImage sheet_;
};

}  // namespace turnscan::studio
