#include "explorer/editing/history_panel.hpp"

#include <QListWidget>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include "explorer/models.hpp"

namespace turnscan::studio {

HistoryPanel::HistoryPanel(ModelStore& store, QWidget* parent)
    : QWidget(parent), store_(store), list_(new QListWidget(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(list_);
  list_->setObjectName("history");
  list_->setAccessibleName(tr("History"));
  list_->setToolTip(tr("A click goes back to that state, or forward again"));
  list_->setMinimumHeight(130);
  connect(&store_, &ModelStore::changed, this, &HistoryPanel::fill);
  // By mouse or keys; deferred, because the list must not be refilled within its own signal.
  connect(list_, &QListWidget::currentRowChanged, this, [this](int row) {
    QMetaObject::invokeMethod(
        this, [this, row] { store_.go_to(std::size_t(std::max(0, row))); }, Qt::QueuedConnection);
  });
  fill();
}

void HistoryPanel::fill() {
  const QSignalBlocker quiet(list_);
  const QStringList steps = store_.history();
  const int now = int(store_.place_in_history());
  list_->clear();
  list_->addItem(tr("Start"));
  list_->addItems(steps);
  for (int row = now + 1; row < list_->count(); ++row)
    list_->item(row)->setForeground(palette().brush(QPalette::PlaceholderText));
  list_->setCurrentRow(now);
}

}  // namespace turnscan::studio
