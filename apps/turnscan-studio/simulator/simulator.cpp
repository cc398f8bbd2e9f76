#include "simulator/simulator.hpp"

#include <QComboBox>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QStackedWidget>
#include <QTimer>
#include <QVBoxLayout>
#include <turnscan/simulator/objects/builtin_objects.hpp>

#include "app/jobs.hpp"
#include "app/paths.hpp"
#include "simulator/simulator_parts.hpp"
#include "simulator/simulator_runs.hpp"
#include "view/scene_view.hpp"
#include "widgets/option_form.hpp"
#include "widgets/section.hpp"
#include "widgets/text.hpp"
#include "widgets/theme.hpp"

namespace turnscan::studio {

SimulatorMode::SimulatorMode(const Services& services, QWidget* parent)
    : Mode(services, parent),
      scene_(std::make_unique<SceneDescription>()),
      coverage_(std::make_unique<CoverageMapOptions>()),
      tool_(std::make_unique<RigTool>(*this)),
      quick_(new JobRunner(this)),
      preview_(new QTimer(this)),
      poll_(new QTimer(this)),
      pause_(new QTimer(this)) {
  preview_->setSingleShot(true);
  preview_->setInterval(150);
  connect(preview_, &QTimer::timeout, this, &SimulatorMode::load_preview);
  pause_->setSingleShot(true);
  pause_->setInterval(preview_->interval());
  connect(pause_, &QTimer::timeout, this, &SimulatorMode::place_changed);
  poll_->setInterval(120);
  connect(poll_, &QTimer::timeout, this, &SimulatorMode::show_samples);
  build_object();
  build_scanners();
  build_run();
  build_coverage();
  build_sweep();
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
  object_->setAccessibleName(tr("Object to scan"));
  for (const std::string& name : builtin_object_names())
    object_->addItem(translated_title(name), QString::fromStdString("builtin:" + name));
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
    const QString path = ask_save_path(this, tr("Save scene"), "scene.toml", filter);
    if (!path.isEmpty()) save_scene(path);
  });
  for (SceneTable& table : describe(*scene_)) {
    if (table.name == "object" || table.name == "placement") continue;
    auto* section =
        new Section(translated(QString::fromStdString(table.title)), false, all, Section::kNested);
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
  folder_->setAccessibleName(tr("Folder of the recording"));
  folder_->setToolTip(tr("Folder to create for the recording; if it exists, it must be empty"));
  auto* browse = button(tr("…"), tr("Choose the folder"), section);
  browse->setAccessibleName(tr("Choose the folder"));
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
  section->body()->addLayout(next);
  set_footer({error_, run_});
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
  for (const auto& scanner : scanners_)
    if (const QString text = scanner->editor->error(); !text.isEmpty())
      return error_->show_text(text);
  if (scanners_.empty()) return error_->show_text(tr("There is no scanner; add one first"));
  clear_samples();
  coverage_box_->setVisible(false);
  view().remove(coverage_item_);
  coverage_item_ = 0;
  view().set_legend({});
  if (folder_->text().trimmed().isEmpty()) folder_->setText("~/simulation");
  // Uses the next free name, so that nothing is overwritten.
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

}  // namespace turnscan::studio
