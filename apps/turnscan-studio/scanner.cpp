#include "scanner.hpp"

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPainter>
#include <QPushButton>
#include <QSettings>
#include <QTimer>
#include <QVBoxLayout>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <turnscan/capture/plugins.hpp>
#include <turnscan/recording/calibration_file.hpp>
#include <turnscan/turntable/detect.hpp>
#include <turnscan/turntable/picked_points.hpp>

#include "calibration_text.hpp"
#include "jobs.hpp"
#include "live_feed.hpp"
#include "option_form.hpp"
#include "output_file.hpp"
#include "scene_view.hpp"
#include "section.hpp"

namespace turnscan::studio {

namespace {

constexpr int kRingPieces = 120;

QString mm(double metres, int digits = 2) {
  return std::isfinite(metres) ? QObject::tr("%1 mm").arg(1e3 * metres, 0, 'f', digits)
                               : QObject::tr("unknown");
}

/// The rim, and the axis from the middle of the platter.
Segments ring_segments(const TurntableInfo& table) {
  Segments lines;
  const double radius = table.radius_m.value_or(0.1);
  const Vec3d u = table.axis.unitOrthogonal(), v = table.axis.cross(u);
  for (int i = 0; i < kRingPieces; ++i) {
    const double a = 2.0 * std::numbers::pi * i / kRingPieces;
    const double b = 2.0 * std::numbers::pi * (i + 1) / kRingPieces;
    lines.add(table.center_m + radius * (std::cos(a) * u + std::sin(a) * v),
              table.center_m + radius * (std::cos(b) * u + std::sin(b) * v));
  }
  lines.add(table.center_m, table.center_m + 0.8 * radius * table.axis);
  lines.add(table.center_m - 0.08 * radius * u, table.center_m + 0.08 * radius * u);
  lines.add(table.center_m - 0.08 * radius * v, table.center_m + 0.08 * radius * v);
  return lines;
}

}  // namespace

struct ScannerMode::RecordOptions {
  double turns = 1.0;
  std::optional<double> speed_rad_s;
  AverageOptions average;
  DetectOptions detect;

  OptionTable table() {
    OptionTable table;
    table
        .number("turns", turns, Quantity::kNone, {0.0, 1000.0},
                "How many turns are recorded; 0: until it is stopped.")
        .number("speed", speed_rad_s, Quantity::kAngularSpeed, {-100.0, 100.0},
                "Speed of the turntable, counter-clockwise seen from above is positive; auto: it "
                "is found from the recording, which then ends when it is stopped.");
    return table;
  }
};

/// Points on the rim of the platter.
class PickTool : public ViewTool {
 public:
  explicit PickTool(ScannerMode& mode) : mode_(mode) {}
  bool press(const QPointF& at, Qt::KeyboardModifiers keys) override {
    if (keys != Qt::NoModifier) return false;
    if (const auto point = mode_.view().pick(at)) mode_.add_pick(*point);
    return true;
  }

 private:
  ScannerMode& mode_;
};

ScannerMode::ScannerMode(const Services& services, QWidget* parent)
    : Mode(services, parent),
      feed_(std::make_unique<LiveFeed>()),
      options_(std::make_unique<RecordOptions>()),
      pick_tool_(std::make_unique<PickTool>(*this)),
      quick_(new JobRunner(this)),
      poll_(new QTimer(this)) {
  build_device();
  build_calibration();
  build_recording();
  panel()->addStretch();
  view().set_up(-Vec3d::UnitY());
  view().set_empty_text(tr("No picture yet"),
                        tr("Choose a device on the right and press Play. The virtual sensors need "
                           "no hardware."));
  poll_->setInterval(50);
  connect(poll_, &QTimer::timeout, this, &ScannerMode::poll);
}

ScannerMode::~ScannerMode() {
  view().set_tool(nullptr);
  delete quick_;
}

void ScannerMode::build_device() {
  auto* section = new Section(tr("1  Device"), true, this);
  device_ = new QComboBox(section);
  device_->setObjectName("device");
  device_->setEditable(true);
  device_->setInsertPolicy(QComboBox::NoInsert);
  device_->setToolTip(tr("A device of the list, or any URI, e.g. replay:FOLDER"));
  auto* row = new QHBoxLayout;
  play_ = primary_button(tr("Play"), tr("Show what the sensor sees"), section);
  filter_ = new QCheckBox(tr("Filter points"), section);
  filter_->setToolTip(tr("Show only what stands on the turntable; needs a calibration"));
  filter_->setEnabled(false);
  row->addWidget(play_);
  row->addWidget(filter_);
  row->addStretch();
  live_text_ = quiet_label(tr("Not playing"), section);
  device_error_ = new MessageLabel(section);
  section->body()->addWidget(device_);
  section->body()->addLayout(row);
  section->body()->addWidget(live_text_);
  section->body()->addWidget(device_error_);
  connect(play_, &QPushButton::clicked, this, &ScannerMode::toggle_play);
  connect(filter_, &QCheckBox::toggled, this, [this](bool on) { feed_->set_filter(on); });
  panel()->addWidget(section);
}

void ScannerMode::build_calibration() {
  auto* section = new Section(tr("2  Calibration"), true, this);
  auto* row = new QHBoxLayout;
  average_ = button(tr("Averaged scan"), tr("Average frames of what stands still"), section);
  calibrate_ =
      primary_button(tr("Calibrate"), tr("Find the turntable in the averaged scan"), section);
  row->addWidget(average_);
  row->addWidget(calibrate_);
  auto* picking = new QHBoxLayout;
  pick_ =
      button(tr("Pick rim points"), tr("Click at least 3 points on the platter's rim"), section);
  pick_->setCheckable(true);
  undo_pick_ = button(tr("Undo click"), tr("Take back the last point (Ctrl+Z)"), section);
  picking->addWidget(pick_);
  picking->addWidget(undo_pick_);
  auto* files = new QHBoxLayout;
  auto* load = button(tr("Load…"), tr("A calibration saved before"), section);
  auto* save = button(tr("Save…"), tr("Keep the calibration as a file"), section);
  files->addWidget(load);
  files->addWidget(save);
  calibration_text_ =
      quiet_label(tr("Put nothing on the table, take an averaged scan, then calibrate."), section);
  calibration_text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  calibration_error_ = new MessageLabel(section);
  auto* details = new Section(tr("Options"), false, section);
  average_form_ = new OptionForm(describe(options_->average), {}, details);
  detect_form_ = new OptionForm(describe(options_->detect), {}, details);
  details->body()->addWidget(average_form_);
  details->body()->addWidget(detect_form_);
  section->body()->addLayout(row);
  section->body()->addLayout(picking);
  section->body()->addLayout(files);
  section->body()->addWidget(calibration_text_);
  section->body()->addWidget(calibration_error_);
  section->body()->addWidget(details);
  average_->setEnabled(false);
  calibrate_->setEnabled(false);
  pick_->setEnabled(false);
  undo_pick_->setEnabled(false);
  connect(average_, &QPushButton::clicked, this, &ScannerMode::start_average);
  connect(calibrate_, &QPushButton::clicked, this, &ScannerMode::calibrate);
  connect(pick_, &QPushButton::toggled, this, &ScannerMode::start_picking);
  connect(undo_pick_, &QPushButton::clicked, this, &ScannerMode::undo_pick);
  const QString filter = tr("Calibrations (*.json)");
  connect(load, &QPushButton::clicked, this, [this, filter] {
    const QString path = QFileDialog::getOpenFileName(this, tr("Load calibration"), {}, filter);
    if (!path.isEmpty()) load_calibration(path);
  });
  connect(save, &QPushButton::clicked, this, [this, filter] {
    const QString path =
        QFileDialog::getSaveFileName(this, tr("Save calibration"), "calibration.json", filter);
    if (!path.isEmpty()) save_calibration(path);
  });
  panel()->addWidget(section);
}

void ScannerMode::build_recording() {
  auto* section = new Section(tr("3  Recording"), true, this);
  auto* row = new QHBoxLayout;
  folder_ = new QLineEdit(section);
  folder_->setObjectName("scanner_folder");
  folder_->setToolTip(tr("Folder to make; a number is added where it has content"));
  folder_->setText(
      QSettings().value("scanner/folder", QDir::home().filePath("recording")).toString());
  auto* browse = button(tr("…"), tr("Choose the folder"), section);
  row->addWidget(folder_, 1);
  row->addWidget(browse);
  record_form_ = new OptionForm(options_->table(), {}, section);
  reconstruct_ = new QCheckBox(tr("Make the mesh when it is done"), section);
  reconstruct_->setChecked(true);
  record_ = button(tr("Record"), tr("Record until the turns are done"), section);
  record_->setObjectName("record");
  record_text_ = quiet_label({}, section);
  record_error_ = new MessageLabel(section);
  section->body()->addLayout(row);
  section->body()->addWidget(record_form_);
  section->body()->addWidget(reconstruct_);
  section->body()->addWidget(record_);
  section->body()->addWidget(record_text_);
  section->body()->addWidget(record_error_);
  record_->setEnabled(false);
  connect(browse, &QPushButton::clicked, this, [this] {
    const QString path = QFileDialog::getExistingDirectory(this, tr("Folder of the recording"));
    if (!path.isEmpty()) folder_->setText(path);
  });
  connect(record_, &QPushButton::clicked, this, &ScannerMode::toggle_record);
  panel()->addWidget(section);
}

void ScannerMode::showEvent(QShowEvent* event) {
  Mode::showEvent(event);
  // Drivers take seconds to look for devices: not before somebody comes here.
  if (device_->count() == 0) list_devices();
}

void ScannerMode::list_devices() {
  const QString typed = device_->currentText();
  device_->addItem(tr("Virtual Kinect v2, doll"), "virtual:doll?sensor=kinect-v2&realtime=1");
  device_->addItem(tr("Virtual Kinect v2, letter A on a desk"),
                   "virtual:letter-a?sensor=kinect-v2&realtime=1&room=desk");
  device_->addItem(tr("Virtual Kinect v1, cylinder"),
                   "virtual:cylinder?sensor=kinect-v1&realtime=1");
  device_->addItem(tr("Virtual Kinect v2, empty table"),
                   "virtual:empty?sensor=kinect-v2&realtime=1");
  quick_->start(tr("Look for devices"), this,
                [this](const RunContext& context) -> Result<Finish> {
                  const auto drivers = list_drivers();
                  TURNSCAN_TRY(context.check());
                  return Finish([this, drivers] {
                    int at = 0;
                    for (const DriverState& driver : drivers)
                      for (const FoundDevice& device : driver.devices)
                        device_->insertItem(at++, QString::fromStdString(device.model),
                                            QString::fromStdString(device.uri));
                  });
                },
                {});
}

void ScannerMode::set_device(const QString& uri) { device_->setEditText(uri); }

void ScannerMode::set_folder(const QString& folder) { folder_->setText(folder); }

void ScannerMode::toggle_play() {
  device_error_->show_text({});
  if (feed_->running()) {
    feed_->stop();
    poll();
    return;
  }
  const int known = device_->findText(device_->currentText());
  const QString uri =
      known >= 0 ? device_->itemData(known).toString() : device_->currentText().trimmed();
  set_still(false);
  framed_ = false;
  play_->setText(tr("Stop"));
  live_text_->setText(tr("Opening %1").arg(device_->currentText()));
  feed_->start(uri.toStdString());
  poll_->start();
}

void ScannerMode::poll() {
  const LiveState state = feed_->take_state();
  show_state(state);
  if (averaging_) {
    if (auto frames = feed_->take_collected()) average_done(std::move(frames));
  }
  if (!state.finished.empty()) {
    Q_EMIT status(tr("Wrote %1").arg(QString::fromStdString(state.finished)));
    Q_EMIT recording_made(QString::fromStdString(state.finished), reconstruct_->isChecked());
  }
  if (state.open || (feed_->running() && state.error.empty() && state.frames == 0)) return;
  feed_->stop();
  poll_->stop();
  averaging_ = false;
  play_->setText(tr("Play"));
  live_text_->setText(tr("Not playing"));
  average_->setEnabled(false);
  record_->setEnabled(false);
  record_->setText(tr("Record"));
  recording_ = false;
}

void ScannerMode::show_state(const LiveState& state) {
  if (!state.error.empty())
    (recording_ ? record_error_ : device_error_)->show_text(QString::fromStdString(state.error));
  if (!state.open) return;
  average_->setEnabled(!averaging_);
  record_->setEnabled(true);
  live_text_->setText(tr("%1 frames a second, %2 points, %3 frames dropped")
                          .arg(state.fps, 0, 'f', 1)
                          .arg(state.points)
                          .arg(state.dropped));
  if (averaging_)
    calibration_text_->setText(
        tr("Averaging: %1 of %2 frames").arg(state.averaged).arg(options_->average.frames));
  if (state.picture && !still_) {
    ItemStyle style;
    style.color = QColor(0x4f89a8);
    style.boxed = false;
    if (live_item_ == 0) {
      live_item_ = view().add(state.picture, style);
    } else {
      view().replace(live_item_, state.picture);
    }
    if (!framed_ && !box_of(*state.picture).empty()) {
      view().look_as_sensor(box_of(*state.picture).center());
      framed_ = true;
    }
  }
  recording_ = state.recording;
  record_->setText(recording_ ? tr("Stop recording") : tr("Record"));
  if (!recording_) return;
  std::error_code ignored;
  const auto space =
      std::filesystem::space(QFileInfo(folder_->text()).absolutePath().toStdString(), ignored);
  const QString turns = state.turns ? tr("turn %1").arg(*state.turns, 0, 'f', 2)
                                    : tr("turns unknown until it is calibrated");
  record_text_->setText(tr("%1 frames, %2, %3 dropped, %4 GB free")
                            .arg(state.recorded)
                            .arg(turns)
                            .arg(state.dropped)
                            .arg(double(space.available) * 1e-9, 0, 'f', 1));
}

void ScannerMode::start_average() {
  calibration_error_->show_text(average_form_->first_error());
  if (!average_form_->valid()) return;
  averaging_ = true;
  set_still(false);
  feed_->collect(std::size_t(options_->average.frames));
}

void ScannerMode::average_done(std::unique_ptr<FrameSequence> frames) {
  averaging_ = false;
  const std::shared_ptr<const FrameSequence> sequence(std::move(frames));
  jobs().start(
      tr("Averaged scan"), this,
      [this, sequence, options = options_->average](const RunContext& context) -> Result<Finish> {
        TURNSCAN_ASSIGN(
            AveragedScan scan,
            average_frames(*sequence, spread_positions(*sequence, 0, sequence->frames().size()),
                           options, context));
        auto shared = std::make_shared<const AveragedScan>(std::move(scan));
        PointCloud cloud;
        cloud.points = points_of(*shared).cloud.points;
        const DrawablePtr drawable = make_drawable(cloud);
        return Finish([this, shared, drawable] {
          scan_ = shared;
          view().remove(scan_item_);
          ItemStyle style;
          style.color = QColor(0x6d8797);
          style.boxed = false;
          scan_item_ = view().add(drawable, style);
          set_still(true);
          calibrate_->setEnabled(true);
          pick_->setEnabled(true);
          calibration_text_->setText(tr("Averaged %1 frames; noise of one frame %2")
                                         .arg(shared->frames)
                                         .arg(mm(shared->typical_noise_m())));
        });
      },
      [this](const QString& text) { calibration_error_->show_text(text); });
}

/// Shows the averaged scan in place of the live picture.
void ScannerMode::set_still(bool still) {
  still_ = still;
  ItemStyle style;
  style.boxed = false;
  style.color = QColor(0x6d8797);
  style.visible = still;
  view().set_style(scan_item_, style);
  style.color = QColor(0x4f89a8);
  style.visible = !still;
  view().set_style(live_item_, style);
}

void ScannerMode::calibrate() {
  calibration_error_->show_text(detect_form_->first_error());
  if (!scan_ || !detect_form_->valid()) return;
  pick_->setChecked(false);
  jobs().start(
      tr("Calibrate"), this,
      [this, scan = scan_,
       options = options_->detect](const RunContext& context) -> Result<Finish> {
        TURNSCAN_ASSIGN(const DetectedPlatter platter, detect_platter(*scan, options, context));
        // What is shown is what a file gives back.
        TURNSCAN_ASSIGN(Calibration found,
                        parse_calibration(calibration_json(calibration_of(platter, *scan))));
        auto shared = std::make_shared<const Calibration>(std::move(found));
        return Finish([this, shared] { show_calibration(shared); });
      },
      [this](const QString& text) {
        calibration_error_->show_text(
            tr("%1. Pick points on the platter's rim instead.").arg(text));
      });
}

void ScannerMode::start_picking(bool on) {
  view().set_tool(on ? pick_tool_.get() : nullptr);
  view().set_hint(on ? tr("Click points on the rim of the platter, at least 3") : QString());
  if (on) set_still(true);
  if (on) picks_.clear();
  undo_pick_->setEnabled(false);
  fit_picks();
}

void ScannerMode::add_pick(const Vec3d& point) {
  picks_.push_back(point);
  fit_picks();
}

void ScannerMode::undo_pick() {
  if (picks_.empty()) return;
  picks_.pop_back();
  fit_picks();
}

void ScannerMode::fit_picks() {
  undo_pick_->setEnabled(!picks_.empty());
  PointCloud cloud;
  for (const Vec3d& p : picks_) cloud.points.push_back(p.cast<float>());
  view().remove(picks_item_);
  picks_item_ = 0;
  if (!picks_.empty()) {
    ItemStyle style;
    style.color = QColor(0xd2453c);
    style.boxed = style.in_view = false;
    style.point_scale = 5.0;
    picks_item_ = view().add(make_drawable(cloud), style);
  }
  if (picks_.size() < 3) {
    if (!picks_.empty())
      calibration_text_->setText(tr("%1 of at least 3 points").arg(picks_.size()));
    return;
  }
  auto found = calibrate_from_points(picks_, Vec3d::Zero());
  calibration_error_->show_text(found ? QString() : QString::fromStdString(found.error().text()));
  if (found) show_calibration(std::make_shared<const Calibration>(std::move(*found)));
}

void ScannerMode::show_calibration(std::shared_ptr<const Calibration> calibration) {
  calibration_ = std::move(calibration);
  feed_->set_calibration(calibration_);
  filter_->setEnabled(true);
  const Calibration& c = *calibration_;
  calibration_text_->setText(tr("By %1: radius %2, error %3 (root mean square)")
                                 .arg(QString::fromStdString(std::string(name_of(c.method))),
                                      mm(c.table.radius_m.value_or(std::nan("")), 1),
                                      mm(c.residual_rms_m)));
  calibration_text_->setToolTip(
      "<pre>" + QString::fromStdString(cli::calibration_text(c)).toHtmlEscaped() + "</pre>");
  draw_calibration();
}

void ScannerMode::draw_calibration() {
  view().remove(ring_item_);
  ItemStyle style;
  style.color = QColor(0xd27a1e);
  style.line_width = 3.0;
  style.boxed = style.in_view = false;
  ring_item_ = view().add(make_drawable(ring_segments(calibration_->table)), style);
}

void ScannerMode::load_calibration(const QString& path) {
  auto read = read_calibration(path.toStdString());
  calibration_error_->show_text(read ? QString() : QString::fromStdString(read.error().text()));
  if (read) show_calibration(std::make_shared<const Calibration>(std::move(*read)));
}

void ScannerMode::save_calibration(const QString& path) {
  if (!calibration_) {
    calibration_error_->show_text(tr("There is no calibration yet"));
    return;
  }
  const auto written = write_calibration(path.toStdString(), *calibration_);
  calibration_error_->show_text(written ? QString()
                                        : QString::fromStdString(written.error().text()));
  if (written) Q_EMIT status(tr("Wrote %1").arg(path));
}

void ScannerMode::toggle_record() {
  record_error_->show_text({});
  if (recording_) {
    feed_->stop_recording();
    return;
  }
  record_error_->show_text(record_form_->first_error());
  if (!record_form_->valid()) return;
  QString folder = folder_->text().trimmed();
  const QString base = folder;
  for (int i = 2; QDir(folder).exists() && !QDir(folder).isEmpty(); ++i)
    folder = QString("%1-%2").arg(base).arg(i);
  const auto good = cli::check_output_folder(folder.toStdString());
  if (!good) return record_error_->show_text(QString::fromStdString(good.error().text()));
  set_still(false);
  recording_ = true;
  RecordingWish wish{folder.toStdString(), options_->turns, options_->speed_rad_s};
  if (!wish.speed_rad_s && calibration_) wish.speed_rad_s = calibration_->table.speed_rad_s;
  feed_->record(wish);
}

void ScannerMode::shut_down() {
  QSettings().setValue("scanner/folder", folder_->text());
  feed_->stop();
}

}  // namespace turnscan::studio
