#include "explorer.hpp"

#include <QFileDialog>
#include <QFileInfo>
#include <QSettings>
#include <QVBoxLayout>

#include "jobs.hpp"
#include "loading.hpp"
#include "model_list.hpp"
#include "runs.hpp"
#include "scene_view.hpp"
#include "section.hpp"
#include "stage_panel.hpp"

namespace turnscan::studio {

ExplorerMode::ExplorerMode(const Services& services, QWidget* parent)
    : Mode(services, parent),
      store_(new ModelStore(this)),
      list_(new ModelList(*store_, this)),
      stages_(new StagePanel(this)) {
  auto* models = new Section(tr("Models"), true, this);
  models->body()->addWidget(list_);
  auto* stages = new Section(tr("Processing"), true, this);
  stages->body()->addWidget(stages_);
  panel()->addWidget(models);
  panel()->addWidget(stages);
  panel()->addStretch();
  view().set_empty_text(tr("Nothing loaded yet"),
                        tr("Drop meshes, point clouds or recordings here, or press Ctrl+O."));
  connect(store_, &ModelStore::changed, this, &ExplorerMode::sync);
  connect(list_, &ModelList::selection_changed, this, &ExplorerMode::on_selection);
  connect(list_, &ModelList::open_wanted, this, &ExplorerMode::open_dialog);
  connect(list_, &ModelList::save_wanted, this, &ExplorerMode::save);
  connect(stages_, &StagePanel::run, this, &ExplorerMode::run_stage);
  connect(stages_, &StagePanel::filter, this, &ExplorerMode::run_filter);
  on_selection(0);
}

ExplorerMode::~ExplorerMode() = default;

void ExplorerMode::shut_down() { stages_->store(); }

bool ExplorerMode::open_file(const QString& path) {
  load(path, {});
  return true;
}

void ExplorerMode::open_dialog() {
  QSettings settings;
  const QStringList files = QFileDialog::getOpenFileNames(
      this, tr("Open meshes, clouds or recordings"), settings.value("files/folder").toString(),
      tr("Meshes, clouds and recordings (*.ply *.pcd *.stl *.obj *.off *.3mf *.glb *.dae *.fbx "
         "recording.json);;All files (*)"));
  for (const QString& file : files) {
    settings.setValue("files/folder", QFileInfo(file).absolutePath());
    load(file, {});
  }
}

void ExplorerMode::load(const QString& path, const std::function<void()>& then) {
  stages_->show_error({});
  jobs().start(
      tr("Open %1").arg(QFileInfo(path).fileName()), this,
      [this, path, then](const RunContext& context) -> Result<Finish> {
        TURNSCAN_ASSIGN(NamedModels models, load_models(path.toStdString(), context));
        return Finish([this, path, then, models = std::move(models)] {
          const auto ids = store_->add_all(models, tr("open %1").arg(QFileInfo(path).fileName()));
          list_->select(ids.back());
          Q_EMIT file_opened(path);
          if (then) then();
        });
      },
      [this](const QString& text) { stages_->show_error(text); });
}

void ExplorerMode::take_recording(const QString& folder, bool reconstruct) {
  load(folder, [this, reconstruct] {
    if (reconstruct) run_stage(QString::fromStdString(kMeshStage));
  });
}

void ExplorerMode::run_stage(const QString& stage) {
  const Model* selected = store_->find(list_->selected());
  const QString problem = stages_->first_error();
  stages_->show_error(problem);
  if (!selected || !problem.isEmpty()) return;
  jobs().start(
      tr("Reconstruct"), this,
      [this, model = *selected, stage = stage.toStdString(),
       options = stages_->options()](const RunContext& context) -> Result<Finish> {
        TURNSCAN_ASSIGN(StageRun run, run_stage_of(model, stage, options, context));
        return Finish([this, id = model.id, run = std::move(run)] {
          const auto ids = store_->add_all(run.models, tr("reconstruct"));
          // What it was made from lies in the same place; it would hide the result.
          store_->set_visible(id, false);
          list_->select(ids.front());
          stages_->show_used(run.choices);
        });
      },
      [this](const QString& text) { stages_->show_error(text); });
}

void ExplorerMode::run_filter() {
  const Model* selected = store_->find(list_->selected());
  const QString problem = stages_->first_error();
  stages_->show_error(problem);
  if (!selected || !problem.isEmpty()) return;
  jobs().start(
      tr("Filter"), this,
      [this, model = *selected,
       options = stages_->options().outliers](const RunContext& context) -> Result<Finish> {
        TURNSCAN_ASSIGN(ModelDataPtr kept, filter_cloud(model, options, context));
        return Finish([this, model, kept] {
          const int id = store_->add(tr("%1 filtered").arg(model.name), kept);
          store_->set_visible(model.id, false);
          list_->select(id);
        });
      },
      [this](const QString& text) { stages_->show_error(text); });
}

void ExplorerMode::save() {
  const Model* model = store_->find(list_->selected());
  if (!model) return;
  QSettings settings;
  const bool mesh = model->data->kind == ModelKind::kMesh;
  const QString folder = settings.value("files/folder").toString();
  const QString name = QString("%1/%2.%3").arg(folder.isEmpty() ? "." : folder, model->name, "ply");
  const QString path = QFileDialog::getSaveFileName(
      this, tr("Save %1").arg(model->name), name,
      mesh ? tr("PLY (*.ply);;STL, millimetres (*.stl);;3MF, millimetres (*.3mf);;OBJ (*.obj);;"
                "GLB (*.glb)")
           : tr("PLY (*.ply)"));
  if (path.isEmpty()) return;
  settings.setValue("files/folder", QFileInfo(path).absolutePath());
  save_as(model->id, path);
}

void ExplorerMode::save_as(int id, const QString& path) {
  const Model* model = store_->find(id);
  if (!model) return;
  stages_->show_error({});
  jobs().start(
      tr("Save %1").arg(QFileInfo(path).fileName()), this,
      [this, saved = model->data, path](const RunContext& context) -> Result<Finish> {
        context.begin_phase("write", 0);
        TURNSCAN_TRY(save_model(*saved, path.toStdString()));
        return Finish([this, path] { Q_EMIT status(tr("Wrote %1").arg(path)); });
      },
      [this](const QString& text) { stages_->show_error(text); });
}

void ExplorerMode::remove_selected() { store_->remove(list_->selected()); }

void ExplorerMode::sync() {
  for (auto it = shown_.begin(); it != shown_.end();) {
    if (store_->find(it->first)) {
      ++it;
    } else {
      view().remove(it->second.item);
      it = shown_.erase(it);
    }
  }
  for (const Model& model : store_->models()) {
    ItemStyle style;
    style.visible = model.visible;
    style.color = model.color;
    style.own_colors = model.own_colors;
    Shown& shown = shown_[model.id];
    if (shown.item == 0) {
      shown.item = view().add(model.data->drawable, style);
    } else {
      if (shown.data != model.data) view().replace(shown.item, model.data->drawable);
      view().set_style(shown.item, style);
    }
    shown.data = model.data;
  }
}

void ExplorerMode::on_selection(int id) {
  const Model* model = store_->find(id);
  const bool recording = model && model->data->kind == ModelKind::kRecording;
  const bool cloud = model && model->data->kind == ModelKind::kCloud;
  stages_->set_target(recording, cloud);
  if (model) Q_EMIT status(QString("%1: %2").arg(model->name, count_text(*model->data)));
}

}  // namespace turnscan::studio
