#include "scanner/record_panel.hpp"

#include <QCheckBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QSettings>
#include <QUrl>
#include <QVBoxLayout>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/recording/unfinished.hpp>
#include <turnscan/workflow/output_file.hpp>

#include "app/paths.hpp"
#include "scanner/live_coverage.hpp"
#include "scanner/live_feed.hpp"
#include "scanner/motor_panel.hpp"
#include "widgets/option_form.hpp"
#include "widgets/section.hpp"

namespace turnscan::studio {

struct RecordPanel::Options {
  CaptureOptions capture;

  OptionTable speed() {
    OptionTable table;
    table.number("speed", capture.speed_rad_s, Quantity::kAngularSpeed, {-100.0, 100.0},
                 "Speed of the table, counter-clockwise seen from above is positive: sets the "
                 "motor (10deg/s unless given), or serves to count turns. auto: from the frames' "
                 "angles, the calibration or the motion");
    return table;
  }
};

namespace {

constexpr const char* kRunning = "scanner/running";  // folder of the last recording

QString speed_settings(const QString& device) {
  return "scanner/speed-of/" + QString::fromLatin1(QUrl::toPercentEncoding(device));
}

}  // namespace

RecordPanel::RecordPanel(QWidget* parent)
    : QWidget(parent), options_(std::make_unique<Options>()), footer_(new QWidget(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  auto* row = new QHBoxLayout;
  folder_ = new QLineEdit(this);
  folder_->setObjectName("scanner_folder");
  folder_->setAccessibleName(tr("Folder of the recording"));
  folder_->setToolTip(tr("Folder to make; a number is added where it has content"));
  folder_->setText(QSettings().value("scanner/folder", "~/recording").toString());
  auto* browse = button(tr("…"), tr("Choose the folder"), this);
  browse->setAccessibleName(tr("Choose the folder"));
  row->addWidget(folder_, 1);
  row->addWidget(browse);
  layout->addLayout(row);
  free_folder_ = quiet_label({}, this);
  layout->addWidget(free_folder_);
  connect(folder_, &QLineEdit::textChanged, this, &RecordPanel::show_free_folder);
  build_next_pass(layout);
  build_options();
  reconstruct_ = new QCheckBox(tr("Make the mesh when it is done"), this);
  reconstruct_->setChecked(QSettings().value("scanner/reconstruct", true).toBool());
  layout->addWidget(reconstruct_);
  record_ =
      button(tr("Record"), tr("Record until the turns are done; Space records and stops"), footer_);
  record_->setObjectName("record");
  record_->setEnabled(false);
  bar_ = new QProgressBar(footer_);
  bar_->setAccessibleName(tr("Progress of the recording"));
  bar_->setRange(0, 1000);
  bar_->setTextVisible(false);
  bar_->setVisible(false);
  text_ = quiet_label({}, footer_);
  text_->setObjectName("quiet");
  seen_ = quiet_label({}, footer_);
  error_ = new MessageLabel(footer_);
  auto* lower = new QVBoxLayout(footer_);
  lower->setContentsMargins(0, 0, 0, 0);
  lower->setSpacing(6);
  for (QWidget* part : std::initializer_list<QWidget*>{error_, seen_, text_, bar_, record_})
    lower->addWidget(part);
  text_->setVisible(false);
  seen_->setVisible(false);
  connect(browse, &QPushButton::clicked, this, [this] {
    const QString path = QFileDialog::getExistingDirectory(this, tr("Folder of the recording"));
    if (!path.isEmpty()) set_folder(path);
  });
  connect(record_, &QPushButton::clicked, this, &RecordPanel::clicked);
}

RecordPanel::~RecordPanel() = default;

void RecordPanel::build_next_pass(QVBoxLayout* layout) {
  advice_ = new ParagraphLabel(this);
  advice_->setObjectName("next_pass");
  leave_ = button(tr("New recording instead"),
                  tr("What is recorded next is another object, or this one anew"), this);
  layout->addWidget(advice_);
  layout->addWidget(leave_);
  connect(leave_, &QPushButton::clicked, this, [this] {
    if (resumes_) leave_unfinished();
    set_next_pass({}, {});
  });
  set_next_pass({}, {});
}

/// Where it is not the one that is typed.
void RecordPanel::show_free_folder() {
  const QString typed = typed_path(folder_->text()), free = free_folder(typed);
  free_folder_->setVisible(next_pass_.isEmpty() && free != typed);
  free_folder_->setText(
      tr("It has content: the next recording goes into %1").arg(shown_path(free)));
}

void RecordPanel::set_next_pass(const QString& folder, const QString& advice) {
  next_pass_ = folder;
  resumes_ = false;
  advice_->setVisible(!folder.isEmpty());
  leave_->setVisible(!folder.isEmpty());
  folder_->setEnabled(folder.isEmpty());
  show_free_folder();
  if (!folder.isEmpty())
    advice_->show_text(tr("The next pass goes into %1. %2").arg(shown_path(folder), advice));
}

void RecordPanel::set_unfinished(const QString& folder) {
  set_next_pass(folder, {});
  resumes_ = true;
  advice_->show_text(
      tr("The recording in %1 was ended early. It goes on with the same device and the "
         "same options.")
          .arg(shown_path(folder)));
}

QString RecordPanel::unfinished() {
  const QString folder = QSettings().value(kRunning).toString();
  return !folder.isEmpty() && is_unfinished_recording(folder.toStdString()) ? folder : QString();
}

void RecordPanel::leave_unfinished() { QSettings().remove(kRunning); }

void RecordPanel::build_options() {
  CaptureOptions& capture = options_->capture;
  const auto add = [this](const QString& name, OptionTable table, const QStringList& hide,
                          QWidget* parent) {
    auto* form = new OptionForm(std::move(table), hide, parent);
    forms_.emplace_back(name, form);
    return form;
  };
  auto* layout = static_cast<QVBoxLayout*>(this->layout());
  layout->addWidget(add("turns", describe(capture.limits),
                        {"seconds", "frames", "until-stopped", "overlap", "device-timeout"}, this));
  speed_ = new OptionForm(options_->speed(), {}, this);
  layout->addWidget(speed_);
  auto* motor = new Section(tr("Motor"), false, this, Section::kNested);
  motor_ = new MotorPanel(motor);
  motor->body()->addWidget(motor_);
  layout->addWidget(motor);
  auto* more = new Section(tr("More options"), false, this, Section::kNested);
  more->body()->addWidget(add("limits", describe(capture.limits), {"turns"}, more));
  more->body()->addWidget(add("crop", describe(capture.crop), {}, more));
  more->body()->addWidget(add("recorder", describe(capture.recorder), {}, more));
  layout->addWidget(more);
  for (const auto& [name, form] : forms_) form->restore("scanner/" + name);
  motor_->restore();
}

void RecordPanel::set_folder(const QString& folder) { folder_->setText(shown_path(folder)); }

void RecordPanel::set_device(const QString& uri) {
  if (uri == device_) return;
  const bool first = device_.isEmpty();
  if (!first) speed_->store(speed_settings(device_));
  device_ = uri;
  if (first && !(speed_->values().isEmpty() && speed_->valid())) return;
  speed_->reset_to_defaults();
  speed_->restore(speed_settings(device_));
}

bool RecordPanel::reconstruct() const { return reconstruct_->isChecked(); }

std::optional<RecordingRequest> RecordPanel::request() {
  QString problem = motor_->first_error();
  if (problem.isEmpty()) problem = speed_->first_error();
  for (const auto& [name, form] : forms_)
    if (problem.isEmpty()) problem = form->first_error();
  if (motor_->turning()) problem = tr("The motor is being tried; stop it first");
  error_->show_text(problem);
  if (!problem.isEmpty()) return std::nullopt;
  const QString folder =
      next_pass_.isEmpty() ? free_folder(typed_path(folder_->text())) : next_pass_;
  if (const auto good = check_output_folder(folder.toStdString()); next_pass_.isEmpty() && !good) {
    error_->show_text(QString::fromStdString(good.error().text()));
    return std::nullopt;
  }
  RecordingRequest request{folder.toStdString(), options_->capture, motor_->port(),
                           motor_->options()};
  request.options.add_pass = !next_pass_.isEmpty() && !resumes_;
  request.options.resume = resumes_;
  if (!request.motor_port.empty()) request.options.stops = motor_->stops();
  QSettings settings;
  settings.setValue(kRunning, QFileInfo(folder).absoluteFilePath());  // wherever the next starts
  settings.sync();                                                    // the program may be killed
  return request;
}

void RecordPanel::show_error(const QString& text) { error_->show_text(text); }

void RecordPanel::forget_last() {
  error_->show_text({});
  for (QLabel* label : {text_, seen_}) label->setVisible(false);
}

QString RecordPanel::progress_text(const LiveState& state) const {
  const CaptureProgress& p = state.progress;
  const QString turns = p.turned_rad ? tr("turn %1").arg(*p.turned_rad / kTurn, 0, 'f', 2)
                                     : tr("turns not known yet");
  const QString space =
      p.free_bytes > 0 ? tr(", %1 GB free").arg(double(p.free_bytes) * 1e-9, 0, 'f', 1) : QString();
  return tr("%1 frames, %2, %3 dropped%4")
      .arg(qulonglong(p.frames))
      .arg(turns)
      .arg(qulonglong(p.dropped))
      .arg(space);
}

QString RecordPanel::seen_text(const CoverageSummary& seen) const {
  QString text = tr("Seen so far: about %1 cm², %2 % of it well (from %3 sides or more)")
                     .arg(1e4 * seen.area_m2, 0, 'f', 0)
                     .arg(100.0 * seen.share_well, 0, 'f', 0)
                     .arg(LiveCoverage::kWell);
  if (seen.share_missing)
    text +=
        tr("; %1 % of the surface is still missing").arg(100.0 * *seen.share_missing, 0, 'f', 0);
  return text;
}

void RecordPanel::show_state(const LiveState& state, bool open) {
  record_->setEnabled(open);
  record_->setText(state.recording        ? tr("Stop recording")
                   : resumes_             ? tr("Go on with the recording")
                   : next_pass_.isEmpty() ? tr("Record")
                                          : tr("Record another side"));
  motor_->set_in_use(state.recording);
  if (!state.record_error.empty()) error_->show_text(QString::fromStdString(state.record_error));
  bar_->setVisible(state.recording);
  if (state.recording) {
    bar_->setValue(int(1000.0 * state.progress.fraction));
    text_->setText(progress_text(state));
    text_->setVisible(true);
    seen_->setVisible(true);
    seen_->setText(state.seen ? seen_text(*state.seen)
                              : tr("The surface is shown once the object's motion is known, "
                                   "seconds after it begins to turn."));
  }
  if (!state.outcome.empty()) {
    text_->setText(tr("Recorded %1").arg(QString::fromStdString(state.outcome)));
    text_->setVisible(true);
  }
}

void RecordPanel::store() const {
  QSettings settings;
  settings.setValue("scanner/folder", folder_->text());
  settings.setValue("scanner/reconstruct", reconstruct_->isChecked());
  for (const auto& [name, form] : forms_) form->store("scanner/" + name);
  if (!device_.isEmpty()) speed_->store(speed_settings(device_));
  motor_->store();
}

}  // namespace turnscan::studio
