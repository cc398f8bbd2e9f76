#pragma once

#include <QTimer>
#include <QWidget>
#include <optional>
#include <turnscan/evaluation/inspection/section.hpp>

#include "explorer/inspection/explorer_parts.hpp"
#include "explorer/models.hpp"

class QPushButton;

namespace turnscan::studio {

class MessageLabel;
class ParagraphLabel;
class PlaneBox;

/// A section plane through the models, with the selected one capped at the cut, and the drawing of
/// the section.
class SectionPanel : public QWidget {
  Q_OBJECT
 public:
  explicit SectionPanel(const ExplorerParts& parts, QWidget* parent = nullptr);
  ~SectionPanel() override;

  const std::optional<turnscan::Section>& section() const { return section_; }
  /// As DXF if the file has that extension, else as SVG.
  void export_drawing(const QString& path);

 Q_SIGNALS:
  void said(const QString& text);

 private:
  void follow_model();
  void show_plane(bool on);
  void update_section();
  void take(const turnscan::Section& made, DrawablePtr contour, DrawablePtr cap,
            const QString& problem);
  void clear_drawn();
  void export_dialog(const QString& ending, const QString& filter);
  const Model* target() const;

  ExplorerParts parts_;
  PlaneBox* plane_;
  QPushButton *on_, *dxf_, *svg_;
  ParagraphLabel* figures_;
  MessageLabel* error_;
  QTimer later_;     ///< fires when the plane has stopped moving
  ModelDataPtr of_;  ///< model to which the section belongs
  bool running_ = false, again_ = false;
  std::optional<turnscan::Section> section_;
  int contour_item_ = 0, cap_item_ = 0;
};

}  // namespace turnscan::studio
