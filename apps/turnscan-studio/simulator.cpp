#include "simulator.hpp"

#include <QComboBox>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QSettings>
#include <QStackedWidget>
#include <QTemporaryFile>
#include <QTimer>
#include <QVBoxLayout>
#include <turnscan/io/atomic_file.hpp>
#include <turnscan/simulator/builtin_objects.hpp>

#include "jobs.hpp"
#include "option_form.hpp"
#include "paths.hpp"
#include "scene_view.hpp"
#include "section.hpp"
#include "simulator_parts.hpp"
#include "simulator_runs.hpp"
#include "theme.hpp"

namespace turnscan::studio {

namespace {

constexpr std::size_t kUndoSteps = 200;

}  // namespace

SimulatorMode::SimulatorMode(const Services& services, QWidget* parent)
    : Mode(services, parent),
      scene_(std::make_unique<SceneDescription>()),
      coverage_(std::make_unique<CoverageMapOptions>()),
      tool_(std::make_unique<RigTool>(*this)),
      quick_(new JobRunner(this)),
      preview_(new QTimer(this)),
      poll_(new QTimer(this)) {
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
  auto* place = new Section(tr("How it stands"), false, section, Section::kNested);
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

void SimulatorMode::build_options() {
  auto* all = new Section(tr("Scene"), false, this);
  auto* row = new QHBoxLayout;
  auto* load = button(tr("Load scene…"), tr("A scene file, as turnscan simulate reads it"), all);
  auto* save = button(tr("Save scene…"), tr("Everything here as a file for --scene"), all);
  row->addWidget(load);
  row->addWidget(save);
  all->body()->addLayout(row);
  const QString filter = tr("Scenes (*.toml)");
  connect(load, &QPushButton::clicked, this, [this, filter] {
    const QString path = QFileDialog::getOpenFileName(this, tr("Load scene"), {}, filter);
    if (!path.isEmpty()) load_scene(path);
  });
  connect(save, &QPushButton::clicked, this, [this, filter] {
    const QString path = QFileDialog::getSaveFileName(this, tr("Save scene"), "scene.toml", filter);
    if (!path.isEmpty()) save_scene(path);
  });
  for (SceneTable& table : describe(*scene_)) {
    if (table.name == "object" || table.name == "placement") continue;
    auto* section = new Section(QString::fromStdString(table.title), false, all, Section::kNested);
    auto* form = new OptionForm(std::move(table.options), {}, section);
    section->body()->addWidget(form);
    all->body()->addWidget(section);
    forms_.emplace_back(QString::fromStdString(table.name), form);
    connect(form, &OptionForm::changed, preview_, qOverload<>(&QTimer::start));
  }
  auto* section = new Section(tr("Coverage"), false, all, Section::kNested);
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
    if (!path.isEmpty()) set_folder(path);
  });
  connect(run_, &QPushButton::clicked, this, &SimulatorMode::run);
  const auto send = [this](bool on) {
    if (result_) Q_EMIT recording_made(QString::fromStdString(result_->folder), on);
  };
  connect(send_, &QPushButton::clicked, this, [send] { send(false); });
  connect(reconstruct_, &QPushButton::clicked, this, [send] { send(true); });
  panel()->addWidget(section);
}

bool SimulatorMode::open_file(const QString& path) {
  if (QFileInfo(path).isDir()) return false;
  set_object(path);
  return true;
}

void SimulatorMode::set_object(const QString& object) {
  show_object(object);
  scene_->object = object.toStdString();
  preview_->start();
}

void SimulatorMode::show_object(const QString& object) {
  int index = object_->findData(object);
  if (index < 0) {
    object_->addItem(QFileInfo(object).fileName(), object);
    index = object_->count() - 1;
  }
  object_->setCurrentIndex(index);
}

void SimulatorMode::set_folder(const QString& folder) { folder_->setText(shown_path(folder)); }

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

void SimulatorMode::load_preview() {
  place_changed();
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
  if (folder_->text().trimmed().isEmpty()) folder_->setText("~/simulation");
  // Nothing is overwritten: the next free name.
  const QString folder = free_folder(typed_path(folder_->text()));
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

/// Text of the scene as it is now; every change is a step of undo.
void SimulatorMode::place_changed() {
  const QString now = QString::fromStdString(scene_toml(scene()));
  if (step_ < int(steps_.size()) && steps_[std::size_t(step_)] == now) return;
  steps_.resize(std::min(steps_.size(), std::size_t(step_ + 1)));
  steps_.push_back(now);
  if (steps_.size() > kUndoSteps) steps_.erase(steps_.begin());
  step_ = int(steps_.size()) - 1;
  store();
  Q_EMIT undo_changed();
}

void SimulatorMode::go_to_step(int step) {
  if (step < 0 || step >= int(steps_.size())) return;
  step_ = step;
  SceneDescription scene;
  if (read_text(steps_[std::size_t(step)], scene)) apply_scene(std::move(scene));
  Q_EMIT undo_changed();
}

QString SimulatorMode::undo_text() const { return step_ > 0 ? tr("change of the rig") : QString(); }

QString SimulatorMode::redo_text() const {
  return step_ + 1 < int(steps_.size()) ? tr("change of the rig") : QString();
}

void SimulatorMode::store() {
  QSettings settings;
  settings.setValue("simulator/scene", QString::fromStdString(scene_toml(scene())));
  settings.setValue("simulator/folder", folder_->text());
  for (const auto& [name, form] : forms_)
    if (name == "coverage") form->store("simulator/coverage");
}

Result<> SimulatorMode::read_text(const QString& text, SceneDescription& scene) {
  QTemporaryFile file;
  const QByteArray bytes = text.toUtf8();
  if (!file.open() || file.write(bytes) != bytes.size() || !file.flush())
    return fail(ErrorCode::kIo, "no temporary file can be written");
  return read_scene(file.fileName().toStdString(), scene);
}

void SimulatorMode::restore() {
  const QSettings settings;
  folder_->setText(settings.value("simulator/folder", "~/simulation").toString());
  for (const auto& [name, form] : forms_)
    if (name == "coverage") form->restore("simulator/coverage");
  SceneDescription scene;
  const QString text = settings.value("simulator/scene").toString();
  // What does not fit any more is of an older version: then it begins anew.
  const bool good = !text.isEmpty() && read_text(text, scene) && scene.next_passes.empty();
  if (!good) {
    scene = SceneDescription();
    scene.object = "builtin:doll";
    scene.motion.frames = 60;
  }
  if (scene.scanners.empty()) scene.scanners.push_back({"kinect-v2", {}});
  apply_scene(std::move(scene));
}

void SimulatorMode::apply_scene(SceneDescription scene) {
  while (!slots_.empty()) {
    list_->setCurrentRow(0);
    take_slot(0);
  }
  const auto scanners = std::move(scene.scanners);
  *scene_ = std::move(scene);
  scene_->scanners.clear();
  for (const auto& [name, form] : forms_) form->refresh();
  for (const ScannerEntry& entry : scanners) add_slot(entry);
  if (list_->count() > 0) list_->setCurrentRow(0);
  show_object(QString::fromStdString(scene_->object));
  preview_->start();
}

void SimulatorMode::load_scene(const QString& path) {
  SceneDescription scene;
  auto read = read_scene(path.toStdString(), scene);
  if (read && !scene.next_passes.empty())
    read = fail_at(path.toStdString(), ErrorCode::kUnsupported,
                   "it has several passes, of which this window shows one; run it by 'turnscan "
                   "simulate --scene'");
  error_->show_text(read ? QString() : QString::fromStdString(read.error().text()));
  if (!read) return;
  if (scene.scanners.empty()) scene.scanners.push_back({"kinect-v2", {}});
  apply_scene(std::move(scene));
  place_changed();
}

void SimulatorMode::save_scene(const QString& path) {
  jobs().start(
      tr("Save scene"), this,
      [this, path, text = scene_toml(scene())](const RunContext&) -> Result<Finish> {
        TURNSCAN_TRY(write_file_atomically(path.toStdString(), text));
        return Finish([this, path] { Q_EMIT status(tr("Wrote %1").arg(shown_path(path))); });
      },
      [this](const QString& text) { error_->show_text(text); });
}

}  // namespace turnscan::studio
