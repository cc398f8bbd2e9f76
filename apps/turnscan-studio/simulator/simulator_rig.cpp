// The scanners in the Simulator: placed by dragging and by numbers, and drawn.

#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QMenu>
#include <QPushButton>
#include <QStackedWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <QVariant>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/paths.hpp"
#include "simulator/rig_drawing.hpp"
#include "simulator/simulator_parts.hpp"
#include "simulator/sweep_panel.hpp"
#include "view/scene_view.hpp"
#include "widgets/section.hpp"
#include "widgets/theme.hpp"

namespace turnscan::studio {

namespace {

constexpr double kHandlePixels = 22.0;
const QColor kViewColor(0x3f9b57), kTableColor(0x5d7890);

Legend rig_legend() {
  Legend legend;
  legend.title = QObject::tr("Rig");
  legend.entries = {{kViewColor, QObject::tr("View of a scanner")},
                    {to_color(kEmitterColor), QObject::tr("Emitter")},
                    {to_color(kReceiverColor), QObject::tr("Receiver")},
                    {kTableColor, QObject::tr("Rim, and the way it turns")}};
  return legend;
}

TriangleMesh joined(TriangleMesh a, const TriangleMesh& b) {
  const auto shift = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  a.normals.insert(a.normals.end(), b.normals.begin(), b.normals.end());
  a.colors.insert(a.colors.end(), b.colors.begin(), b.colors.end());
  for (const auto& t : b.triangles)
    a.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return a;
}

}  // namespace

bool RigTool::press(const QPointF& at, Qt::KeyboardModifiers /*keys*/) {
  dragged_ = -1;
  double best = kHandlePixels;
  for (std::size_t i = 0; i < mode_.scanners_.size(); ++i) {
    const auto pixel = mode_.view().project(position_of(*mode_.scanners_[i]));
    if (!pixel) continue;
    const double away = std::hypot(pixel->x() - at.x(), pixel->y() - at.y());
    if (away >= best) continue;
    best = away;
    dragged_ = int(i);
  }
  last_ = at;
  if (dragged_ >= 0) mode_.list_->setCurrentRow(dragged_);
  return dragged_ >= 0;
}

void RigTool::drag(const QPointF& at, Qt::KeyboardModifiers keys) {
  if (dragged_ < 0 || dragged_ >= int(mode_.scanners_.size())) return;
  auto& scanner = *mode_.scanners_[std::size_t(dragged_)];
  if (keys.testFlag(Qt::ShiftModifier)) {
    const double factor = std::exp(0.005 * (at.y() - last_.y()));
    double& away = scanner.editor->placement().distance_m;
    away = std::clamp(away * factor, 0.05, 50.0);
  } else {
    turn(scanner, at);
  }
  last_ = at;
  mode_.drag_scanner(scanner);
}

void RigTool::release(const QPointF& /*at*/) {
  dragged_ = -1;
  mode_.place_changed();
}

Vec3d RigTool::position_of(const SimulatorMode::RigScanner& scanner) const {
  return scanner_pose(scanner.editor->placement(), mode_.aim_height(), 0.5, Vec3d::UnitY())
      .translation();
}

/// Intersects the line of sight with the sphere around the aim on which the scanner is placed.
void RigTool::turn(SimulatorMode::RigScanner& scanner, const QPointF& at) const {
  ScannerPlacement& p = scanner.editor->placement();
  const Vec3d aim(p.aim_x_m, p.aim_height_m.value_or(mode_.aim_height()), p.aim_z_m);
  const auto [origin, direction] = mode_.view().sight(at);
  const double along = (aim - origin).dot(direction);
  const Vec3d nearest = origin + along * direction;
  const double inside = p.distance_m * p.distance_m - (nearest - aim).squaredNorm();
  // Of the two intersections, the one on the scanner's current side.
  const double side = (position_of(scanner) - aim).dot(direction) > 0.0 ? 1.0 : -1.0;
  const Vec3d hit = nearest + side * std::sqrt(std::max(0.0, inside)) * direction;
  const Vec3d way = (hit - aim).normalized();
  const double limit = 0.5 * std::numbers::pi;
  p.elevation_rad = std::clamp(std::asin(std::clamp(way.y(), -1.0, 1.0)), -limit, limit);
  p.azimuth_rad = std::atan2(-way.x(), -way.z());
}

void SimulatorMode::build_scanners() {
  auto* section = new Section(tr("Scanners"), true, this);
  list_ = new QListWidget(section);
  list_->setObjectName("scanner_list");
  list_->setAccessibleName(tr("Scanners"));
  list_->setFixedHeight(84);
  auto* row = new QHBoxLayout;
  auto* add = tool_button(tr("Add scanner"), tr("Matrix and line scanners from presets"), section);
  add->setObjectName("tool");
  auto* menu = new QMenu(add);
  for (const std::string& preset : scanner_presets()) {
    const QString name = QString::fromStdString(preset);
    connect(menu->addAction(name), &QAction::triggered, this, [this, name] { add_scanner(name); });
  }
  menu->addSeparator();
  connect(menu->addAction(tr("From file…")), &QAction::triggered, this, [this] {
    const QString path =
        QFileDialog::getOpenFileName(this, tr("Scanner"), {}, tr("Scanners (*.toml)"));
    if (!path.isEmpty()) add_scanner(path);
  });
  add->setMenu(menu);
  add->setProperty("menu", true);
  add->setPopupMode(QToolButton::InstantPopup);
  auto* remove = button(tr("Remove"), tr("Remove the selected scanner"), section);
  row->addWidget(add);
  row->addWidget(remove);
  row->addStretch();
  places_ = new QStackedWidget(section);
  section->body()->addWidget(list_);
  section->body()->addLayout(row);
  section->body()->addWidget(
      quiet_label(tr("Drag a scanner in the view to move it, with Shift nearer or farther, or "
                     "type its place:"),
                  section));
  section->body()->addWidget(places_);
  connect(list_, &QListWidget::currentRowChanged, this, &SimulatorMode::select_scanner);
  connect(remove, &QPushButton::clicked, this, &SimulatorMode::remove_selected);
  panel()->addWidget(section);
}

void SimulatorMode::add_scanner(const QString& model) {
  if (!add_entry({model.toStdString(), {}})) return;
  RigScanner& scanner = *scanners_.back();
  // Next to the existing ones.
  ScannerPlacement& place = scanner.editor->placement();
  place.azimuth_rad = double(scanners_.size() - 1) * 0.5 * std::numbers::pi;
  if (place.azimuth_rad > 6.0) place.azimuth_rad = 0.8;
  const ScannerModel& m = scanner.editor->model();
  if (place.distance_m > 0.95 * m.far_m || place.distance_m < 1.05 * m.near_m)
    place.distance_m = 0.5 * (m.near_m + m.far_m);
  scanner.editor->refresh();
  draw_scanner(scanner);
  list_->setCurrentRow(list_->count() - 1);
  place_changed();
  // It may be outside the view; otherwise the camera stays where the user has put it.
  const Vec3d at = scanner_pose(place, aim_height(), 0.5, Vec3d::UnitY()).translation();
  const auto pixel = view().project(at);
  if (!pixel || !QRectF(view().rect()).contains(*pixel)) view().reset_camera();
}

bool SimulatorMode::add_entry(const ScannerEntry& entry) {
  auto base = find_scanner_parameters(entry.model);
  auto setup = scanner_setup(entry, scene_->placement);
  if (!setup) {
    error_->show_text(QString::fromStdString(setup.error().text()));
    return false;
  }
  auto scanner = std::make_unique<RigScanner>();
  RigScanner* raw = scanner.get();
  raw->editor = new ScannerEditor(entry, std::move(*base), std::move(*setup), places_);
  places_->addWidget(raw->editor);
  scanners_.push_back(std::move(scanner));
  list_->addItem(raw->editor->title());
  connect(raw->editor, &ScannerEditor::changed, this, [this, raw] {
    error_->show_text(raw->editor->error());
    show_titles();
    draw_scanner(*raw);
    pause_->start();
  });
  connect(raw->editor, &ScannerEditor::failed, error_, &MessageLabel::show_text);
  connect(raw->editor, &ScannerEditor::saved, this,
          [this](const QString& file) { Q_EMIT status(tr("Wrote %1").arg(shown_path(file))); });
  draw_scanner(*raw);
  return true;
}

void SimulatorMode::remove_selected() {
  const int row = list_->currentRow();
  if (row < 0 || row >= int(scanners_.size())) return;
  take_scanner(row);
  place_changed();
}

void SimulatorMode::take_scanner(int row) {
  RigScanner& scanner = *scanners_[std::size_t(row)];
  view().remove(scanner.lines);
  view().remove(scanner.bodies);
  places_->removeWidget(scanner.editor);
  scanner.editor->disconnect(this);
  scanner.editor->deleteLater();
  scanners_.erase(scanners_.begin() + row);
  delete list_->takeItem(row);
}

void SimulatorMode::select_scanner(int row) {
  if (row >= 0 && row < int(scanners_.size()))
    places_->setCurrentWidget(scanners_[std::size_t(row)]->editor);
  for (const auto& scanner : scanners_) view().set_style(scanner->lines, lines_style(*scanner));
}

void SimulatorMode::draw_rig() {
  // Results of another scene do not apply to this one.
  clear_samples();
  view().remove(coverage_item_);
  view().remove(hole_item_);
  coverage_item_ = hole_item_ = 0;
  view().set_legend(rig_legend());
  coverage_box_->setVisible(false);
  const bool first = table_item_ == 0;
  view().remove(table_item_);
  Segments lines = table_segments(scene_->platter.radius_m, scene_->motion.turns < 0.0);
  const Pose pose = table_pose(scene_->table);
  for (Vec3f& p : lines.points) p = (pose * p.cast<double>()).cast<float>();
  ItemStyle style;
  style.boxed = false;
  style.color = kTableColor;
  style.line_width = 2.0;
  table_item_ = view().add(make_drawable(lines), style);
  for (const auto& scanner : scanners_) draw_scanner(*scanner);
  if (first) view().look(StandardView::kCorner);
}

void SimulatorMode::draw_scanner(RigScanner& scanner) {
  if (object_item_ == 0) return;  // scanners aim at its height
  const Vec3d axis = table_pose(scene_->table).linear().col(1);
  const ScannerPlacement& place = scanner.editor->placement();
  const ScannerModel& model = scanner.editor->model();
  const Pose pose = scanner_pose(place, aim_height(), 0.5, axis);
  const double size = std::clamp(0.06 * place.distance_m, 0.01, 0.08);
  Segments lines = frustum_segments(model, pose, place.distance_m + 1.2 * scene_->platter.radius_m);
  const Segments housing = housing_segments(model, pose, size);
  lines.points.insert(lines.points.end(), housing.points.begin(), housing.points.end());
  const DrawablePtr bodies =
      make_drawable(joined(ball(pose * model.emitter_m, 0.2 * size, kEmitterColor),
                           ball(pose * model.receiver_m, 0.2 * size, kReceiverColor)));
  ItemStyle style;
  style.boxed = false;
  style.in_view = true;
  if (scanner.lines == 0) {
    scanner.bodies = view().add(bodies, style);
    scanner.lines = view().add(make_drawable(lines), lines_style(scanner));
  } else {
    view().replace(scanner.bodies, bodies);
    view().replace(scanner.lines, make_drawable(lines));
  }
}

void SimulatorMode::show_titles() {
  for (std::size_t i = 0; i < scanners_.size(); ++i)
    list_->item(int(i))->setText(scanners_[i]->editor->title());
}

/// The selected scanner is swept: the others keep their places.
void SimulatorMode::build_sweep() {
  auto* section = new Section(tr("Sweep"), false, this);
  const auto swept_scene = [this]() -> Result<SceneDescription> {
    const int row = list_->currentRow();
    if (row < 0)
      return fail(ErrorCode::kInvalidOption, "there is no scanner; add one and select it");
    swept_ = scanners_[std::size_t(row)].get();
    SceneDescription scene = this->scene();
    scene.placement = scanners_[std::size_t(row)]->editor->placement();
    scene.scanners.clear();
    // The swept place is the scene's, so that the others state the whole of theirs.
    for (const auto& scanner : scanners_) {
      const bool swept = scanner == scanners_[std::size_t(row)];
      scene.scanners.push_back(
          scanner->editor->entry(swept ? std::optional(scene.placement) : std::nullopt));
    }
    return scene;
  };
  auto* sweep = new SweepPanel(jobs(), swept_scene, *coverage_, section);
  section->body()->addWidget(
      quiet_label(tr("Coverage of the selected scanner as it is turned:"), section));
  section->body()->addWidget(sweep);
  panel()->addWidget(section);
  connect(sweep, &SweepPanel::best_wanted, this,
          [this](const std::string& option, const std::string& value) {
            for (std::size_t i = 0; i < scanners_.size(); ++i) {
              if (scanners_[i].get() != swept_) continue;
              list_->setCurrentRow(int(i));
              (void)describe(scanners_[i]->editor->placement()).set(option, value);
              drag_scanner(*scanners_[i]);
              return place_changed();
            }
            Q_EMIT status(tr("The scanner that was swept is no longer there"));
          });
}

/// The selected scanner's frustum is emphasised, so that several remain legible.
ItemStyle SimulatorMode::lines_style(const RigScanner& scanner) const {
  const int row = list_->currentRow();
  const bool selected =
      row >= 0 && row < int(scanners_.size()) && scanners_[std::size_t(row)].get() == &scanner;
  ItemStyle style;
  style.boxed = style.in_view = false;
  style.color = selected ? kViewColor : QColor(0x9cc4a6);
  style.line_width = selected ? 1.8 : 1.0;
  return style;
}

void SimulatorMode::drag_scanner(RigScanner& scanner) {
  scanner.editor->refresh();
  draw_scanner(scanner);
}

}  // namespace turnscan::studio
