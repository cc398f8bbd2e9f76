#include "scanner/motor_panel.hpp"

#include <QComboBox>
#include <QDir>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSettings>
#include <QVBoxLayout>
#include <chrono>
#include <cmath>
#include <numbers>
#include <thread>

#include "app/jobs.hpp"
#include "widgets/option_form.hpp"
#include "widgets/section.hpp"

namespace turnscan::studio {

namespace {

constexpr double kTrySpeed_rad_s = 0.17453293;  // 10 degrees per second
constexpr auto kWatchEvery = std::chrono::milliseconds(20);

QString port_name(const QFileInfo& file) { return file.fileName(); }

/// Turns until it is cancelled, which is the intended end.
Result<MotorStatus> turn(const std::string& port, const MotorOptions& options,
                         const RunContext& context) {
  context.begin_phase("connect", 0);
  TURNSCAN_ASSIGN(Motor motor, Motor::open(port, options, context));
  const double speed = std::min(kTrySpeed_rad_s, options.max_speed_rad_s);
  TURNSCAN_TRY(motor.spin(speed));
  context.begin_phase("turn", 0);
  while (!context.cancelled()) {
    TURNSCAN_TRY(motor.watch());
    std::this_thread::sleep_for(kWatchEvery);
  }
  TURNSCAN_TRY(motor.stop());
  return motor.status();
}

}  // namespace

MotorPanel::MotorPanel(QWidget* parent) : QWidget(parent), jobs_(new JobRunner(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  port_ = new QComboBox(this);
  port_->setObjectName("motor_port");
  port_->setAccessibleName(tr("Port of the motor"));
  port_->setEditable(true);
  port_->setInsertPolicy(QComboBox::NoInsert);
  port_->setToolTip(tr("Serial port of the board that turns the table, e.g. /dev/ttyUSB0"));
  turn_ = button(tr("Turn"), tr("Turn the table to see that it works: 10 degrees a second"), this);
  auto* row = new QHBoxLayout;
  row->addWidget(port_, 1);
  row->addWidget(turn_);
  text_ = quiet_label(tr("With a motor, Record turns the table by itself."), this);
  error_ = new MessageLabel(this);
  stops_form_ = new OptionForm(describe(stops_), {}, this);
  auto* details = new Section(tr("Board"), false, this, Section::kNested);
  form_ = new OptionForm(describe(options_), {}, details);
  details->body()->addWidget(form_);
  layout->addLayout(row);
  layout->addWidget(text_);
  layout->addWidget(error_);
  layout->addWidget(stops_form_);
  layout->addWidget(details);
  list_ports();
  const auto enable = [this] { turn_->setEnabled(!port().empty()); };
  connect(port_, &QComboBox::currentTextChanged, this, enable);
  connect(turn_, &QPushButton::clicked, this, &MotorPanel::toggle_turn);
  enable();
}

MotorPanel::~MotorPanel() { delete jobs_; }

void MotorPanel::list_ports() {
  port_->addItem(tr("No motor"), QString());
  const QDir stable("/dev/serial/by-id"), plain("/dev");
  for (const QFileInfo& file : stable.entryInfoList(QDir::System | QDir::Files))
    port_->addItem(port_name(file), file.filePath());
  for (const QFileInfo& file : plain.entryInfoList({"ttyUSB*", "ttyACM*"}, QDir::System))
    port_->addItem(file.filePath(), file.filePath());
}

std::string MotorPanel::port() const {
  const int known = port_->findText(port_->currentText());
  return (known >= 0 ? port_->itemData(known).toString() : port_->currentText().trimmed())
      .toStdString();
}

void MotorPanel::set_port(const QString& port) {
  port_->setEditText(port.isEmpty() ? tr("No motor") : port);
}

QString MotorPanel::first_error() const {
  const QString stops = port().empty() ? QString() : stops_form_->first_error();
  return stops.isEmpty() ? form_->first_error() : stops;
}

void MotorPanel::set_in_use(bool in_use) {
  port_->setEnabled(!in_use);
  turn_->setEnabled(!in_use && !port().empty());
}

bool MotorPanel::turning() const { return jobs_->busy(); }

void MotorPanel::stop() { jobs_->cancel(); }

void MotorPanel::toggle_turn() {
  if (jobs_->busy()) return jobs_->cancel();
  error_->show_text(first_error());
  if (!first_error().isEmpty()) return;
  turn_->setText(tr("Stop"));
  text_->setText(tr("Turning"));
  jobs_->start(
      tr("Turn"), this,
      [this, port = port(), options = options_](const RunContext& context) -> Result<Finish> {
        TURNSCAN_ASSIGN(const MotorStatus status, turn(port, options, context));
        return Finish([this, status] {
          text_->setText(tr("The table stands at %1 degrees")
                             .arg(status.angle_rad * 180.0 / std::numbers::pi, 0, 'f', 1));
        });
      },
      [this](const QString& text) {
        text_->setText(tr("The table does not turn"));
        error_->show_text(text);
      });
  auto* once = new QObject(this);
  connect(jobs_, &JobRunner::finished, once, [this, once] {
    turn_->setText(tr("Turn"));
    once->deleteLater();
  });
}

void MotorPanel::store() const {
  QSettings().setValue("scanner/motor", QString::fromStdString(port()));
  stops_form_->store("scanner/stops");
  form_->store("scanner/motor-options");
}

void MotorPanel::restore() {
  set_port(QSettings().value("scanner/motor").toString());
  stops_form_->restore("scanner/stops");
  form_->restore("scanner/motor-options");
}

}  // namespace turnscan::studio
