#pragma once

#include <QWidget>
#include <set>

#include "explorer/models.hpp"

class QMenu;
class QPlainTextEdit;
class QTreeWidget;
class QTreeWidgetItem;

namespace turnscan::studio {

/// Tree of the models: below a recording its passes and what stages made of it. Show and hide,
/// rename, duplicate, delete, colour, counts, properties, and what made each.
class ModelList : public QWidget {
  Q_OBJECT
 public:
  explicit ModelList(ModelStore& store, QWidget* parent = nullptr);

  int selected() const;  ///< 0: none
  /// The pass that is selected below a recording, which is the selected model; else the first.
  std::uint32_t selected_pass() const;
  void select(int id);
  void rename_selected();

 Q_SIGNALS:
  void selection_changed(int id);
  void open_wanted();
  void save_wanted();
  /// The options of a run are to be set as they were for these models.
  void settings_wanted(const MadeWithPtr& made);

 private:
  void fill();
  void select(int id, const QVariant& pass);
  QTreeWidgetItem* make_item(const Model& model);
  void add_passes(const Model& model, QTreeWidgetItem* recording);
  void on_item_changed(QTreeWidgetItem* item, int column);
  void choose_color();
  void show_properties();
  QWidget* make_buttons();
  QMenu* make_edit_menu(QWidget* parent);

  ModelStore& store_;
  QTreeWidget* tree_;
  QPlainTextEdit* properties_;
  std::set<int> folded_;  ///< models whose nodes are closed
  bool filling_ = false;
};

}  // namespace turnscan::studio
