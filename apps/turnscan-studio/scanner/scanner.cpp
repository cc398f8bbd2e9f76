#include "scanner/scanner.hpp"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSettings>
#include <QTimer>
#include <QVBoxLayout>
#include <turnscan/capture/source/plugins.hpp>
#include <turnscan/recording/recording.hpp>

#include "app/jobs.hpp"
#include "app/paths.hpp"
#include "scanner/live_coverage.hpp"
#include "scanner/live_feed.hpp"
#include "scanner/motor_panel.hpp"
#include "scanner/record_panel.hpp"
#include "scanner/scanner_parts.hpp"
#include "view/scene_view.hpp"
#include "widgets/option_form.hpp"
#include "widgets/section.hpp"
#include "widgets/text.hpp"

namespace turnscan::studio {

namespace {

Legend legend_of_sides(bool is_surface) {
  Legend legend;
  legend.title = QObject::tr("Seen from");
  legend.entries = {{to_color(color_of_sides(1)), QObject::tr("1 side")},
                    {to_color(color_of_sides(2)), QObject::tr("2 sides")},
                    {to_color(color_of_sides(LiveCoverage::kWell)),
                     QObject::tr("%1 or more").arg(LiveCoverage::kWell)}};
  if (is_surface)
    legend.entries.insert(legend.entries.begin(),
                          {to_color(color_of_sides(0)), QObject::tr("nowhere yet")});
  return legend;
}

}  // namespace

ScannerMode::ScannerMode(const Services& services, QWidget* parent)
    : Mode(services, parent),
      feed_(std::make_unique<LiveFeed>()),
      options_(std::make_unique<CalibrationOptions>()),
      pick_tool_(std::make_unique<PickTool>(*this)),
      quick_(new JobRunner(this)),
      poll_(new QTimer(this)) {
  build_device();
  build_calibration();
  build_recording();
  panel()->addStretch();
  view().set_up(-Vec3d::UnitY());
  show_empty_text();
  poll_->setInterval(50);
  connect(poll_, &QTimer::timeout, this, &ScannerMode::poll);
}

ScannerMode::~ScannerMode() {
  view().set_tool(nullptr);
  delete quick_;
}

/// Instructions, or that there is nothing to do but wait.
void ScannerMode::show_empty_text() {
  if (feed_->running()) {
    view().set_empty_text(tr("Waiting for the first picture"), {});
    view().set_empty_actions({});
    return;
  }
  view().set_empty_text(tr("No picture yet"),
                        tr("Choose a device on the right and press Play. The virtual sensors need "
                           "no hardware."));
  view().set_empty_actions({{tr("Play now"), [this] {
                               if (!feed_->running()) toggle_play();
                             }}});
}

void ScannerMode::build_device() {
  auto* section = new Section(tr("1  Device"), true, this);
  device_ = new QComboBox(section);
  device_->setObjectName("device");
  device_->setAccessibleName(tr("Device"));
  device_->setEditable(true);
  device_->setInsertPolicy(QComboBox::NoInsert);
  device_->setToolTip(tr("A device of the list, or any URI, e.g. replay:FOLDER"));
  auto* row = new QHBoxLayout;
  play_ = primary_button(tr("Play"), tr("Show what the sensor sees"), section);
  filter_ = new QCheckBox(tr("Filter points"), section);
  filter_->setToolTip(tr("Show only what stands on the turntable; needs a calibration"));
  filter_->setEnabled(false);
  live_ = button(tr("Back to live"), tr("Show what the sensor sees now"), section);
  live_->setVisible(false);
  row->addWidget(play_);
  row->addWidget(filter_);
  row->addStretch();
  row->addWidget(live_);
  live_text_ = quiet_label(tr("Not playing"), section);
  device_error_ = new MessageLabel(section);
  section->body()->addWidget(device_);
  section->body()->addLayout(row);
  section->body()->addWidget(live_text_);
  section->body()->addWidget(device_error_);
  connect(device_, QOverload<int>::of(&QComboBox::activated), this,
          [this] { feed_->running() ? play_chosen() : record_->set_device(chosen_uri()); });
  connect(device_->lineEdit(), &QLineEdit::returnPressed, this, &ScannerMode::play_chosen);
  // What is typed and left is not what plays.
  connect(device_->lineEdit(), &QLineEdit::editingFinished, this, [this] {
    if (feed_->running() && !play_again_ && !device_->hasFocus())
      device_->setEditText(played_text_);
    if (!feed_->running()) record_->set_device(chosen_uri());
  });
  connect(play_, &QPushButton::clicked, this, &ScannerMode::toggle_play);
  connect(live_, &QPushButton::clicked, this, [this] { set_still(false); });
  connect(filter_, &QCheckBox::toggled, this, [this](bool on) {
    feed_->set_filter(on);
    set_still(false);
  });
  panel()->addWidget(section);
}

void ScannerMode::build_recording() {
  auto* section = new Section(tr("3  Recording"), true, this);
  record_ = new RecordPanel(section);
  section->body()->addWidget(record_);
  set_footer({make_banner(), record_->footer()});
  connect(record_, &RecordPanel::clicked, this, &ScannerMode::toggle_record);
  panel()->addWidget(section);
}

/// Shown if the platter is not where the calibration has it.
QWidget* ScannerMode::make_banner() {
  banner_ = new QWidget(this);
  banner_->setObjectName("rig_moved");
  auto* layout = new QVBoxLayout(banner_);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(6);
  banner_text_ = new MessageLabel(banner_);
  auto* row = new QHBoxLayout;
  auto* again =
      button(tr("Calibrate again"),
             tr("Take an averaged scan of the empty table, then press Calibrate"), banner_);
  auto* motion =
      button(tr("Use motion"),
             tr("Forget the calibration: the object's motion shows where the table is"), banner_);
  row->addWidget(again);
  row->addWidget(motion);
  layout->addWidget(banner_text_);
  layout->addLayout(row);
  connect(again, &QPushButton::clicked, this, [this] {
    forget_calibration();
    start_average();
  });
  connect(motion, &QPushButton::clicked, this, &ScannerMode::forget_calibration);
  banner_->setVisible(false);
  return banner_;
}

void ScannerMode::show_rig(const std::optional<RigCheck>& rig) {
  rig_ = calibration_ ? rig : std::nullopt;
  if (rig_ && rig_->moved && is_kept_ && !recording_) drop_kept_calibration();
  const bool moved = rig_ && rig_->moved;
  if (moved && !banner_->isVisible()) banner_text_->show_text(QString::fromStdString(rig_->text));
  banner_->setVisible(moved && !recording_);
}

void ScannerMode::showEvent(QShowEvent* event) {
  Mode::showEvent(event);
  // Drivers take seconds to search for devices: delayed until this mode is opened.
  if (device_->count() == 0) list_devices();
}

void ScannerMode::list_devices() {
  const QString typed = device_->currentText();
  device_->addItem(tr("Virtual Kinect v2, doll"), "virtual:doll?sensor=kinect-v2&realtime=1");
  device_->addItem(tr("Virtual Kinect v2, letter A on a desk"),
                   "virtual:letter-a?sensor=kinect-v2&realtime=1&room=desk");
  device_->addItem(tr("Virtual Kinect v1, cylinder"),
                   "virtual:cylinder?sensor=kinect-v1&realtime=1");
  device_->addItem(tr("Virtual Kinect v2, empty table on a desk"),
                   "virtual:empty?sensor=kinect-v2&realtime=1&room=desk");
  const QString last = QSettings().value("scanner/device").toString();
  if (!typed.isEmpty() || !last.isEmpty()) device_->setEditText(typed.isEmpty() ? last : typed);
  record_->set_device(chosen_uri());
  quick_->start(tr("Look for devices"), this,
                [this](const RunContext& context) -> Result<Finish> {
                  const auto drivers = list_drivers();
                  TURNSCAN_TRY(context.check());
                  return Finish([this, drivers] {
                    const bool untouched = device_->currentIndex() == 0 && !feed_->running() &&
                                           device_->currentText() == device_->itemText(0);
                    int at = 0;
                    for (const DriverState& driver : drivers)
                      for (const FoundDevice& device : driver.devices)
                        device_->insertItem(at++, QString::fromStdString(device.model),
                                            QString::fromStdString(device.uri));
                    // A sensor that is plugged in is meant, rather than a virtual one.
                    if (untouched && at > 0) device_->setCurrentIndex(0);
                    if (untouched) record_->set_device(chosen_uri());
                    if (std::exchange(plays_when_listed_, false)) play_when_listed();
                  });
                },
                {});
}

void ScannerMode::play_when_listed() {
  if (feed_->running()) return;
  plays_when_listed_ = quick_->busy();
  if (!plays_when_listed_) toggle_play();
}

void ScannerMode::play_chosen() {
  if (recording_) return device_->setEditText(played_text_);
  if (feed_->running() && chosen_uri() == played_uri_) return;
  play_again_ = feed_->running();
  toggle_play();
}

void ScannerMode::keyPressEvent(QKeyEvent* event) {
  if (event->key() != Qt::Key_Space || event->isAutoRepeat()) return Mode::keyPressEvent(event);
  if (recording_ || record_->can_record()) toggle_record();
}

void ScannerMode::set_device(const QString& uri) {
  device_->setEditText(uri);
  device_->lineEdit()->setCursorPosition(0);
  record_->set_device(chosen_uri());
}

QString ScannerMode::chosen_uri() const {
  const int known = device_->findText(device_->currentText());
  return known >= 0 ? device_->itemData(known).toString() : device_->currentText().trimmed();
}

void ScannerMode::take_device(const QString& uri) {
  record_->set_device(uri);
  if (!played_uri_.isEmpty() && uri != played_uri_ && !for_next_device_) forget_calibration();
  played_uri_ = uri;
  for_next_device_ = false;
}

void ScannerMode::toggle_play() {
  device_error_->show_text({});
  if (feed_->running()) {
    // The thread may still have frames to write; the window does not wait for it.
    feed_->cancel();
    play_->setEnabled(false);
    live_text_->setText(tr("Stopping"));
    return;
  }
  take_device(chosen_uri());
  played_text_ = device_->currentText();
  kept_is_outdated_ = false;
  record_->forget_last();
  set_still(false);
  framed_ = false;
  play_->setText(tr("Stop"));
  live_text_->setText(tr("Opening %1").arg(device_->currentText()));
  feed_->start(played_uri_.toStdString());
  view().set_live(true);
  show_empty_text();
  poll_->start();
}

void ScannerMode::poll() {
  const bool end = feed_->ended();
  feed_->set_most_points(view().points_at_once());
  const LiveState state = feed_->take_state();
  show_state(state);
  if (averaging_) {
    if (auto frames = feed_->take_collected()) average_done(std::move(frames));
  }
  if (!state.finished.empty()) {
    const QString folder = QString::fromStdString(state.finished);
    record_->set_next_pass({}, {});
    Q_EMIT status(tr("Wrote %1").arg(shown_path(folder)));
    if (state.record_error.empty()) {
      if (record_->reconstruct() && state.surface) Q_EMIT surface_left(state.surface);
      Q_EMIT recording_made(folder, record_->reconstruct());
    } else {
      Q_EMIT recording_broken_off(folder);
    }
  }
  if (end) ended();
}

void ScannerMode::ended() {
  feed_->stop();
  poll_->stop();
  averaging_ = false;
  play_->setText(tr("Play"));
  play_->setEnabled(true);
  view().set_live(false);
  show_empty_text();
  live_text_->setText(tr("Not playing"));
  average_->setEnabled(false);
  calibrate_->setEnabled(scan_ != nullptr);
  chip_->setVisible(false);
  record_->show_state({}, false);
  if (std::exchange(play_again_, false)) toggle_play();
}

void ScannerMode::show_state(const LiveState& state) {
  if (!state.error.empty()) device_error_->show_text(QString::fromStdString(state.error));
  const bool opens = state.open && !record_->can_record();
  record_->show_state(state, state.open);
  if (opens && (play_->hasFocus() || view().hasFocus() || !window()->focusWidget()))
    record_->take_focus();  // for Space
  show_seen(state);
  show_rig(state.open ? state.rig : std::nullopt);
  if (!state.open) return;
  if (state.kept && !calibration_ && !kept_is_outdated_) show_calibration(state.kept, true);
  show_platter(state);
  average_->setEnabled(!averaging_);
  calibrate_->setEnabled(!averaging_ || !calibrates_);
  filter_->setEnabled(state.table_known);
  if (play_->isEnabled())
    live_text_->setText(
        tr("%1 frames a second, %2 points").arg(state.fps, 0, 'f', 1).arg(grouped(state.points)));
  if (state.table_known && !calibration_) note_known_table();
  if (averaging_)
    calibration_text_->setText(
        tr("Averaging: %1 of %2 frames").arg(state.averaged).arg(options_->average.frames));
  show_picture(state);
}

void ScannerMode::show_picture(const LiveState& state) {
  if (!state.picture || still_) return;
  ++updates_.pictures;
  const ItemStyle style = picture_style(true);
  if (live_item_ == 0) {
    live_item_ = view().add(state.picture, style);
  } else {
    view().replace(live_item_, state.picture);
  }
  if (framed_ || box_of(*state.picture).empty()) return;
  view().look_as_sensor(box_of(*state.picture).center());
  framed_ = true;
}

void ScannerMode::show_seen(const LiveState& state) {
  if (recording_ && !state.recording) {
    view().remove(seen_item_);
    seen_item_ = 0;
    view().set_legend({});
  }
  if (!recording_ && state.recording) updates_ = {};
  recording_ = state.recording;
  if (!recording_ || !state.seen || !state.seen->picture) return;
  ++updates_.coverages;
  updates_.surfaces = state.seen->surfaces;
  if (seen_item_ == 0) {
    ItemStyle style;
    style.boxed = style.in_view = false;
    style.point_scale = 3.0;
    seen_item_ = view().add(state.seen->picture, style);
  } else {
    view().replace(seen_item_, state.seen->picture);
  }
  view().set_legend(legend_of_sides(state.seen->is_surface));
}

/// Shows the averaged scan instead of the live picture.
void ScannerMode::set_still(bool still) {
  still_ = still;
  live_->setVisible(still && feed_->running());
  view().set_style(scan_item_, picture_style(still));
  view().set_style(live_item_, picture_style(!still));
}

void ScannerMode::scan_another_side(const AnotherSide& side) {
  record_->set_next_pass(side.recording, side.advice);
  if (!feed_->running()) toggle_play();
  if (side.turn) feed_->lay_object(*side.turn);
  set_still(false);
  reveal(record_);
}

void ScannerMode::resume_recording(const QString& folder) {
  if (const auto recording = Recording::open(folder.toStdString())) {
    const std::string& source = recording->header().source;
    set_device(QString::fromStdString(source.substr(0, source.find('\n'))));
  }
  record_->set_unfinished(folder);
  if (!feed_->running()) toggle_play();
  reveal(record_);
}

void ScannerMode::toggle_record() {
  record_->show_error({});
  if (recording_) {
    feed_->stop_recording();
    return;
  }
  const auto request = record_->request();
  if (!request) return;
  set_still(false);
  feed_->record(*request);
}

void ScannerMode::shut_down() {
  QSettings().setValue("scanner/device", device_->currentText());
  average_form_->store("scanner/average");
  detect_form_->store("scanner/detect");
  record_->store();
  record_->motor().stop();
  feed_->stop();
}

}  // namespace turnscan::studio
