// Calibration in the 3D Scanner: averaged scan, detected platter, picked points, files.

#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <cmath>
#include <turnscan/capture/session/device_calibration.hpp>
#include <turnscan/core/utc_time.hpp>
#include <turnscan/recording/calibration_file.hpp>
#include <turnscan/turntable/detection/picked_points.hpp>
#include <turnscan/workflow/text/calibration_text.hpp>

#include "app/jobs.hpp"
#include "app/paths.hpp"
#include "scanner/calibration_picture.hpp"
#include "scanner/live_feed.hpp"
#include "scanner/scanner.hpp"
#include "scanner/scanner_parts.hpp"
#include "view/scene_view.hpp"
#include "widgets/option_form.hpp"
#include "widgets/section.hpp"

namespace turnscan::studio {

namespace {

QString mm(double metres, int digits = 2) {
  return std::isfinite(metres) ? QObject::tr("%1 mm").arg(1e3 * metres, 0, 'f', digits)
                               : QObject::tr("unknown");
}

QString first_steps() {
  return QObject::tr("Put nothing on the table, take an averaged scan, then calibrate.");
}

}  // namespace

void ScannerMode::build_calibration() {
  auto* section = new Section(tr("2  Calibration"), true, this);
  auto* row = new QHBoxLayout;
  average_ = button(tr("Averaged scan"), tr("Average frames of what stands still"), section);
  calibrate_ =
      primary_button(tr("Calibrate"), tr("Find the turntable in the averaged scan"), section);
  row->addWidget(average_);
  row->addWidget(calibrate_);
  average_->setEnabled(false);
  calibrate_->setEnabled(false);
  connect(average_, &QPushButton::clicked, this, &ScannerMode::start_average);
  connect(calibrate_, &QPushButton::clicked, this, &ScannerMode::calibrate);
  QLayout* picking = make_pick_buttons(section);
  QLayout* files = make_calibration_files(section);
  calibration_text_ = quiet_label(first_steps(), section);
  calibration_text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  calibration_error_ = new MessageLabel(section);
  auto* details = new Section(tr("Options"), false, section, Section::kNested);
  average_form_ = new OptionForm(describe(options_->average), {}, details);
  detect_form_ = new OptionForm(describe(options_->detect), {}, details);
  details->body()->addWidget(average_form_);
  details->body()->addWidget(detect_form_);
  average_form_->restore("scanner/average");
  detect_form_->restore("scanner/detect");
  section->body()->addLayout(row);
  section->body()->addLayout(picking);
  section->body()->addLayout(files);
  section->body()->addWidget(calibration_text_);
  section->body()->addWidget(calibration_error_);
  section->body()->addWidget(details);
  panel()->addWidget(section);
}

QLayout* ScannerMode::make_pick_buttons(QWidget* parent) {
  auto* row = new QHBoxLayout;
  pick_ = button(tr("Pick rim points"), tr("Click at least 3 points on the platter's rim"), parent);
  pick_->setCheckable(true);
  undo_pick_ = button(tr("Undo click"), tr("Take back the last point (Ctrl+Z)"), parent);
  row->addWidget(pick_);
  row->addWidget(undo_pick_);
  pick_->setEnabled(false);
  undo_pick_->setEnabled(false);
  connect(pick_, &QPushButton::toggled, this, &ScannerMode::start_picking);
  connect(undo_pick_, &QPushButton::clicked, this, &ScannerMode::undo_pick);
  return row;
}

QLayout* ScannerMode::make_calibration_files(QWidget* parent) {
  auto* row = new QHBoxLayout;
  auto* load = button(tr("Load…"), tr("A calibration saved before"), parent);
  save_ = button(tr("Save…"), tr("Keep the calibration as a file"), parent);
  save_->setEnabled(false);
  row->addWidget(load);
  row->addWidget(save_);
  const QString filter = tr("Calibrations (*.json)");
  connect(load, &QPushButton::clicked, this, [this, filter] {
    const QString path = QFileDialog::getOpenFileName(this, tr("Load calibration"), {}, filter);
    if (!path.isEmpty()) load_calibration(path);
  });
  connect(save_, &QPushButton::clicked, this, [this, filter] {
    const QString path =
        QFileDialog::getSaveFileName(this, tr("Save calibration"), "calibration.json", filter);
    if (!path.isEmpty()) save_calibration(path);
  });
  return row;
}

/// Replaces the first instructions, which such a device does not need.
void ScannerMode::note_known_table() {
  if (calibration_text_->text() == first_steps())
    calibration_text_->setText(tr("The device says itself where its table stands."));
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
      [this, sequence, known = calibration_,
       options = options_->average](const RunContext& context) -> Result<Finish> {
        TURNSCAN_ASSIGN(
            AveragedScan scan,
            average_frames(*sequence, spread_positions(*sequence, 0, sequence->frames().size()),
                           options, context));
        auto shared = std::make_shared<const AveragedScan>(std::move(scan));
        std::string check;
        if (known) {
          const auto rig = check_rig(*shared, *known, context);
          if (rig) check = rig->text;
        }
        const DrawablePtr drawable = averaged_picture(*shared, nullptr);
        return Finish([this, shared, drawable, check] { show_average(shared, drawable, check); });
      },
      [this](const QString& text) { calibration_error_->show_text(text); });
}

void ScannerMode::show_average(std::shared_ptr<const AveragedScan> scan,
                               const DrawablePtr& drawable, const std::string& check) {
  scan_ = std::move(scan);
  view().remove(scan_item_);
  scan_item_ = view().add(drawable, picture_style(true));
  view().set_legend({});
  set_still(true);
  calibrate_->setEnabled(true);
  pick_->setEnabled(true);
  QString text = tr("Averaged %1 frames; noise of one frame %2")
                     .arg(scan_->frames)
                     .arg(mm(scan_->typical_noise_m()));
  if (!check.empty()) text += "\n" + QString::fromStdString(check);
  calibration_text_->setText(text);
}

void ScannerMode::calibrate() {
  calibration_error_->show_text(detect_form_->first_error());
  if (!scan_ || !detect_form_->valid()) return;
  pick_->setChecked(false);
  const bool live = !device_->currentText().startsWith("replay:");
  jobs().start(
      tr("Calibrate"), this,
      [this, scan = scan_, made_at = live ? utc_text(utc_now_s()) : std::string(),
       options = options_->detect](const RunContext& context) -> Result<Finish> {
        TURNSCAN_ASSIGN(const DetectedPlatter platter, detect_platter(*scan, options, context));
        Calibration detected = calibration_of(platter, *scan);
        detected.made_at = made_at;
        // Shows the calibration as it is read back from a file.
        TURNSCAN_ASSIGN(Calibration found, parse_calibration(calibration_json(detected)));
        auto shared = std::make_shared<const Calibration>(std::move(found));
        const DrawablePtr residuals = averaged_picture(*scan, &shared->table);
        return Finish([this, shared, residuals] {
          view().replace(scan_item_, residuals);
          view().set_legend(residual_legend());
          set_still(true);
          show_calibration(shared);
        });
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
  Q_EMIT undo_changed();
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

void ScannerMode::show_calibration(std::shared_ptr<const Calibration> calibration, bool kept) {
  calibration_ = std::move(calibration);
  is_kept_ = kept;
  feed_->set_calibration(calibration_);
  save_->setEnabled(true);
  filter_->setEnabled(true);
  const Calibration& c = *calibration_;
  QString text = tr("By %1: radius %2, error %3 (root mean square)")
                     .arg(QString::fromStdString(std::string(name_of(c.method))),
                          mm(c.table.radius_m.value_or(std::nan("")), 1), mm(c.residual_rms_m));
  if (kept)
    text +=
        tr("\nFrom the last recording with this device. Calibrate anew if sensor or table "
           "were moved since.");
  calibration_text_->setText(text);
  calibration_text_->setToolTip(
      "<pre>" + QString::fromStdString(calibration_text(c)).toHtmlEscaped() + "</pre>");
  draw_calibration();
}

void ScannerMode::forget_calibration() {
  pick_->setChecked(false);
  picks_.clear();
  for (int* item : {&scan_item_, &ring_item_, &picks_item_}) {
    view().remove(*item);
    *item = 0;
  }
  view().set_legend({});
  scan_.reset();
  calibration_.reset();
  feed_->set_calibration(nullptr);
  filter_->setChecked(false);
  for (QWidget* widget :
       std::initializer_list<QWidget*>{calibrate_, pick_, undo_pick_, save_, filter_})
    widget->setEnabled(false);
  calibration_error_->show_text({});
  calibration_text_->setText(first_steps());
  calibration_text_->setToolTip({});
}

/// The user did not ask for it: it is dropped without confirmation, as in `scan`.
void ScannerMode::drop_kept_calibration() {
  view().remove(ring_item_);
  ring_item_ = 0;
  calibration_.reset();
  feed_->set_calibration(nullptr);
  is_kept_ = false;
  kept_is_outdated_ = true;
  filter_->setChecked(false);
  filter_->setEnabled(false);
  save_->setEnabled(false);
  const QString why = tr("The calibration of the last recording is not used: %1")
                          .arg(QString::fromStdString(rig_->text));
  calibration_text_->setText(why);
  calibration_text_->setToolTip({});
  rig_.reset();
  Q_EMIT status(why);
}

void ScannerMode::draw_calibration() {
  view().remove(ring_item_);
  ItemStyle style;
  style.color = QColor(0xd27a1e);
  style.line_width = 3.0;
  style.boxed = style.in_view = false;
  ring_item_ = view().add(make_drawable(table_outline(calibration_->table)), style);
}

void ScannerMode::load_calibration(const QString& path) {
  auto read = read_calibration(path.toStdString());
  calibration_error_->show_text(read ? QString() : QString::fromStdString(read.error().text()));
  if (!read) return;
  show_calibration(std::make_shared<const Calibration>(std::move(*read)));
  for_next_device_ = !feed_->running();
}

void ScannerMode::save_calibration(const QString& path) {
  if (!calibration_) {
    calibration_error_->show_text(tr("There is no calibration yet"));
    return;
  }
  calibration_error_->show_text({});
  jobs().start(
      tr("Save calibration"), this,
      [this, path, saved = calibration_](const RunContext&) -> Result<Finish> {
        TURNSCAN_TRY(write_calibration(path.toStdString(), *saved));
        return Finish([this, path] { Q_EMIT status(tr("Wrote %1").arg(shown_path(path))); });
      },
      [this](const QString& text) { calibration_error_->show_text(text); });
}

}  // namespace turnscan::studio
