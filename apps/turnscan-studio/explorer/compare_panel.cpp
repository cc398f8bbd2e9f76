#include "explorer/compare_panel.hpp"

#include <QComboBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>
#include <turnscan/evaluation/evaluate.hpp>
#include <turnscan/workflow/text/evaluation_text.hpp>

#include "explorer/models.hpp"
#include "widgets/no_wheel.hpp"
#include "widgets/option_form.hpp"
#include "widgets/section.hpp"

namespace turnscan::studio {

namespace {

/// Cells of a table row, the first left-aligned, the others right-aligned.
QString row_of(const QStringList& cells, const QString& tag) {
  QString row = "<tr>";
  for (int i = 0; i < cells.size(); ++i)
    row += QString("<%1 align='%2' style='padding: 2px %3px 2px 0; font-weight: normal'>%4</%1>")
               .arg(tag, i == 0 ? "left" : "right")
               .arg(i + 1 < cells.size() ? 14 : 0)
               .arg(cells[i]);
  return row + "</tr>";
}

QString errors_of(const QString& name, const ErrorStatistics& e) {
  const auto mm = [](double value_m) { return QString::number(1e3 * value_m, 'f', 3); };
  return row_of({name, mm(e.mean), mm(e.median), mm(e.p95), mm(e.max)}, "td");
}

/// The results of `turnscan evaluate`, fitted to the width of the panel.
QString html_of(const Evaluation& e) {
  const auto percent = [](double share) { return QString("%1 %").arg(100.0 * share, 0, 'f', 2); };
  QString html = "<table cellspacing='0'>";
  html += row_of({QObject::tr("Error, mm"), QObject::tr("mean"), QObject::tr("median"),
                  QObject::tr("p95"), QObject::tr("max")},
                 "th");
  html += errors_of(QObject::tr("Accuracy"), e.accuracy);
  html += errors_of(QObject::tr("Completeness"), e.completeness);
  html += "</table><p></p><table cellspacing='0'>";
  html +=
      row_of({QObject::tr("Within"), QObject::tr("precision"), QObject::tr("recall"), "F"}, "th");
  for (const ThresholdScore& s : e.scores)
    html += row_of({QString("%1 mm").arg(1e3 * s.threshold_m), percent(s.precision),
                    percent(s.recall), QString::number(s.f, 'f', 4)},
                   "td");
  return html + "</table>";
}

}  // namespace

ComparePanel::ComparePanel(ModelStore& store, QWidget* parent)
    : QWidget(parent), store_(store), options_(std::make_unique<EvaluateOptions>()) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  layout->addLayout(make_choice());
  layout->addLayout(make_way_buttons());
  note_ = new ParagraphLabel(this);
  note_->setObjectName("compare_note");
  layout->addWidget(note_);
  error_ = new MessageLabel(this);
  layout->addWidget(error_);
  figures_ = new QLabel(this);
  figures_->setTextFormat(Qt::RichText);
  figures_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  figures_->setObjectName("compare_figures");
  figures_->setVisible(false);
  layout->addWidget(figures_);
  auto* details = new Section(tr("Options of distances"), false, this, Section::kNested);
  form_ = new OptionForm(describe(*options_), {}, details);
  details->body()->addWidget(form_);
  layout->addWidget(details);
  connect(&store_, &ModelStore::changed, this, &ComparePanel::fill);
  fill();
}

QLayout* ComparePanel::make_choice() {
  auto* grid = new QGridLayout;
  grid->setColumnStretch(1, 1);
  reference_ = new QComboBox(this);
  compared_ = new QComboBox(this);
  reference_->setObjectName("compare_reference");
  compared_->setObjectName("compare_model");
  for (QComboBox* box : {reference_, compared_}) {
    box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    leave_wheel_to_panel(box);
    connect(box, qOverload<int>(&QComboBox::activated), this, [this] {
      enable();
      Q_EMIT changed();
    });
  }
  reference_->setAccessibleName(tr("Reference"));
  compared_->setAccessibleName(tr("Model"));
  grid->addWidget(new QLabel(tr("Reference"), this), 0, 0);
  grid->addWidget(reference_, 0, 1);
  grid->addWidget(new QLabel(tr("Model"), this), 1, 0);
  grid->addWidget(compared_, 1, 1);
  return grid;
}

QLayout* ComparePanel::make_way_buttons() {
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
  return row;
}

ComparePanel::~ComparePanel() = default;

int ComparePanel::reference() const { return reference_->currentData().toInt(); }

int ComparePanel::compared() const { return compared_->currentData().toInt(); }

QString ComparePanel::first_error() const { return form_->first_error(); }

void ComparePanel::show_figures(const QString& pair, const std::optional<Evaluation>& figures) {
  figures_->setText(figures
                        ? QString("<p><b>%1</b></p>%2").arg(pair.toHtmlEscaped(), html_of(*figures))
                        : QString());
  figures_->setToolTip(
      figures
          ? "<pre>" + QString::fromStdString(evaluation_text(*figures)).toHtmlEscaped() + "</pre>"
          : QString());
  figures_->setVisible(figures.has_value());
}

void ComparePanel::show_error(const QString& text) { error_->show_text(text); }

void ComparePanel::stop() { choose(kOff); }

void ComparePanel::fill() {
  const int reference = this->reference(), compared = this->compared();
  std::set<int> now;
  // A recording has no surface yet.
  for (const Model& model : store_.models())
    if (model.data->kind != ModelKind::kRecording) now.insert(model.id);
  for (QComboBox* box : {reference_, compared_}) {
    const QSignalBlocker quiet(box);
    box->clear();
    for (const Model& model : store_.models())
      if (now.count(model.id) > 0) box->addItem(model.name, model.id);
  }
  const auto choose_id = [](QComboBox* box, int id, int otherwise) {
    const int at = box->findData(id);
    box->setCurrentIndex(at >= 0 ? at : otherwise);
  };
  choose_id(reference_, reference, 0);
  // The newest, until another one is selected.
  const bool chosen = compared != reference;
  choose_id(compared_, chosen ? compared : 0, compared_->count() - 1);
  // A new model should be visible, and a pair ends when one of its models is removed.
  const bool more =
      std::any_of(now.begin(), now.end(), [this](int id) { return known_.count(id) == 0; });
  const bool fewer = now.count(reference) == 0 || now.count(compared) == 0;
  known_ = std::move(now);
  if ((more || fewer) && way_ != kOff) choose(kOff);
  enable();
}

/// Enables only buttons that would work; a note gives the reason, or what to look at.
void ComparePanel::enable() {
  const Model* left = store_.find(reference());
  const Model* right = store_.find(compared());
  const bool pair = left && right && left != right;
  const bool surface = pair && left->data->kind == ModelKind::kMesh;
  for (int i = 0; i < 2; ++i) ways_[i]->setEnabled(pair);
  ways_[2]->setEnabled(surface);
  constexpr double kOtherUnit = 5.0;
  QString note;
  if (pair && !surface) note = tr("Distances are to a mesh: choose one as the reference.");
  if (pair) {
    const double a = box_of(*left->data->drawable).size().norm();
    const double b = box_of(*right->data->drawable).size().norm();
    const double ratio = std::max(a, b) / std::max(1e-12, std::min(a, b));
    if (ratio > kOtherUnit)
      note += tr("%1 is %2 times as large as %3: are both in the same unit?")
                  .arg((a > b ? left : right)->name)
                  .arg(ratio, 0, 'g', 3)
                  .arg((a > b ? right : left)->name);
  }
  note_->setVisible(!note.isEmpty());
  note_->show_text(note);
}

int ComparePanel::enclosing() const {
  const Model* left = store_.find(reference());
  const Model* right = store_.find(compared());
  if (!left || !right || left == right) return 0;
  const Box &a = box_of(*left->data->drawable), &b = box_of(*right->data->drawable);
  const auto holds = [](const Box& outer, const Box& inner) {
    return (outer.min.array() <= inner.min.array()).all() &&
           (outer.max.array() >= inner.max.array()).all();
  };
  return holds(a, b) ? left->id : holds(b, a) ? right->id : 0;
}

void ComparePanel::choose(Way way) {
  way_ = way;
  for (int i = 0; i < 2; ++i) ways_[i]->setChecked(way == i);
  Q_EMIT changed();
}

}  // namespace turnscan::studio
