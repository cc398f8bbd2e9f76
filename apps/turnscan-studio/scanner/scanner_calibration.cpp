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
#include "widgets/theme.hpp"

namespace turnscan::studio {

namespace {

QString mm(double metres, int digits = 2) {
  return std::isfinite(metres) ? QObject::tr("%1 mm").arg(1e3 * metres, 0, 'f', digits)
                               : QObject::tr("unknown");
}

QString first_steps() {
  return QObject::tr(
      "Put nothing on the table and press Calibrate; or record at once: the object's motion shows "
      "where the table is.");
}

}  // namespace

void ScannerMode::build_calibration() {
  auto* section = new Section(tr("2  Calibration"), true, this);
  auto* row = new QHBoxLayout;
  average_ = button(tr("Averaged scan"), tr("Average frames of what stands still"), section);
  calibrate_ = primary_button(
      tr("Calibrate"),
      tr("Find the turntable in an averaged scan, which is taken if there is none"), section);
  row->addWidget(average_);
  row->addWidget(calibrate_);
  average_->setEnabled(false);
  calibrate_->setEnabled(false);
  connect(average_, &QPushButton::clicked, this, &ScannerMode::start_average);
  connect(calibrate_, &QPushButton::clicked, this, &ScannerMode::calibrate);
  chip_ = new QLabel(section);
  chip_->setObjectName("platter_chip");
  chip_->setWordWrap(true);
  chip_->setVisible(false);
  auto* correct = new Section(tr("Correct"), false, section, Section::kNested);
  correct->body()->addLayout(make_pick_buttons(correct));
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
  section->body()->addWidget(chip_);
  section->body()->addLayout(row);
  section->body()->addWidget(calibration_text_);
  section->body()->addWidget(calibration_error_);
  section->body()->addLayout(files);
  section->body()->addWidget(correct);
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
    const QString path = ask_save_path(this, tr("Save calibration"), "calibration.json", filter);
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
  if (std::exchange(calibrates_, false)) calibrate();
}

void ScannerMode::calibrate() {
  calibration_error_->show_text(detect_form_->first_error());
  if (!detect_form_->valid()) return;
  calibrates_ = !scan_ || averaging_;
  if (calibrates_ && !averaging_) start_average();
  if (calibrates_) return;
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
        return Finish([this, platter, shared, residuals] {
          clear_picks();
          platter_ = platter;
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
  if (!on) return;
  set_still(true);
  clear_picks();
  before_picks_ = calibration_;
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

void ScannerMode::clear_picks() {
  picks_.clear();
  view().remove(picks_item_);
  picks_item_ = 0;
  undo_pick_->setEnabled(false);
  Q_EMIT undo_changed();
}

QString ScannerMode::problem_of_picks(const Calibration& picked) const {
  if (!(picked.residual_rms_m > kMovedShift_m)) return {};
  return tr("The points are %1 off a circle (root mean square); %2 is the limit. Undo those that "
            "are not on the rim")
      .arg(mm(picked.residual_rms_m), mm(kMovedShift_m, 0));
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
  calibration_error_->show_text({});
  QString problem;
  if (picks_.size() >= 3) {
    auto found = calibrate_from_points(picks_, Vec3d::Zero());
    problem = found ? problem_of_picks(*found) : QString::fromStdString(found.error().text());
    if (problem.isEmpty())
      return show_calibration(std::make_shared<const Calibration>(std::move(*found)));
  }
  // Without good points, what was there before them holds.
  before_picks_ ? show_calibration(before_picks_) : clear_calibration();
  calibration_error_->show_text(problem);
  if (picks_.size() < 3)
    calibration_text_->setText(tr("%1 of at least 3 points").arg(picks_.size()));
}

/// What is known of the platter while the sensor plays.
void ScannerMode::show_platter(const LiveState& state) {
  if (state.platter) platter_ = state.platter;
  QString text;
  // A platter known to a quarter of the shift that counts as moved can be checked for it.
  const auto grade = [](double sigma_m) { return sigma_m <= kMovedShift_m / 4 ? "good" : "fair"; };
  QString how = "none";
  const auto known = [&](double radius_m, double sigma_m, double center_sigma_m) {
    how = grade(center_sigma_m);
    return std::isfinite(sigma_m)
               ? tr("Platter: radius %1, known to %2").arg(mm(radius_m, 1), mm(sigma_m, 1))
               : tr("Platter: radius %1, how well is not known").arg(mm(radius_m, 1));
  };
  if (rig_ && rig_->moved) {
    text = tr("The platter is not where the calibration has it");
    how = "bad";
  } else if (calibration_ && calibration_->table.radius_m) {
    text = known(*calibration_->table.radius_m, calibration_->radius_sigma_m,
                 calibration_->center_sigma_m);
  } else if (state.platter) {
    text = known(state.platter->radius_m, state.platter->radius_sigma_m,
                 state.platter->center_sigma_m);
  } else if (!state.no_platter.empty()) {
    text = tr("No platter is seen; the object's motion will show where the table is");
    chip_->setToolTip(QString::fromStdString(state.no_platter));
    how = "fair";
  }
  chip_->setVisible(!text.isEmpty() && !state.recording);
  if (how != "fair") chip_->setToolTip({});
  chip_->setText(text);
  set_style_property(*chip_, "grade", how);
}

void ScannerMode::show_calibration(std::shared_ptr<const Calibration> calibration, bool kept) {
  calibration_ = std::move(calibration);
  is_kept_ = kept;
  feed_->set_calibration(calibration_);
  save_->setEnabled(true);
  filter_->setEnabled(true);
  const Calibration& c = *calibration_;
  const bool exact = c.method == CalibrationMethod::kPicked && !std::isfinite(c.radius_sigma_m);
  QString text = tr("By %1: radius %2, error %3 (root mean square)")
                     .arg(QString::fromStdString(std::string(name_of(c.method))),
                          mm(c.table.radius_m.value_or(std::nan("")), 1),
                          exact ? tr("not known: 3 points fit any circle") : mm(c.residual_rms_m));
  if (c.method == CalibrationMethod::kPicked && platter_)
    text += "\n" + tr("The detected platter differs by %1 in its centre, %2 in its radius")
                       .arg(mm((platter_->center_m - c.table.center_m).norm(), 1),
                            mm(std::abs(platter_->radius_m - c.table.radius_m.value_or(0.0)), 1));
  if (kept)
    text +=
        tr("\nFrom the last recording with this device. Calibrate anew if sensor or table "
           "were moved since.");
  calibration_text_->setText(text);
  calibration_text_->setToolTip(
      "<pre>" + QString::fromStdString(calibration_text(c)).toHtmlEscaped() + "</pre>");
  draw_calibration();
}

void ScannerMode::clear_calibration() {
  view().remove(ring_item_);
  ring_item_ = 0;
  calibration_.reset();
  feed_->set_calibration(nullptr);
  is_kept_ = false;
  filter_->setChecked(false);
  filter_->setEnabled(false);
  save_->setEnabled(false);
  calibration_text_->setToolTip({});
}

void ScannerMode::forget_calibration() {
  pick_->setChecked(false);
  clear_picks();
  clear_calibration();
  view().remove(scan_item_);
  scan_item_ = 0;
  view().set_legend({});
  scan_.reset();
  platter_.reset();
  before_picks_.reset();
  for (QWidget* widget : {calibrate_, pick_}) widget->setEnabled(false);
  calibration_error_->show_text({});
  calibration_text_->setText(first_steps());
}

/// The user did not ask for it: it is dropped without confirmation, as in `scan`.
void ScannerMode::drop_kept_calibration() {
  clear_calibration();
  kept_is_outdated_ = true;
  const QString why = tr("The calibration of the last recording is not used: %1")
                          .arg(QString::fromStdString(rig_->text));
  calibration_text_->setText(why);
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
