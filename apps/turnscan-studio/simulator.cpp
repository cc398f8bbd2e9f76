#include "simulator.hpp"

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QPushButton>
#include <QSettings>
#include <QStackedWidget>
#include <QStandardPaths>
#include <QTableWidget>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <turnscan/simulator/builtin_objects.hpp>
#include <turnscan/simulator/scanner_file.hpp>

#include "jobs.hpp"
#include "option_form.hpp"
#include "rig_drawing.hpp"
#include "scene_view.hpp"
#include "section.hpp"
#include "simulator_runs.hpp"
#include "theme.hpp"

namespace turnscan::studio {

namespace {

constexpr std::size_t kShownSamples = 600000;
constexpr double kHandlePixels = 22.0;

QColor to_color(const Rgb& c) { return {c.r, c.g, c.b}; }

}  // namespace

struct SimulatorMode::Slot {
  QString name;
  ScannerModel model;
  ScannerPlacement placement;
  OptionForm* form = nullptr;
  QColor color;
  int lines = 0, bodies = 0;  // items of the view
};

/// Drags a scanner about the point that it looks at; with Shift nearer and farther.
class RigTool : public ViewTool {
 public:
  explicit RigTool(SimulatorMode& mode) : mode_(mode) {}

  bool press(const QPointF& at, Qt::KeyboardModifiers /*keys*/) override {
    dragged_ = -1;
    double best = kHandlePixels;
    for (std::size_t i = 0; i < mode_.slots_.size(); ++i) {
      const auto pixel = mode_.view().project(position_of(*mode_.slots_[i]));
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

  void drag(const QPointF& at, Qt::KeyboardModifiers keys) override {
    if (dragged_ < 0 || dragged_ >= int(mode_.slots_.size())) return;
    auto& slot = *mode_.slots_[std::size_t(dragged_)];
    if (keys.testFlag(Qt::ShiftModifier)) {
      const double factor = std::exp(0.005 * (at.y() - last_.y()));
      slot.placement.distance_m = std::clamp(slot.placement.distance_m * factor, 0.05, 50.0);
    } else {
      turn(slot, at);
    }
    last_ = at;
    mode_.drag_slot(slot);
  }

  void release(const QPointF& /*at*/) override {
    dragged_ = -1;
    mode_.place_changed();
  }
  QCursor cursor() const override { return Qt::ArrowCursor; }

 private:
  Vec3d position_of(const SimulatorMode::Slot& slot) const {
    return scanner_pose(slot.placement, mode_.aim_height(), 0.5, Vec3d::UnitY()).translation();
  }

  /// Where the line of sight meets the ball about the aim on which the scanner stands.
  void turn(SimulatorMode::Slot& slot, const QPointF& at) const {
    ScannerPlacement& p = slot.placement;
    const Vec3d aim(p.aim_x_m, p.aim_height_m.value_or(mode_.aim_height()), p.aim_z_m);
    const auto [origin, direction] = mode_.view().sight(at);
    const double along = (aim - origin).dot(direction);
    const Vec3d nearest = origin + along * direction;
    const double inside = p.distance_m * p.distance_m - (nearest - aim).squaredNorm();
    // Of the two places the one on whose side it stands already.
    const double side = (position_of(slot) - aim).dot(direction) > 0.0 ? 1.0 : -1.0;
    const Vec3d hit = nearest + side * std::sqrt(std::max(0.0, inside)) * direction;
    const Vec3d way = (hit - aim).normalized();
    const double limit = 0.5 * std::numbers::pi;
    p.elevation_rad = std::clamp(std::asin(std::clamp(way.y(), -1.0, 1.0)), -limit, limit);
    p.azimuth_rad = std::atan2(-way.x(), -way.z());
  }

  SimulatorMode& mode_;
  int dragged_ = -1;
  QPointF last_;
};

SimulatorMode::SimulatorMode(const Services& services, QWidget* parent)
    : Mode(services, parent),
      scene_(std::make_unique<SceneDescription>()),
      coverage_(std::make_unique<CoverageMapOptions>()),
      tool_(std::make_unique<RigTool>(*this)),
      quick_(new JobRunner(this)),
      preview_(new QTimer(this)),
      poll_(new QTimer(this)) {
  scene_->object = "builtin:doll";
  scene_->motion.frames = 60;
  preview_->setSingleShot(true);
  preview_->setInterval(150);
  connect(preview_, &QTimer::timeout, this, &SimulatorMode::load_preview);
  poll_->setInterval(120);
  connect(poll_, &QTimer::timeout, this, &SimulatorMode::show_samples);
  build_object();
  build_scanners();
  build_run();
  build_coverage();
  build_options();
  panel()->addStretch();
  view().set_tool(tool_.get());
  view().set_empty_text(tr("Loading the object"), {});
  restore();
  preview_->start();
}

SimulatorMode::~SimulatorMode() {
  view().set_tool(nullptr);
  delete quick_;
}

void SimulatorMode::build_object() {
  auto* section = new Section(tr("Object"), true, this);
  auto* row = new QHBoxLayout;
  object_ = new QComboBox(section);
  object_->setObjectName("simulator_object");
  for (const std::string& name : builtin_object_names())
    object_->addItem(title_of(name), QString::fromStdString("builtin:" + name));
  auto* open = button(tr("File…"), tr("Any mesh: PLY, STL, OBJ, OFF, 3MF, GLB, …"), section);
  row->addWidget(object_, 1);
  row->addWidget(open);
  section->body()->addLayout(row);
  auto* form = new OptionForm(describe(scene_->object_placement), {}, section);
  auto* place = new Section(tr("How it stands"), false, section);
  place->body()->addWidget(form);
  section->body()->addWidget(place);
  forms_.emplace_back("object", form);
  connect(form, &OptionForm::changed, preview_, qOverload<>(&QTimer::start));
  connect(object_, qOverload<int>(&QComboBox::activated), this,
          [this](int index) { set_object(object_->itemData(index).toString()); });
  connect(open, &QPushButton::clicked, this, [this] {
    const QString path = QFileDialog::getOpenFileName(this, tr("Object to scan"));
    if (!path.isEmpty()) set_object(path);
  });
  panel()->addWidget(section);
}

void SimulatorMode::build_scanners() {
  auto* section = new Section(tr("Scanners"), true, this);
  list_ = new QListWidget(section);
  list_->setObjectName("scanner_list");
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
  connect(list_, &QListWidget::currentRowChanged, this, &SimulatorMode::select_slot);
  connect(remove, &QPushButton::clicked, this, &SimulatorMode::remove_selected);
  panel()->addWidget(section);
}

void SimulatorMode::build_options() {
  auto* all = new Section(tr("Scene"), false, this);
  for (SceneTable& table : describe(*scene_)) {
    if (table.name == "object" || table.name == "placement") continue;
    auto* section = new Section(QString::fromStdString(table.title), false, all);
    auto* form = new OptionForm(std::move(table.options), {}, section);
    section->body()->addWidget(form);
    all->body()->addWidget(section);
    forms_.emplace_back(QString::fromStdString(table.name), form);
    connect(form, &OptionForm::changed, preview_, qOverload<>(&QTimer::start));
  }
  auto* section = new Section(tr("Coverage"), false, all);
  auto* form = new OptionForm(describe(*coverage_), {}, section);
  section->body()->addWidget(form);
  all->body()->addWidget(section);
  forms_.emplace_back("coverage", form);
  panel()->addWidget(all);
}

void SimulatorMode::build_run() {
  auto* section = new Section(tr("Recording"), true, this);
  auto* row = new QHBoxLayout;
  folder_ = new QLineEdit(section);
  folder_->setObjectName("simulator_folder");
  folder_->setToolTip(tr("Folder to make for the recording; it must not exist or be empty"));
  auto* browse = button(tr("…"), tr("Choose the folder"), section);
  row->addWidget(folder_, 1);
  row->addWidget(browse);
  run_ = primary_button(tr("Scan"), tr("Record the object with all scanners"), section);
  auto* next = new QHBoxLayout;
  send_ = button(tr("Open in Explorer"), tr("Load the recording in the Model Explorer"), section);
  reconstruct_ = button(tr("Reconstruct"), tr("Load it there and run every stage"), section);
  reconstruct_->setObjectName("simulator_reconstruct");
  next->addWidget(send_);
  next->addWidget(reconstruct_);
  error_ = new MessageLabel(section);
  section->body()->addLayout(row);
  section->body()->addWidget(run_);
  section->body()->addLayout(next);
  section->body()->addWidget(error_);
  send_->setEnabled(false);
  reconstruct_->setEnabled(false);
  connect(browse, &QPushButton::clicked, this, [this] {
    const QString path = QFileDialog::getExistingDirectory(this, tr("Folder of the recording"));
    if (!path.isEmpty()) folder_->setText(path);
  });
  connect(run_, &QPushButton::clicked, this, &SimulatorMode::run);
  const auto send = [this](bool on) {
    if (result_) Q_EMIT recording_made(QString::fromStdString(result_->folder), on);
  };
  connect(send_, &QPushButton::clicked, this, [send] { send(false); });
  connect(reconstruct_, &QPushButton::clicked, this, [send] { send(true); });
  panel()->addWidget(section);
}

void SimulatorMode::build_coverage() {
  auto* section = new Section(tr("What was covered"), true, this);
  coverage_box_ = section;
  coloring_ = new QComboBox(section);
  coloring_->setObjectName("coverage_coloring");
  coloring_->addItems(
      {tr("Coverage"), tr("Density of samples"), tr("Why it was missed"), tr("The samples only")});
  holes_ = new QTableWidget(0, 3, section);
  holes_->setObjectName("holes");
  holes_->setHorizontalHeaderLabels({tr("Hole"), tr("Size, mm"), tr("Reason")});
  holes_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  holes_->horizontalHeader()->setStretchLastSection(true);
  holes_->verticalHeader()->hide();
  holes_->setSelectionBehavior(QAbstractItemView::SelectRows);
  holes_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  holes_->setShowGrid(false);
  holes_->setMinimumHeight(190);
  section->body()->addWidget(coloring_);
  section->body()->addWidget(
      quiet_label(tr("The largest holes; click one to fly there."), section));
  section->body()->addWidget(holes_);
  connect(coloring_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          &SimulatorMode::show_coloring);
  connect(holes_, &QTableWidget::cellClicked, this, [this](int row, int) { fly_to_hole(row); });
  section->setVisible(false);
  panel()->addWidget(section);
}

bool SimulatorMode::open_file(const QString& path) {
  if (QFileInfo(path).isDir()) return false;
  set_object(path);
  return true;
}

void SimulatorMode::set_object(const QString& object) {
  int index = object_->findData(object);
  if (index < 0) {
    object_->addItem(QFileInfo(object).fileName(), object);
    index = object_->count() - 1;
  }
  object_->setCurrentIndex(index);
  scene_->object = object.toStdString();
  preview_->start();
}

void SimulatorMode::set_folder(const QString& folder) { folder_->setText(folder); }

void SimulatorMode::add_scanner(const QString& model) {
  auto found = find_scanner(model.toStdString());
  if (!found) {
    error_->show_text(QString::fromStdString(found.error().text()));
    return;
  }
  auto slot = std::make_unique<Slot>();
  slot->name = model;
  slot->model = std::move(*found);
  slot->placement = scene_->placement;
  // Beside those that are there already.
  slot->placement.azimuth_rad = double(slots_.size()) * 0.5 * std::numbers::pi;
  if (slot->placement.azimuth_rad > 6.0) slot->placement.azimuth_rad = 0.8;
  const ScannerModel& m = slot->model;
  if (slot->placement.distance_m > 0.95 * m.far_m || slot->placement.distance_m < 1.05 * m.near_m)
    slot->placement.distance_m = 0.5 * (m.near_m + m.far_m);
  slot->color = model_color(int(slots_.size()) + 3);
  slot->form = new OptionForm(describe(slot->placement), {}, places_);
  places_->addWidget(slot->form);
  Slot* raw = slot.get();
  connect(slot->form, &OptionForm::changed, this, [this, raw] {
    draw_slot(*raw);
    place_changed();
  });
  slots_.push_back(std::move(slot));
  list_->addItem(QFileInfo(model).completeBaseName());
  list_->setCurrentRow(list_->count() - 1);
  draw_slot(*raw);
  place_changed();
}

void SimulatorMode::remove_selected() {
  const int row = list_->currentRow();
  if (row < 0 || row >= int(slots_.size())) return;
  Slot& slot = *slots_[std::size_t(row)];
  view().remove(slot.lines);
  view().remove(slot.bodies);
  places_->removeWidget(slot.form);
  slot.form->deleteLater();
  slots_.erase(slots_.begin() + row);
  delete list_->takeItem(row);
  place_changed();
}

void SimulatorMode::select_slot(int row) {
  if (row >= 0 && row < int(slots_.size()))
    places_->setCurrentWidget(slots_[std::size_t(row)]->form);
}

bool SimulatorMode::ready() const {
  return object_item_ != 0 && !preview_->isActive() && !quick_->busy();
}

const SceneDescription& SimulatorMode::scene() {
  scene_->scanners.clear();
  for (const auto& slot : slots_) {
    ScannerEntry entry;
    entry.model = slot->name.toStdString();
    ScannerPlacement common = scene_->placement, own = slot->placement;
    const OptionTable before = describe(common), now = describe(own);
    for (std::size_t i = 0; i < now.fields().size(); ++i) {
      const std::string value = now.fields()[i].get();
      if (value != before.fields()[i].get())
        entry.placement.emplace_back(now.fields()[i].name, value);
    }
    scene_->scanners.push_back(std::move(entry));
  }
  return *scene_;
}

double SimulatorMode::aim_height() const {
  return placed_ ? 0.5 * std::max(0.0, bounds(placed_->mesh.vertices).max.y()) : 0.0;
}

void SimulatorMode::place_changed() { store(); }

void SimulatorMode::load_preview() {
  store();
  quick_->cancel();
  quick_->start(
      tr("Preview"), this,
      [this, scene = scene()](const RunContext& context) -> Result<Finish> {
        TURNSCAN_ASSIGN(const auto placed, load_object(scene, context));
        DrawablePtr drawable = make_drawable(placed ? placed->mesh : TriangleMesh());
        return Finish([this, placed, drawable] {
          placed_ = placed;
          ItemStyle style;
          style.color = model_color(0);
          if (object_item_ == 0) {
            object_item_ = view().add(drawable, style);
          } else {
            view().replace(object_item_, drawable);
            view().set_style(object_item_, style);
          }
          error_->show_text({});
          draw_rig();
        });
      },
      [this](const QString& text) { error_->show_text(text); });
}

void SimulatorMode::draw_rig() {
  // What was seen of another scene says nothing about this one.
  clear_samples();
  view().remove(coverage_item_);
  coverage_item_ = 0;
  view().set_legend({});
  coverage_box_->setVisible(false);
  const bool first = table_item_ == 0;
  view().remove(table_item_);
  Segments lines = table_segments(scene_->platter.radius_m, scene_->motion.turns < 0.0);
  const Pose pose = table_pose(scene_->table);
  for (Vec3f& p : lines.points) p = (pose * p.cast<double>()).cast<float>();
  ItemStyle style;
  style.boxed = false;
  style.color = QColor(0x5d7890);
  style.line_width = 2.0;
  table_item_ = view().add(make_drawable(lines), style);
  for (const auto& slot : slots_) draw_slot(*slot);
  if (first) view().look(StandardView::kCorner);
}

void SimulatorMode::draw_slot(Slot& slot) {
  if (object_item_ == 0) return;  // its height is where a scanner looks
  const Vec3d axis = table_pose(scene_->table).linear().col(1);
  const Pose pose = scanner_pose(slot.placement, aim_height(), 0.5, axis);
  const double size = std::clamp(0.06 * slot.placement.distance_m, 0.01, 0.08);
  Segments lines = frustum_segments(slot.model, pose, 1.25 * slot.placement.distance_m);
  const Segments housing = housing_segments(pose, size);
  lines.points.insert(lines.points.end(), housing.points.begin(), housing.points.end());
  TriangleMesh bodies = ball(pose * slot.model.emitter_m, 0.18 * size, kEmitterColor);
  const TriangleMesh eye = ball(pose * slot.model.receiver_m, 0.18 * size, kReceiverColor);
  const auto shift = static_cast<std::uint32_t>(bodies.vertices.size());
  bodies.vertices.insert(bodies.vertices.end(), eye.vertices.begin(), eye.vertices.end());
  bodies.normals.insert(bodies.normals.end(), eye.normals.begin(), eye.normals.end());
  bodies.colors.insert(bodies.colors.end(), eye.colors.begin(), eye.colors.end());
  for (const auto& t : eye.triangles)
    bodies.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  ItemStyle style;
  style.boxed = false;
  style.in_view = false;
  style.color = QColor(0x3f9b57);
  if (slot.lines == 0) {
    slot.lines = view().add(make_drawable(lines), style);
    style.in_view = true;
    slot.bodies = view().add(make_drawable(bodies), style);
  } else {
    view().replace(slot.lines, make_drawable(lines));
    view().replace(slot.bodies, make_drawable(bodies));
  }
}

void SimulatorMode::drag_slot(Slot& slot) {
  slot.form->refresh();
  draw_slot(slot);
}

void SimulatorMode::run() {
  error_->show_text({});
  for (const auto& [name, form] : forms_)
    if (!form->valid()) return error_->show_text(form->first_error());
  for (const auto& slot : slots_)
    if (!slot->form->valid()) return error_->show_text(slot->form->first_error());
  if (slots_.empty()) return error_->show_text(tr("There is no scanner; add one first"));
  clear_samples();
  coverage_box_->setVisible(false);
  view().remove(coverage_item_);
  coverage_item_ = 0;
  view().set_legend({});
  if (folder_->text().trimmed().isEmpty()) folder_->setText(QDir::home().filePath("simulation"));
  QString folder = folder_->text().trimmed();
  // Nothing is overwritten: the next free name.
  const QString base = folder;
  for (int i = 2; QDir(folder).exists() && !QDir(folder).isEmpty(); ++i)
    folder = QString("%1-%2").arg(base).arg(i);
  stream_ = std::make_shared<SampleStream>();
  poll_->start();
  run_->setEnabled(false);
  const auto sink = [stream = stream_](const std::vector<Vec3f>& points) {
    const std::lock_guard lock(stream->mutex);
    stream->points.insert(stream->points.end(), points.begin(), points.end());
  };
  jobs().start(
      tr("Scan"), this,
      [this, scene = scene(), folder = folder.toStdString(), coverage = *coverage_,
       sink](const RunContext& context) -> Result<Finish> {
        TURNSCAN_ASSIGN(SimulationResult made, simulate(scene, folder, coverage, sink, context));
        auto shared = std::make_shared<SimulationResult>(std::move(made));
        return Finish([this, shared] { show_result(shared); });
      },
      [this](const QString& text) { error_->show_text(text); });
  auto* once = new QObject(this);
  connect(&jobs(), &JobRunner::finished, once, [this, once] {
    show_samples();
    poll_->stop();
    run_->setEnabled(true);
    once->deleteLater();
  });
}

void SimulatorMode::show_samples() {
  if (!stream_) return;
  PointCloud cloud;
  {
    const std::lock_guard lock(stream_->mutex);
    cloud.points.swap(stream_->points);
  }
  if (cloud.empty() || samples_shown_ > kShownSamples) return;
  samples_shown_ += cloud.size();
  ItemStyle style;
  style.color = QColor(0x12708f);
  style.boxed = false;
  style.in_view = false;
  sample_items_.push_back(view().add(make_drawable(cloud), style));
}

void SimulatorMode::clear_samples() {
  for (const int item : sample_items_) view().remove(item);
  sample_items_.clear();
  samples_shown_ = 0;
}

void SimulatorMode::show_result(std::shared_ptr<SimulationResult> result) {
  result_ = std::move(result);
  send_->setEnabled(true);
  reconstruct_->setEnabled(true);
  Q_EMIT status(tr("Wrote %1").arg(QString::fromStdString(result_->folder)));
  if (!result_->colored[0]) return;
  coverage_box_->setVisible(true);
  fill_holes();
  show_coloring(coloring_->currentIndex());
}

void SimulatorMode::show_coloring(int index) {
  if (!result_ || !result_->colored[0]) return;
  const bool samples = index == 3;
  for (const int item : sample_items_) {
    ItemStyle style;
    style.color = QColor(0x12708f);
    style.boxed = style.in_view = false;
    style.visible = samples;
    view().set_style(item, style);
  }
  ItemStyle object;
  object.color = model_color(0);
  object.visible = samples;
  view().set_style(object_item_, object);
  view().remove(coverage_item_);
  coverage_item_ = 0;
  Legend legend;
  if (!samples) {
    ItemStyle style;
    style.boxed = false;
    coverage_item_ = view().add(result_->colored[std::size_t(index)], style);
  }
  const double area = std::max(1e-12, result_->map.area_m2);
  if (index == 0) {
    legend.title = tr("Share of the surface");
    for (std::size_t s = 0; s < kCoverageStateCount; ++s) {
      const auto state = static_cast<CoverageState>(s);
      legend.entries.push_back({to_color(color_of(state)),
                                QString("%1  %2 %")
                                    .arg(title_of(std::string(name_of(state))))
                                    .arg(100.0 * result_->map.state_m2[s] / area, 0, 'f', 1)});
    }
  } else if (index == 1) {
    legend.title = tr("Samples per mm²");
    legend.continuous = true;
    const double thin = coverage_->thin_per_mm2;
    const QColor colors[] = {QColor(38, 70, 160), QColor(60, 160, 110), QColor(240, 220, 70)};
    for (int i = 0; i < 3; ++i)
      legend.entries.push_back({colors[i], QString::number(thin * std::pow(16.0, i), 'g', 3)});
  } else if (index == 2) {
    legend.title = tr("Without a sample");
    for (int m = 1; m < kMissCount; ++m) {
      const double share = result_->map.reason_m2[std::size_t(m)] / area;
      if (share < 5e-4) continue;
      legend.entries.push_back({to_color(color_of(static_cast<Miss>(m))),
                                QString("%1  %2 %")
                                    .arg(title_of(std::string(name_of(static_cast<Miss>(m)))))
                                    .arg(100.0 * share, 0, 'f', 1)});
    }
    legend.entries.push_back({to_color(color_of(Miss::kNone)), tr("Has samples")});
  }
  view().set_legend(legend);
}

void SimulatorMode::fill_holes() {
  const auto& holes = result_->map.holes;
  holes_->setRowCount(int(holes.size()));
  for (std::size_t i = 0; i < holes.size(); ++i) {
    const CoverageHole& hole = holes[i];
    const Vec3d size = 1e3 * hole.size_m;
    const QString texts[] = {tr("%1 cm²").arg(1e4 * hole.area_m2, 0, 'f', 1),
                             QString("%1 × %2 × %3")
                                 .arg(size.x(), 0, 'f', 0)
                                 .arg(size.y(), 0, 'f', 0)
                                 .arg(size.z(), 0, 'f', 0),
                             title_of(std::string(name_of(hole.reason)))};
    for (int c = 0; c < 3; ++c) holes_->setItem(int(i), c, new QTableWidgetItem(texts[c]));
  }
}

void SimulatorMode::fly_to_hole(int row) {
  if (!result_ || row < 0 || row >= int(result_->map.holes.size())) return;
  const CoverageHole& hole = result_->map.holes[std::size_t(row)];
  const Vec3d at = result_->T_world_table * hole.center;
  Vec3d outward = at - Vec3d(0.0, aim_height(), 0.0);
  if (outward.norm() < 1e-6) outward = Vec3d::UnitZ();
  view().fly_to(at, std::max(0.05, 2.5 * hole.size_m.norm()), outward);
}

void SimulatorMode::store() {
  QSettings settings;
  settings.setValue("simulator/scene", QString::fromStdString(scene_toml(scene())));
  settings.setValue("simulator/folder", folder_->text());
}

void SimulatorMode::restore() {
  const QSettings settings;
  folder_->setText(
      settings.value("simulator/folder", QDir::home().filePath("simulation")).toString());
  add_scanner("kinect-v2");
}

}  // namespace turnscan::studio
