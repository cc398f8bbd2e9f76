#include "explorer.hpp"

#include <QFileDialog>
#include <QFileInfo>
#include <QSettings>
#include <QVBoxLayout>
#include <turnscan/io/atomic_file.hpp>

#include "compare_panel.hpp"
#include "explorer_tools.hpp"
#include "jobs.hpp"
#include "loading.hpp"
#include "model_list.hpp"
#include "paths.hpp"
#include "runs.hpp"
#include "scene_view.hpp"
#include "section.hpp"
#include "stage_panel.hpp"

namespace turnscan::studio {

ExplorerMode::ExplorerMode(const Services& services, QWidget* parent)
    : Mode(services, parent),
      store_(new ModelStore(this)),
      list_(new ModelList(*store_, this)),
      stages_(new StagePanel(this)),
      compare_(new ComparePanel(*store_, this)),
      tools_(new ToolPanel(view(), this)) {
  auto* models = new Section(tr("Models"), true, this);
  models->body()->addWidget(list_);
  auto* stages = new Section(tr("Processing"), true, this);
  stages->body()->addWidget(stages_);
  auto* tools = new Section(tr("Tools"), true, this);
  tools->body()->addWidget(tools_);
  auto* comparison = new Section(tr("Compare"), false, this);
  comparison->body()->addWidget(compare_);
  panel()->addWidget(models);
  panel()->addWidget(tools);
  panel()->addWidget(stages);
  panel()->addWidget(comparison);
  panel()->addStretch();
  view().set_empty_text(tr("Nothing loaded yet"),
                        tr("Drop meshes, point clouds or recordings here, or begin with a scan."));
  view().set_empty_actions({{tr("Open…"), [this] { open_dialog(); }},
                            {tr("Scan an object"), [this] { Q_EMIT mode_wanted("scanner"); }},
                            {tr("Simulate a scan"), [this] { Q_EMIT mode_wanted("simulator"); }}});
  connect(store_, &ModelStore::changed, this, &ExplorerMode::sync);
  connect(store_, &ModelStore::changed, this, &Mode::undo_changed);
  connect(list_, &ModelList::selection_changed, this, &ExplorerMode::on_selection);
  connect(list_, &ModelList::open_wanted, this, &ExplorerMode::open_dialog);
  connect(list_, &ModelList::save_wanted, this, &ExplorerMode::save);
  connect(stages_, &StagePanel::run, this, &ExplorerMode::run_stage);
  connect(stages_, &StagePanel::save_preset, this, &ExplorerMode::save_preset);
  connect(stages_, &StagePanel::filter, this, &ExplorerMode::run_filter);
  connect(compare_, &ComparePanel::changed, this, &ExplorerMode::sync);
  connect(compare_, &ComparePanel::distance_wanted, this, &ExplorerMode::run_comparison);
  connect(tools_, &ToolPanel::cut_wanted, this, [this](const Vec3d& normal, double offset) {
    edit_selected(tr("cut"), false, [normal, offset](const ModelData& from) {
      const QString source = tr("cut of %1").arg(from.source);
      return from.kind == ModelKind::kMesh
                 ? mesh_model(cut(from.mesh, normal, offset), source)
                 : cloud_model(cut(from.cloud, normal, offset), source, {}, from.viewpoints);
    });
  });
  connect(tools_, &ToolPanel::lassoed, this,
          [this](const Outline& outline, const Eigen::Matrix4d& to_pixels) {
            edit_selected(tr("lasso"), true, [outline, to_pixels](const ModelData& from) {
              return from.kind == ModelKind::kMesh
                         ? mesh_model(without_lassoed(from.mesh, outline, to_pixels), from.source)
                         : cloud_model(without_lassoed(from.cloud, outline, to_pixels), from.source,
                                       {}, from.viewpoints);
            });
          });
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
          view().fit_unless_moved();  // of a recording it has shown the table, too
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
        return Finish([this, path] { Q_EMIT status(tr("Wrote %1").arg(shown_path(path))); });
      },
      [this](const QString& text) { stages_->show_error(text); });
}

void ExplorerMode::save_preset(const QString& path) {
  stages_->show_error({});
  jobs().start(
      tr("Save preset"), this,
      [this, path, text = stages_->preset_text()](const RunContext&) -> Result<Finish> {
        TURNSCAN_TRY(write_file_atomically(path.toStdString(), text));
        return Finish([this, path] { Q_EMIT status(tr("Wrote %1").arg(shown_path(path))); });
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
  const Model* left = store_->find(compare_->reference());
  const Model* right = store_->find(compare_->compared());
  view().set_split(compare_->way() == ComparePanel::kSideBySide && left && right,
                   left ? left->name : QString(), right ? right->name : QString());
  for (const Model& model : store_->models()) {
    const ItemStyle style = style_of(model);
    Shown& shown = shown_[model.id];
    if (shown.item == 0) {
      shown.item = view().add(model.data->drawable, style);
    } else {
      if (shown.data != model.data) view().replace(shown.item, model.data->drawable);
      view().set_style(shown.item, style);
    }
    shown.data = model.data;
  }
  const Model* colored = store_->find(legend_model_);
  view().set_legend(colored && style_of(*colored).visible ? legend_ : Legend());
}

ItemStyle ExplorerMode::style_of(const Model& model) const {
  ItemStyle style;
  style.visible = model.visible;
  style.color = model.color;
  style.own_colors = model.own_colors;
  if (compare_->way() == ComparePanel::kOff) return style;
  const bool left = model.id == compare_->reference(), right = model.id == compare_->compared();
  style.visible = left || right;
  style.pane = right && !left ? 1 : 0;
  return style;
}

void ExplorerMode::run_comparison() {
  const Model* reference = store_->find(compare_->reference());
  const Model* compared = store_->find(compare_->compared());
  compare_->show_error(compare_->first_error());
  if (!reference || !compared || !compare_->first_error().isEmpty()) return;
  jobs().start(
      tr("Compare"), this,
      [this, a = *compared, b = *reference,
       options = compare_->options()](const RunContext& context) -> Result<Finish> {
        TURNSCAN_ASSIGN(Comparison made, compare(*a.data, *b.data, options, 0.0, context));
        return Finish([this, a, b, made = std::move(made)] {
          const int id = store_->add(tr("%1 to %2").arg(a.name, b.name), made.colored);
          store_->set_visible(a.id, false);
          store_->set_visible(b.id, false);
          list_->select(id);
          compare_->show_figures(made.figures);
          Legend legend;
          legend.title = tr("Distance to %1").arg(b.name);
          legend.continuous = true;
          legend.histogram = made.histogram;
          const QRgb colors[] = {0x440154, 0x3b528b, 0x21918c, 0x5ec962, 0xfde725};
          for (int i = 0; i < 5; ++i)
            legend.entries.push_back(
                {QColor(colors[i]), QString("%1 mm%2")
                                        .arg(1e3 * made.scale_m * i / 4.0, 0, 'g', 3)
                                        .arg(i == 4 ? tr(" and more") : QString())});
          legend_model_ = id;
          legend_ = legend;
          sync();
        });
      },
      [this](const QString& text) { compare_->show_error(text); });
}

void ExplorerMode::edit_selected(const QString& what, bool in_place,
                                 const std::function<ModelDataPtr(const ModelData&)>& edit) {
  const Model* selected = store_->find(list_->selected());
  if (!selected || selected->data->kind == ModelKind::kRecording) return;
  jobs().start(
      what, this,
      [this, what, in_place, edit, model = *selected](const RunContext& context) -> Result<Finish> {
        context.begin_phase(what.toStdString(), 0);
        const ModelDataPtr made = edit(*model.data);
        const bool empty =
            made->kind == ModelKind::kMesh ? made->mesh.empty() : made->cloud.empty();
        if (empty)
          return fail(ErrorCode::kTooFewPoints,
                      "{}: nothing would be left of '{}'; delete it "
                      "instead",
                      what.toStdString(), model.name.toStdString());
        return Finish([this, what, in_place, model, made] {
          if (in_place) {
            store_->set_data(model.id, made, what);
            return;
          }
          const int id = store_->add(QString("%1 %2").arg(model.name, what), made);
          store_->set_visible(model.id, false);
          list_->select(id);
        });
      },
      [this](const QString& text) { stages_->show_error(text); });
}

void ExplorerMode::on_selection(int id) {
  const Model* model = store_->find(id);
  const bool recording = model && model->data->kind == ModelKind::kRecording;
  const bool cloud = model && model->data->kind == ModelKind::kCloud;
  stages_->set_target(recording, cloud);
  tools_->set_box(model && !recording ? box_of(*model->data->drawable) : Box());
  if (model) Q_EMIT status(QString("%1: %2").arg(model->name, count_text(*model->data)));
}

}  // namespace turnscan::studio
