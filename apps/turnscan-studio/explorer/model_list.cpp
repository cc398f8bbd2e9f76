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
#include <QTreeWidgetItemIterator>
#include <QVBoxLayout>
#include <QVariant>
#include <turnscan/workflow/passes/joined_frames.hpp>

#include "widgets/section.hpp"
#include "widgets/text.hpp"

namespace turnscan::studio {

namespace {

constexpr int kIdRole = Qt::UserRole, kPassRole = Qt::UserRole + 1;
enum Column { kNameColumn, kMarkColumn };

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

/// "Voxel grid 100 (default auto)"
QString changed_text(const ResolvedParameter& option) {
  return QObject::tr("%1 %2 (default %3)")
      .arg(translated_title(option.option), short_value(QString::fromStdString(option.value)),
           short_value(QString::fromStdString(option.reason)));
}

QString changed_texts(const MadeWith& made) {
  QStringList texts;
  for (const ResolvedParameter& option : made.changed) texts << changed_text(option);
  return texts.join("\n");
}

QString made_text(const Model& model) {
  if (!model.made) return {};
  QString text = model.made->changed.empty() ? QObject::tr("Made with the defaults")
                                             : QObject::tr("Made with");
  for (const ResolvedParameter& option : model.made->changed)
    text += QString("\n≠ %1").arg(changed_text(option));
  if (!model.made->chosen.empty()) text += QObject::tr("\nFound from the data");
  for (const ResolvedParameter& option : model.made->chosen)
    text += QString("\n  %1 %2")
                .arg(translated_title(option.option),
                     short_value(QString::fromStdString(option.value)));
  if (model.own) text += QObject::tr("\nEdited or duplicated since");
  return text + "\n\n";
}

/// Below its recording, whose name it would repeat.
QString short_name(const Model& model, const Model* parent) {
  const QString prefix = parent ? parent->name + " " : QString();
  return parent && model.name.startsWith(prefix) ? model.name.mid(prefix.size()) : model.name;
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
  tree_->setIndentation(14);
  tree_->header()->setMinimumSectionSize(0);
  tree_->header()->setStretchLastSection(false);
  tree_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  tree_->header()->setSectionResizeMode(kNameColumn, QHeaderView::Stretch);
  tree_->setEditTriggers(QAbstractItemView::EditKeyPressed | QAbstractItemView::DoubleClicked);
  tree_->setContextMenuPolicy(Qt::CustomContextMenu);
  properties_->setObjectName("model_properties");
  properties_->setAccessibleName(tr("Properties of the selected model"));
  properties_->setReadOnly(true);
  properties_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  properties_->setLineWrapMode(QPlainTextEdit::WidgetWidth);
  properties_->setPlaceholderText(tr("Properties of the selected model"));
  layout->addWidget(make_buttons());
  layout->addWidget(tree_, 3);
  layout->addWidget(properties_, 2);
  show_properties();
  connect(&store_, &ModelStore::changed, this, &ModelList::fill);
  connect(tree_, &QTreeWidget::itemChanged, this, &ModelList::on_item_changed);
  const auto fold = [this](bool folded) {
    return [this, folded](const QTreeWidgetItem* item) {
      const int id = item->data(kNameColumn, kIdRole).toInt();
      if (!filling_) folded ? void(folded_.insert(id)) : void(folded_.erase(id));
    };
  };
  connect(tree_, &QTreeWidget::itemCollapsed, this, fold(true));
  connect(tree_, &QTreeWidget::itemExpanded, this, fold(false));
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
  layout->setSpacing(2);  // the column is as narrow as this row
  auto* open = button(tr("Open…"), tr("Load meshes, clouds or recordings (Ctrl+O)"), row);
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
  act(tr("Use its settings"), [this] {
    const Model* model = store_.find(selected());
    if (model && model->made) Q_EMIT settings_wanted(model->made);
  });
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

std::uint32_t ModelList::selected_pass() const {
  const QTreeWidgetItem* item = tree_->currentItem();
  return item ? item->data(kNameColumn, kPassRole).toUInt() : 0;
}

void ModelList::select(int id) { select(id, {}); }

void ModelList::select(int id, const QVariant& pass) {
  for (QTreeWidgetItemIterator at(tree_); *at; ++at)
    if ((*at)->data(kNameColumn, kIdRole).toInt() == id &&
        (*at)->data(kNameColumn, kPassRole) == pass)
      tree_->setCurrentItem(*at);
}

void ModelList::rename_selected() {
  if (tree_->currentItem()) tree_->editItem(tree_->currentItem(), 0);
}

void ModelList::fill() {
  const int current = selected();
  const QVariant pass =
      tree_->currentItem() ? tree_->currentItem()->data(kNameColumn, kPassRole) : QVariant();
  filling_ = true;
  tree_->clear();
  std::map<int, QTreeWidgetItem*> items;
  for (const Model& model : store_.models()) {
    items[model.id] = make_item(model);
    if (model.data->kind == ModelKind::kRecording) add_passes(model, items[model.id]);
  }
  for (const Model& model : store_.models()) {
    const Model* input = store_.input_of(model);
    QTreeWidgetItem* above = input ? items[input->id] : tree_->invisibleRootItem();
    if (const auto only = only_pass(*model.data))
      for (int i = 0; i < above->childCount(); ++i)
        if (above->child(i)->data(kNameColumn, kPassRole) == *only) above = above->child(i);
    above->addChild(items[model.id]);
  }
  for (QTreeWidgetItemIterator at(tree_); *at; ++at)
    (*at)->setExpanded(folded_.count((*at)->data(kNameColumn, kIdRole).toInt()) == 0);
  select(current, pass);
  if (!tree_->currentItem() && !store_.models().empty()) select(store_.models().back().id);
  filling_ = false;
  show_properties();
  Q_EMIT selection_changed(selected());
}

QTreeWidgetItem* ModelList::make_item(const Model& model) {
  auto* item = new QTreeWidgetItem;
  item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsEditable |
                 Qt::ItemIsUserCheckable);
  item->setCheckState(kNameColumn, model.visible ? Qt::Checked : Qt::Unchecked);
  item->setText(kNameColumn, short_name(model, store_.input_of(model)));
  item->setIcon(kNameColumn, swatch(model));
  item->setToolTip(
      kNameColumn,
      QString("%1\n%2\n%3").arg(model.name, count_text(*model.data), model.data->source));
  item->setData(kNameColumn, kIdRole, model.id);
  if (model.made && !model.made->changed.empty()) {
    item->setText(kMarkColumn, "≠");
    item->setToolTip(kMarkColumn,
                     tr("Not made with the defaults:\n%1").arg(changed_texts(*model.made)));
  }
  return item;
}

/// They select their recording, at their first frame.
void ModelList::add_passes(const Model& model, QTreeWidgetItem* recording) {
  const auto passes = passes_of(*model.data->recording);
  if (passes.size() < 2) return;
  for (const std::uint32_t pass : passes) {
    auto* item = new QTreeWidgetItem(recording, {tr("Pass %1").arg(pass)});
    item->setData(kNameColumn, kIdRole, model.id);
    item->setData(kNameColumn, kPassRole, pass);
  }
}

void ModelList::on_item_changed(QTreeWidgetItem* item, int column) {
  if (filling_ || column != kNameColumn) return;
  const int id = item->data(0, kIdRole).toInt();
  const Model* model = store_.find(id);
  if (!model) return;
  // The change refills the list, which must not happen within its own signal.
  const bool visible = item->checkState(0) == Qt::Checked;
  const bool renamed = item->text(kNameColumn) != short_name(*model, store_.input_of(*model));
  const QString name = renamed ? item->text(kNameColumn) : model->name;
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
  properties_->setPlainText(model ? made_text(*model) + model->data->report : QString());
}

}  // namespace turnscan::studio
