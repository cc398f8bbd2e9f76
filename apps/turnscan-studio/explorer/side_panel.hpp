#pragma once

#include <QWidget>
#include <memory>

class QCheckBox;
class QPushButton;

namespace turnscan::studio {

class ParagraphLabel;
struct MissingSurface;

/// What no view saw of the selected mesh, and the way to another pass.
class SidePanel : public QWidget {
  Q_OBJECT
 public:
  explicit SidePanel(QWidget* parent = nullptr);

  /// nullptr: nothing is known to be missing.
  void show_missing(const std::shared_ptr<const MissingSurface>& missing);
  /// Whether the missing surface is to be drawn.
  bool drawn() const;

 Q_SIGNALS:
  void scan_wanted();
  void drawn_changed();

 private:
  ParagraphLabel* text_;
  QCheckBox* draw_;
  QPushButton* scan_;
};

}  // namespace turnscan::studio
