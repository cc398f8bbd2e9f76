#pragma once

#include <QWidget>
#include <functional>
#include <memory>
#include <turnscan/core/run_context.hpp>
#include <turnscan/geometry/selection/screen_selection.hpp>
#include <vector>

#include "app/jobs.hpp"
#include "explorer/inspection/explorer_parts.hpp"
#include "explorer/models.hpp"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QPushButton;
class QSpinBox;

namespace turnscan::studio {

class MessageLabel;
class PlaneBox;
class SelectionTool;

/// Selects parts of the selected model on the screen, highlights and edits them; each edit is one
/// undo step.
class EditPanel : public QWidget {
  Q_OBJECT
 public:
  explicit EditPanel(const ExplorerParts& parts, QWidget* parent = nullptr);
  ~EditPanel() override;

  std::size_t selected() const { return count_selected(selection()); }
  /// Selection in the model that is selected and visible; else empty.
  const Selection& selection() const;
  /// Does nothing and returns false if nothing is selected: the model as a whole is deleted
  /// elsewhere.
  bool delete_selected();

 Q_SIGNALS:
  void said(const QString& text);

 private:
  /// Result of an edit and its description; computed on a worker thread.
  struct Edited {
    ModelDataPtr data;
    QString text;
  };
  using Edit = std::function<Result<Edited>(const ModelData&, const Selection&, const RunContext&)>;
  using Change = std::function<Selection(const ModelData&, const Selection&)>;

  QWidget* make_tools();
  QWidget* make_changes();
  QWidget* make_edits();
  QWidget* make_cut();
  void add_tool(QPushButton* button, int shape);
  void pick(const ScreenRegion& region, std::optional<SelectHow> how);
  void change(const QString& what, const Change& made);
  void select_small_pieces();
  Finish take_selection(const ModelDataPtr& of, Selection made);
  void draw_selection();
  void follow_model();
  void show_count();
  void edit(const QString& what, const Edit& made);
  void fill_holes_beside();
  void smooth();
  void reduce();
  void show_plane(bool on);
  void cut();
  const Model* target() const;

  ExplorerParts parts_;
  std::vector<std::unique_ptr<SelectionTool>> tools_;
  std::vector<QPushButton*> of_any_, of_mesh_, of_selection_;
  QComboBox* how_;
  QCheckBox* through_;
  QSpinBox* radius_;
  QLabel* count_;
  QDoubleSpinBox* wavelength_;
  QSpinBox* triangles_;
  QPushButton* cut_on_;
  PlaneBox* plane_;
  QWidget* plane_row_;
  MessageLabel* error_;

  DrawablePtr drawn_;  ///< the selection, as drawn
  int item_ = 0;       ///< in the view
};

}  // namespace turnscan::studio
