#pragma once

#include <QWidget>
#include <memory>

class QComboBox;
class QLabel;
class QPushButton;

namespace turnscan::studio {

class ParagraphLabel;
class Section;
struct ScanQuality;

/// Quality of the selected mesh: a traffic light with the figure and the sentence that matter most,
/// the other sentences folded, colouring, the report.
class VerdictPanel : public QWidget {
  Q_OBJECT
 public:
  explicit VerdictPanel(QWidget* parent = nullptr);

  /// nullptr: nothing is known about the mesh.
  void show_quality(const std::shared_ptr<const ScanQuality>& quality);
  /// The property by which to colour the mesh, see color_ways(); empty: none.
  QString color_way() const;
  /// Text of the panel, for tests and screen readers.
  QString text() const;

 Q_SIGNALS:
  void color_way_changed();
  void report_wanted();

 private:
  std::shared_ptr<const ScanQuality> quality_;
  QLabel* light_;
  ParagraphLabel *first_, *others_;
  Section* more_;
  QComboBox* colors_;
  QPushButton* report_;
};

}  // namespace turnscan::studio
