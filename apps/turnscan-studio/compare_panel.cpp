#include "compare_panel.hpp"

#include <QComboBox>
#include <QFontDatabase>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <turnscan/evaluation/evaluate.hpp>

#include "models.hpp"
#include "option_form.hpp"
#include "section.hpp"

namespace turnscan::studio {

ComparePanel::ComparePanel(ModelStore& store, QWidget* parent)
    : QWidget(parent), store_(store), options_(std::make_unique<EvaluateOptions>()) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  auto* grid = new QGridLayout;
  grid->setColumnStretch(1, 1);
  reference_ = new QComboBox(this);
  compared_ = new QComboBox(this);
  reference_->setObjectName("compare_reference");
  compared_->setObjectName("compare_model");
  grid->addWidget(new QLabel(tr("Reference"), this), 0, 0);
  grid->addWidget(reference_, 0, 1);
  grid->addWidget(new QLabel(tr("Model"), this), 1, 0);
  grid->addWidget(compared_, 1, 1);
  layout->addLayout(grid);
  auto* row = new QHBoxLayout;
  row->setSpacing(6);
  const std::pair<QString, QString> names[] = {
      {tr("Side by side"), tr("Both with one camera")},
      {tr("Overlay"), tr("One over the other")},
      {tr("Distances"), tr("Colour the model by its distance to the reference")}};
  for (int i = 0; i < 3; ++i) {
    ways_[i] = button(names[i].first, names[i].second, this);
    ways_[i]->setCheckable(i < 2);
    row->addWidget(ways_[i], 1);
    if (i < 2)
      connect(ways_[i], &QPushButton::clicked, this,
              [this, i](bool on) { choose(on ? static_cast<Way>(i) : kOff); });
  }
  connect(ways_[2], &QPushButton::clicked, this, [this] {
    choose(kOff);
    Q_EMIT distance_wanted();
  });
  layout->addLayout(row);
  error_ = new MessageLabel(this);
  layout->addWidget(error_);
  text_ = new QPlainTextEdit(this);
  text_->setReadOnly(true);
  text_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  text_->setLineWrapMode(QPlainTextEdit::NoWrap);
  text_->setFixedHeight(150);
  text_->setObjectName("compare_text");
  text_->setVisible(false);
  layout->addWidget(text_);
  auto* details = new Section(tr("Options of distances"), false, this);
  form_ = new OptionForm(describe(*options_), {}, details);
  details->body()->addWidget(form_);
  layout->addWidget(details);
  connect(&store_, &ModelStore::changed, this, &ComparePanel::fill);
  connect(reference_, qOverload<int>(&QComboBox::activated), this, &ComparePanel::changed);
  connect(compared_, qOverload<int>(&QComboBox::activated), this, &ComparePanel::changed);
  fill();
}

ComparePanel::~ComparePanel() = default;

int ComparePanel::reference() const { return reference_->currentData().toInt(); }

int ComparePanel::compared() const { return compared_->currentData().toInt(); }

QString ComparePanel::first_error() const { return form_->first_error(); }

void ComparePanel::show_text(const QString& text) {
  text_->setPlainText(text);
  text_->setVisible(!text.isEmpty());
}

void ComparePanel::show_error(const QString& text) { error_->show_text(text); }

void ComparePanel::stop() { choose(kOff); }

void ComparePanel::fill() {
  const int reference = this->reference(), compared = this->compared();
  for (QComboBox* box : {reference_, compared_}) {
    const QSignalBlocker quiet(box);
    box->clear();
    for (const Model& model : store_.models()) box->addItem(model.name, model.id);
  }
  const auto choose_id = [](QComboBox* box, int id, int otherwise) {
    const int at = box->findData(id);
    box->setCurrentIndex(at >= 0 ? at : otherwise);
  };
  choose_id(reference_, reference, 0);
  // The newest, until something else is chosen.
  const bool chosen = compared != reference;
  choose_id(compared_, chosen ? compared : 0, compared_->count() - 1);
  const bool enough = store_.models().size() > 1;
  for (QPushButton* each : ways_) each->setEnabled(enough);
  if (!enough && way_ != kOff) choose(kOff);
}

void ComparePanel::choose(Way way) {
  way_ = way;
  for (int i = 0; i < 2; ++i) ways_[i]->setChecked(way == i);
  Q_EMIT changed();
}

}  // namespace turnscan::studio
