#pragma once

#include <QWidget>
#include <memory>

class QCheckBox;
class QPushButton;

namespace turnscan::studio {

class ParagraphLabel;
struct MissingSurface;

/// Shows the surface of the selected mesh that no view saw, and offers another pass.
class SidePanel : public QWidget {
  Q_OBJECT
 public:
  explicit SidePanel(QWidget* parent = nullptr);

  /// nullptr: no missing surface is known.
  void show_missing(const std::shared_ptr<const MissingSurface>& missing);
  /// Whether the missing surface should be drawn.
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
