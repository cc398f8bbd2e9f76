#include "explorer/output/queue_dialog.hpp"

#include <QDir>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QMimeData>
#include <QPointer>
#include <QPushButton>
#include <QSettings>
#include <QTableWidget>
#include <QVBoxLayout>

#include "app/jobs.hpp"
#include "app/paths.hpp"
#include "explorer/explorer.hpp"
#include "widgets/section.hpp"

namespace turnscan::studio {

namespace {

constexpr int kPathRole = Qt::UserRole, kStateRole = Qt::UserRole + 1;
const QString kWaits = "waits", kQueued = "queued", kDone = "done", kFailed = "failed";

}  // namespace

QueueDialog::QueueDialog(ExplorerMode& mode, JobRunner& jobs, QWidget* parent)
    : QDialog(parent), mode_(mode), table_(new QTableWidget(0, 2, this)), folder_(nullptr) {
  setObjectName("queue");
  setWindowTitle(tr("Reconstruct several recordings"));
  setAcceptDrops(true);
  resize(640, 380);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(quiet_label(
      tr("They are reconstructed one after the other with the options of the Model Explorer. Add "
         "recordings, or drop them here."),
      this));
  table_->setObjectName("queue_table");
  table_->setAccessibleName(tr("Recordings in the queue"));
  table_->setHorizontalHeaderLabels({tr("Recording"), tr("State")});
  table_->horizontalHeader()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
  table_->horizontalHeader()->setStretchLastSection(true);
  table_->verticalHeader()->hide();
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  layout->addWidget(table_, 1);
  auto* row = new QHBoxLayout;
  auto* label = new QLabel(tr("Write meshes to"), this);
  folder_ = new QLineEdit(shown_path(QSettings().value("queue/folder").toString()), this);
  folder_->setObjectName("queue_folder");
  folder_->setPlaceholderText(tr("nowhere: they are in the Model Explorer only"));
  label->setBuddy(folder_);
  row->addWidget(label);
  row->addWidget(folder_, 1);
  layout->addLayout(row);
  layout->addWidget(make_buttons());
  connect(&jobs, &JobRunner::started, this, [this](const QString& title) {
    for (int i = 0; i < table_->rowCount(); ++i)
      if (state_of(i) == kQueued &&
          title == ExplorerMode::queue_title(table_->item(i, 0)->data(kPathRole).toString()))
        table_->item(i, 1)->setText(tr("running"));
  });
  connect(&jobs, &JobRunner::cancelled, this, [this](const QString& title) {
    for (int i = 0; i < table_->rowCount(); ++i) {
      const QString path = table_->item(i, 0)->data(kPathRole).toString();
      if (state_of(i) == kQueued && title == ExplorerMode::queue_title(path))
        set_state(path, kWaits, tr("cancelled"));
    }
  });
  follow();
}

QWidget* QueueDialog::make_buttons() {
  auto* bar = new QWidget(this);
  auto* row = new QHBoxLayout(bar);
  row->setContentsMargins(0, 0, 0, 0);
  auto* add_folder = button(tr("Add recording…"), tr("The folder of a recording"), bar);
  auto* add_files = button(tr("Add files…"), tr("Recordings of other programs"), bar);
  remove_ = button(tr("Remove"), tr("Take the selected ones off the list"), bar);
  start_ = primary_button(tr("Reconstruct all"), tr("Begin with the first that waits"), bar);
  start_->setProperty("queue", true);
  row->addWidget(add_folder);
  row->addWidget(add_files);
  row->addWidget(remove_);
  row->addStretch();
  row->addWidget(start_);
  connect(add_folder, &QPushButton::clicked, this, [this] {
    const QString folder = QFileDialog::getExistingDirectory(this, tr("Add a recording"));
    if (!folder.isEmpty()) add({folder});
  });
  connect(add_files, &QPushButton::clicked, this,
          [this] { add(QFileDialog::getOpenFileNames(this, tr("Add recordings"))); });
  connect(remove_, &QPushButton::clicked, this, &QueueDialog::remove_selected);
  connect(start_, &QPushButton::clicked, this, &QueueDialog::start);
  return bar;
}

void QueueDialog::add(const QStringList& recordings) {
  for (const QString& each : recordings) {
    const QString path = QDir(each).absolutePath();
    if (row_of(path) >= 0) continue;
    const int row = table_->rowCount();
    table_->insertRow(row);
    auto* name = new QTableWidgetItem(shown_path(path));
    name->setData(kPathRole, path);
    table_->setItem(row, 0, name);
    table_->setItem(row, 1, new QTableWidgetItem);
    set_state(path, kWaits, tr("waits"));
  }
}

void QueueDialog::remove_selected() {
  for (int i = table_->rowCount() - 1; i >= 0; --i)
    if (table_->item(i, 0)->isSelected() && state_of(i) != kQueued) table_->removeRow(i);
  follow();
}

void QueueDialog::start() {
  const QString folder = typed_path(folder_->text());
  QSettings().setValue("queue/folder", folder);
  for (int i = 0; i < table_->rowCount(); ++i) {
    if (state_of(i) != kWaits) continue;
    const QString path = table_->item(i, 0)->data(kPathRole).toString();
    set_state(path, kQueued, tr("queued"));
    const QPointer<QueueDialog> self(this);
    mode_.reconstruct_queued(path, folder, [self, path](bool good, const QString& text) {
      if (self) self->set_state(path, good ? kDone : kFailed, text);
    });
  }
}

void QueueDialog::set_state(const QString& recording, const QString& state, const QString& text) {
  const int row = row_of(recording);
  if (row < 0) return;
  table_->item(row, 1)->setData(kStateRole, state);
  table_->item(row, 1)->setText(text);
  table_->item(row, 1)->setToolTip(text);
  follow();
}

int QueueDialog::row_of(const QString& recording) const {
  for (int i = 0; i < table_->rowCount(); ++i)
    if (table_->item(i, 0)->data(kPathRole).toString() == recording) return i;
  return -1;
}

QString QueueDialog::state_of(int row) const {
  return table_->item(row, 1)->data(kStateRole).toString();
}

void QueueDialog::follow() {
  bool any = false;
  for (int i = 0; i < table_->rowCount(); ++i) any = any || state_of(i) == kWaits;
  start_->setEnabled(any);
  remove_->setEnabled(table_->rowCount() > 0);
}

void QueueDialog::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void QueueDialog::dropEvent(QDropEvent* event) {
  QStringList paths;
  for (const QUrl& url : event->mimeData()->urls())
    if (url.isLocalFile()) paths << url.toLocalFile();
  add(paths);
}

}  // namespace turnscan::studio
