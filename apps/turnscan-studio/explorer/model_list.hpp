#pragma once

#include <QWidget>

class QMenu;
class QPlainTextEdit;
class QTreeWidget;
class QTreeWidgetItem;

namespace turnscan::studio {

class ModelStore;

/// List of the models: show and hide, rename, duplicate, delete, colour, counts, properties.
class ModelList : public QWidget {
  Q_OBJECT
 public:
  explicit ModelList(ModelStore& store, QWidget* parent = nullptr);

  int selected() const;  ///< 0: none
  void select(int id);
  void rename_selected();

 Q_SIGNALS:
  void selection_changed(int id);
  void open_wanted();
  void save_wanted();

 private:
  void fill();
  void fit_height();
  void on_item_changed(QTreeWidgetItem* item, int column);
  void choose_color();
  void show_properties();
  QWidget* make_buttons();
  QMenu* make_edit_menu(QWidget* parent);

  ModelStore& store_;
  QTreeWidget* tree_;
  QPlainTextEdit* properties_;
  bool filling_ = false;
};

}  // namespace turnscan::studio
