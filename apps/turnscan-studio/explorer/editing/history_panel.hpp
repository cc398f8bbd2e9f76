#pragma once

#include <QWidget>

class QListWidget;

namespace turnscan::studio {

class ModelStore;

/// All states reachable by undo and redo, oldest first; a click goes there.
class HistoryPanel : public QWidget {
  Q_OBJECT
 public:
  explicit HistoryPanel(ModelStore& store, QWidget* parent = nullptr);

 private:
  void fill();

  ModelStore& store_;
  QListWidget* list_;
};

}  // namespace turnscan::studio
