#include "widgets/option_form.hpp"

#include <QCheckBox>
#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSettings>
#include <QSignalBlocker>
#include <QSlider>
#include <cmath>
#include <turnscan/core/angles.hpp>

#include "widgets/no_wheel.hpp"
#include "widgets/text.hpp"
#include "widgets/theme.hpp"

namespace turnscan::studio {

namespace {

const char* unit_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::kLength:
      return "mm";
    case Quantity::kAngle:
      return "deg";
    case Quantity::kTime:
      return "s";
    case Quantity::kAngularSpeed:
      return "deg/s";
    case Quantity::kNone:
      break;
  }
  return "";
}

/// Adds the usual unit to a number that was typed without one.
QString with_unit(const QString& text, Quantity quantity) {
  const std::string plain = text.trimmed().toStdString();
  return parse_number(plain) ? text.trimmed() + unit_of(quantity) : text.trimmed();
}

QString tip_of(const OptionField& field) {
  QString tip = QString("<b>%1</b><br>%2")
                    .arg(QString::fromStdString(field.name).toHtmlEscaped(),
                         QString::fromStdString(field.help).toHtmlEscaped());
  if (field.range) {
    const auto text = [&](double value) {
      return QString::fromStdString(format_quantity(value, field.quantity));
    };
    tip += QObject::tr("<br>From %1 to %2").arg(text(field.range->min), text(field.range->max));
  }
  return tip;
}

/// A slider has a step for each degree of an angle. Of other ranges, which span decades, small
/// values get the larger part.
constexpr int kSliderSteps = 1000;
constexpr double kSliderPower = 4.0;

int slider_steps(const OptionField& field) {
  if (field.quantity != Quantity::kAngle) return kSliderSteps;
  return int(std::lround((field.range->max - field.range->min) / kRadiansPerDegree));
}

int step_of(const OptionField& field, double value) {
  const double share = (value - field.range->min) / (field.range->max - field.range->min);
  const bool even = field.quantity == Quantity::kAngle;
  return int(
      std::lround(slider_steps(field) * (even ? share : std::pow(share, 1.0 / kSliderPower))));
}

/// Rounded to a degree, or to two digits.
double value_at(const OptionField& field, int step) {
  const double share = double(step) / slider_steps(field);
  const double size = field.range->max - field.range->min;
  double value = 0.0;
  if (field.quantity == Quantity::kAngle) {
    value = std::round((field.range->min + size * share) / kRadiansPerDegree) * kRadiansPerDegree;
  } else {
    value = field.range->min + size * std::pow(share, kSliderPower);
    const double digit = std::pow(10.0, std::floor(std::log10(std::max(value, 1e-12))) - 1.0);
    value = std::round(value / digit) * digit;
  }
  return std::clamp(value, field.range->min, field.range->max);
}

}  // namespace

OptionForm::OptionForm(OptionTable table, const QStringList& hide, QWidget* parent,
                       const QStringList& sliders)
    : QWidget(parent), table_(std::move(table)), grid_(new QGridLayout(this)) {
  grid_->setContentsMargins(0, 0, 0, 0);
  grid_->setHorizontalSpacing(10);
  grid_->setVerticalSpacing(5);
  grid_->setColumnStretch(0, 3);
  grid_->setColumnStretch(1, 2);
  for (const OptionField& field : table_.fields())
    if (!hide.contains(QString::fromStdString(field.name)))
      add_row(field, sliders.contains(QString::fromStdString(field.name)));
}

void OptionForm::add_row(const OptionField& field, bool with_slider) {
  const std::size_t index = rows_.size();
  rows_.push_back({&field, nullptr, nullptr, nullptr, nullptr, field.get(), {}});
  Row& row = rows_.back();
  row.editor = make_editor(index);
  row.editor->setObjectName("option:" + QString::fromStdString(field.name));
  row.editor->setToolTip(tip_of(field));
  row.editor->setAccessibleName(translated_title(field.name));
  const int line = grid_->rowCount();
  if (field.is_flag) {
    grid_->addWidget(row.editor, line, 0, 1, 2);
  } else {
    auto* label = new QLabel(translated_title(field.name), this);
    label->setToolTip(tip_of(field));
    label->setBuddy(row.editor);
    row.label = label;
    connect(label, &QLabel::linkActivated, this, [this, index] {
      show_value(rows_[index]);  // an invalid text goes, too
      take(index, QString::fromStdString(rows_[index].initial));
      show_value(rows_[index]);
    });
    label->setWordWrap(true);
    grid_->addWidget(label, line, 0);
    grid_->addWidget(row.editor, line, 1);
  }
  row.error = new QLabel(this);
  row.error->setObjectName("field_error");
  row.error->setWordWrap(true);
  row.error->setVisible(false);
  if (with_slider) grid_->addWidget(row.slider = make_slider(index), line + 1, 0, 1, 2);
  grid_->addWidget(row.error, line + 2, 0, 1, 2);
  show_value(row);
}

QWidget* OptionForm::make_editor(std::size_t index) {
  const OptionField& field = *rows_[index].field;
  if (field.is_flag) {
    auto* box = new QCheckBox(translated_title(field.name), this);
    connect(box, &QCheckBox::toggled, this,
            [this, index](bool on) { take(index, on ? "true" : "false"); });
    return box;
  }
  if (!field.choices.empty()) {
    auto* box = new QComboBox(this);
    for (const std::string& choice : field.choices) box->addItem(QString::fromStdString(choice));
    leave_wheel_to_panel(box);
    connect(box, &QComboBox::currentTextChanged, this,
            [this, index](const QString& text) { take(index, text); });
    return box;
  }
  auto* edit = new QLineEdit(this);
  edit->setMinimumWidth(84);
  if (field.may_be_auto) {
    edit->setPlaceholderText(tr("automatic"));
    edit->setClearButtonEnabled(true);
  }
  connect(edit, &QLineEdit::textEdited, this,
          [this, index](const QString& text) { take(index, text); });
  // Clearing by the button does not count as editing.
  connect(edit, &QLineEdit::textChanged, this, [this, index](const QString& text) {
    if (text.isEmpty() && rows_[index].field->may_be_auto) take(index, text);
  });
  connect(edit, &QLineEdit::editingFinished, this, [this, index] {
    if (rows_[index].problem.isEmpty()) show_value(rows_[index]);
  });
  return edit;
}

QSlider* OptionForm::make_slider(std::size_t index) {
  const OptionField& field = *rows_[index].field;
  auto* slider = new QSlider(Qt::Horizontal, this);
  slider->setObjectName("slider:" + QString::fromStdString(field.name));
  slider->setAccessibleName(translated_title(field.name));
  slider->setToolTip(tip_of(field));
  slider->setRange(0, slider_steps(field));
  leave_wheel_to_panel(slider);
  connect(slider, &QSlider::valueChanged, this, [this, index](int step) {
    const OptionField& of = *rows_[index].field;
    const double value = value_at(of, step);
    const std::string text = format_quantity(value, of.quantity);
    // A count takes whole numbers only.
    const bool good = of.set(text).has_value();
    take(index, QString::fromStdString(good ? text : fmt::format("{:.0f}", value)));
    show_value(rows_[index]);
  });
  return slider;
}

void OptionForm::show_on_slider(const Row& row) {
  if (!row.slider || row.slider->isSliderDown()) return;
  const auto value = parse_quantity(row.field->get(), row.field->quantity);
  // Steps finer than the value's digits would be put back.
  if (value &&
      std::abs(value_at(*row.field, row.slider->value()) - *value) <= 1e-9 * std::abs(*value))
    return;
  const QSignalBlocker quiet(row.slider);
  // In the middle and pale where the value is automatic: it is none of the ends.
  row.slider->setValue(value ? step_of(*row.field, *value) : row.slider->maximum() / 2);
  set_style_property(*row.slider, "automatic", !value);
}

void OptionForm::take(std::size_t index, const QString& text) {
  Row& row = rows_[index];
  const OptionField& field = *row.field;
  const std::string before = field.get();
  QString value = text;
  if (field.may_be_auto && text.trimmed().isEmpty()) value = "auto";
  if (field.quantity != Quantity::kNone) value = with_unit(value, field.quantity);
  Result<> set = field.set(value.toStdString());
  if (set) set = field.check();
  row.problem = set ? QString() : QString::fromStdString(set.error().text());
  if (!set) (void)field.set(before);
  show_problem(row);
  show_on_slider(row);
  mark(row);
  Q_EMIT changed();
}

/// A slider's scanner has no defaults but those of its preset.
void OptionForm::mark(const Row& row) {
  if (!row.label || row.slider) return;
  const QString title = translated_title(row.field->name);
  const bool differs = row.field->get() != row.initial;
  row.label->setText(differs ? QString("<a href=\"reset\">%1 ↺</a>").arg(title.toHtmlEscaped())
                             : title);
  row.label->setTextInteractionFlags(  // a stop of Tab only while it is a link
      differs ? Qt::LinksAccessibleByMouse | Qt::LinksAccessibleByKeyboard
              : Qt::TextInteractionFlags(Qt::NoTextInteraction));
  row.label->setToolTip(tip_of(*row.field) +
                        (differs ? tr("<br><i>Not the default, %1: click to reset</i>")
                                       .arg(QString::fromStdString(row.initial).toHtmlEscaped())
                                 : QString()));
}

void OptionForm::show_problem(Row& row) {
  const bool bad = !row.problem.isEmpty();
  row.error->setText(row.problem);
  row.error->setVisible(bad);
  set_style_property(*row.editor, "invalid", bad);
}

void OptionForm::show_value(const Row& row) {
  const QString value = QString::fromStdString(row.field->get());
  const QSignalBlocker quiet(row.editor);
  show_on_slider(row);
  mark(row);
  if (row.field->is_flag) {
    static_cast<QCheckBox*>(row.editor)->setChecked(value == "true");
  } else if (!row.field->choices.empty()) {
    static_cast<QComboBox*>(row.editor)->setCurrentText(value);
  } else {
    const bool automatic = row.field->may_be_auto && value == "auto";
    auto* edit = static_cast<QLineEdit*>(row.editor);
    if (edit->text() != (automatic ? QString() : value)) edit->setText(automatic ? "" : value);
    edit->setCursorPosition(0);
  }
}

bool OptionForm::valid() const { return first_error().isEmpty(); }

QString OptionForm::first_error() const {
  for (const Row& row : rows_)
    if (!row.problem.isEmpty()) return row.problem;
  return {};
}

void OptionForm::refresh() {
  for (Row& row : rows_) {
    row.problem.clear();
    show_problem(row);
    show_value(row);
  }
}

void OptionForm::reset_to_defaults() {
  for (Row& row : rows_) (void)row.field->set(row.initial);
  refresh();
  Q_EMIT changed();
}

void OptionForm::show_used(const QString& field, const QString& value, const QString& why) {
  for (Row& row : rows_) {
    if (field != QString::fromStdString(row.field->name) || !row.field->may_be_auto) continue;
    auto* edit = static_cast<QLineEdit*>(row.editor);
    edit->setPlaceholderText(tr("auto: %1").arg(short_value(value)));
    edit->setToolTip(tip_of(*row.field) +
                     tr("<br><i>Last run: %1, %2</i>").arg(value, why.toHtmlEscaped()));
  }
}

void OptionForm::show_fields(const QString& prefix, bool apply) {
  for (const Row& row : rows_)
    if (QString::fromStdString(row.field->name).startsWith(prefix))
      for (QWidget* each : {static_cast<QWidget*>(row.label), row.editor}) each->setVisible(apply);
}

QMap<QString, QString> OptionForm::values() const {
  QMap<QString, QString> values;
  for (const Row& row : rows_) {
    const std::string value = row.field->get();
    if (value != row.initial)
      values[QString::fromStdString(row.field->name)] = QString::fromStdString(value);
  }
  return values;
}

void OptionForm::set_values(const QMap<QString, QString>& values) {
  for (Row& row : rows_) {
    const auto found = values.find(QString::fromStdString(row.field->name));
    if (found != values.end()) (void)row.field->set(found->toStdString());
  }
  refresh();
  Q_EMIT changed();
}

void OptionForm::store(const QString& group) const {
  QSettings settings;
  settings.beginGroup(group);
  settings.remove("");
  const QMap<QString, QString> all = values();
  for (auto it = all.begin(); it != all.end(); ++it) settings.setValue(it.key(), it.value());
  settings.endGroup();
}

void OptionForm::restore(const QString& group) {
  QSettings settings;
  settings.beginGroup(group);
  QMap<QString, QString> all;
  for (const QString& key : settings.childKeys()) all[key] = settings.value(key).toString();
  settings.endGroup();
  set_values(all);
}

}  // namespace turnscan::studio
