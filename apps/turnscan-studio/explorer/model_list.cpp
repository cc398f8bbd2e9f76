#include "explorer/model_list.hpp"

#include <QColorDialog>
#include <QFontDatabase>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QMenu>
#include <QPainter>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSignalBlocker>
#include <QToolButton>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <QVariant>
#include <algorithm>

#include "explorer/models.hpp"
#include "widgets/section.hpp"

namespace turnscan::studio {

namespace {

constexpr int kIdRole = Qt::UserRole;
constexpr int kMinRows = 3, kMaxRows = 8;  // visible at once

QIcon swatch(const Model& model) {
  QPixmap picture(28, 28);
  picture.setDevicePixelRatio(2.0);
  picture.fill(Qt::transparent);
  QPainter painter(&picture);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(QColor(0, 0, 0, 70), 1));
  painter.setBrush(model.color);
  painter.drawRoundedRect(QRectF(1.5, 1.5, 11, 11), 3, 3);
  return QIcon(picture);
}

}  // namespace

ModelList::ModelList(ModelStore& store, QWidget* parent)
    : QWidget(parent),
      store_(store),
      tree_(new QTreeWidget(this)),
      properties_(new QPlainTextEdit(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  tree_->setObjectName("model_list");
  tree_->setAccessibleName(tr("Models"));
  tree_->setHeaderHidden(true);
  tree_->setColumnCount(2);
  tree_->setRootIsDecorated(false);
  tree_->setIndentation(4);
  tree_->header()->setStretchLastSection(false);
  tree_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  tree_->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
  tree_->setEditTriggers(QAbstractItemView::EditKeyPressed | QAbstractItemView::DoubleClicked);
  tree_->setContextMenuPolicy(Qt::CustomContextMenu);
  properties_->setObjectName("model_properties");
  properties_->setAccessibleName(tr("Properties of the selected model"));
  properties_->setReadOnly(true);
  properties_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  properties_->setLineWrapMode(QPlainTextEdit::WidgetWidth);
  properties_->setFixedHeight(112);
  properties_->setPlaceholderText(tr("Properties of the selected model"));
  layout->addWidget(make_buttons());
  layout->addWidget(tree_);
  layout->addWidget(properties_);
  show_properties();
  connect(&store_, &ModelStore::changed, this, &ModelList::fill);
  connect(tree_, &QTreeWidget::itemChanged, this, &ModelList::on_item_changed);
  connect(tree_, &QTreeWidget::currentItemChanged, this, [this] {
    if (filling_) return;
    show_properties();
    Q_EMIT selection_changed(selected());
  });
}

QWidget* ModelList::make_buttons() {
  auto* row = new QWidget(this);
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(6);
  auto* open = primary_button(tr("Open…"), tr("Load meshes, clouds or recordings (Ctrl+O)"), row);
  auto* save = button(tr("Save…"), tr("Save the selected model (Ctrl+S)"), row);
  auto* edit = tool_button(tr("Edit"), tr("Rename, colour, duplicate, delete"), row);
  edit->setObjectName("tool");
  edit->setMenu(make_edit_menu(edit));
  edit->setProperty("menu", true);
  edit->setPopupMode(QToolButton::InstantPopup);
  layout->addWidget(open, 1);
  layout->addWidget(save);
  layout->addWidget(edit);
  connect(open, &QPushButton::clicked, this, &ModelList::open_wanted);
  connect(save, &QPushButton::clicked, this, &ModelList::save_wanted);
  const auto enable = [this, save, edit] {
    save->setEnabled(selected() != 0);
    edit->setEnabled(selected() != 0);
  };
  connect(this, &ModelList::selection_changed, row, enable);
  connect(&store_, &ModelStore::changed, row, enable, Qt::QueuedConnection);
  enable();
  return row;
}

QMenu* ModelList::make_edit_menu(QWidget* parent) {
  auto* menu = new QMenu(parent);
  const auto act = [&](const QString& name, auto action) {
    connect(menu->addAction(name), &QAction::triggered, this, action);
  };
  act(tr("Rename"), [this] { rename_selected(); });
  act(tr("Colour…"), [this] { choose_color(); });
  act(tr("Own colours on/off"), [this] {
    if (const Model* m = store_.find(selected())) store_.set_color(m->id, m->color, !m->own_colors);
  });
  auto* duplicate = menu->addAction(tr("Duplicate"));
  duplicate->setShortcut(QKeySequence("Ctrl+D"));
  addAction(duplicate);  // a shortcut of a menu alone only works while the menu is open
  connect(duplicate, &QAction::triggered, this, [this] { store_.duplicate(selected()); });
  menu->addSeparator();
  act(tr("Delete\tDel"), [this] { store_.remove(selected()); });
  connect(tree_, &QTreeWidget::customContextMenuRequested, menu, [this, menu](const QPoint& at) {
    if (tree_->itemAt(at)) menu->popup(tree_->viewport()->mapToGlobal(at));
  });
  return menu;
}

int ModelList::selected() const {
  const QTreeWidgetItem* item = tree_->currentItem();
  return item ? item->data(0, kIdRole).toInt() : 0;
}

void ModelList::select(int id) {
  for (int i = 0; i < tree_->topLevelItemCount(); ++i)
    if (tree_->topLevelItem(i)->data(0, kIdRole).toInt() == id)
      tree_->setCurrentItem(tree_->topLevelItem(i));
}

void ModelList::rename_selected() {
  if (tree_->currentItem()) tree_->editItem(tree_->currentItem(), 0);
}

void ModelList::fill() {
  const int current = selected();
  filling_ = true;
  tree_->clear();
  for (const Model& model : store_.models()) {
    auto* item = new QTreeWidgetItem(tree_);
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsEditable |
                   Qt::ItemIsUserCheckable);
    item->setCheckState(0, model.visible ? Qt::Checked : Qt::Unchecked);
    item->setText(0, model.name);
    item->setIcon(0, swatch(model));
    item->setText(1, count_text(*model.data));
    item->setForeground(1, palette().brush(QPalette::PlaceholderText));
    item->setToolTip(0, model.data->source);
    item->setData(0, kIdRole, model.id);
  }
  select(current);
  if (!tree_->currentItem() && tree_->topLevelItemCount() > 0)
    tree_->setCurrentItem(tree_->topLevelItem(tree_->topLevelItemCount() - 1));
  filling_ = false;
  fit_height();
  show_properties();
  Q_EMIT selection_changed(selected());
}

/// Fits the height to the content, because users look for the verdict below.
void ModelList::fit_height() {
  const int rows = std::clamp(tree_->topLevelItemCount(), kMinRows, kMaxRows);
  const int row =
      tree_->topLevelItemCount() > 0 ? tree_->visualItemRect(tree_->topLevelItem(0)).height() : 24;
  tree_->setFixedHeight(rows * row + 2 * tree_->contentsMargins().top());
}

void ModelList::on_item_changed(QTreeWidgetItem* item, int column) {
  if (filling_ || column != 0) return;
  const int id = item->data(0, kIdRole).toInt();
  const Model* model = store_.find(id);
  if (!model) return;
  // The change refills the list, which must not happen within its own signal.
  const bool visible = item->checkState(0) == Qt::Checked;
  const QString name = item->text(0);
  QMetaObject::invokeMethod(
      this,
      [this, id, visible, name] {
        store_.set_visible(id, visible);
        store_.rename(id, name);
      },
      Qt::QueuedConnection);
}

void ModelList::choose_color() {
  const Model* model = store_.find(selected());
  if (!model) return;
  const QColor color =
      QColorDialog::getColor(model->color, this, tr("Colour of %1").arg(model->name));
  if (color.isValid()) store_.set_color(model->id, color, false);
}

void ModelList::show_properties() {
  const Model* model = store_.find(selected());
  properties_->setPlainText(model ? model->data->report : QString());
  properties_->setVisible(!store_.models().empty());
  tree_->setVisible(!store_.models().empty());
}

}  // namespace turnscan::studio
