#pragma once

#include <QWidget>
#include <memory>

class QComboBox;
class QLabel;
class QPushButton;

namespace turnscan::studio {

class ParagraphLabel;
struct ScanQuality;

/// How good the selected mesh is: a light, a sentence for each property, colours, the report.
class VerdictPanel : public QWidget {
  Q_OBJECT
 public:
  explicit VerdictPanel(QWidget* parent = nullptr);

  /// nullptr: nothing is known of the mesh.
  void show_quality(const std::shared_ptr<const ScanQuality>& quality);
  /// What the mesh is to be coloured by, see color_ways(); empty: as it is.
  QString color_way() const;
  /// What stands on the panel, for tests and screen readers.
  QString text() const;

 Q_SIGNALS:
  void color_way_changed();
  void report_wanted();

 private:
  std::shared_ptr<const ScanQuality> quality_;
  QLabel* light_;
  ParagraphLabel* sentences_;
  QComboBox* colors_;
  QPushButton* report_;
};

}  // namespace turnscan::studio
