// Jobs that the Explorer runs on the worker thread: loading, stages, comparison, edits, saving.

#include <QDir>
#include <QFileInfo>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/evaluation/colormap.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/workflow/page/page_output.hpp>

#include "app/jobs.hpp"
#include "app/paths.hpp"
#include "explorer/compare_panel.hpp"
#include "explorer/comparison.hpp"
#include "explorer/explorer.hpp"
#include "explorer/loading.hpp"
#include "explorer/model_list.hpp"
#include "explorer/scan_quality.hpp"
#include "explorer/session.hpp"
#include "explorer/stage_panel.hpp"
#include "explorer/stage_runs.hpp"
#include "explorer/verdict_panel.hpp"
#include "view/scene_view.hpp"
#include "widgets/section.hpp"

namespace turnscan::studio {

namespace {

Legend distance_legend(const QString& reference, const Comparison& made) {
  constexpr int kSteps = 4;
  Legend legend;
  legend.title = QObject::tr("Distance to %1").arg(reference);
  legend.continuous = true;
  legend.histogram = made.histogram;
  for (int i = 0; i <= kSteps; ++i) {
    legend.entries.push_back({to_color(viridis(double(i) / kSteps)),
                              QString("%1 mm%2")
                                  .arg(1e3 * made.scale_m * i / kSteps, 0, 'g', 3)
                                  .arg(i == kSteps ? QObject::tr(" and more") : QString())});
  }
  return legend;
}

}  // namespace

void ExplorerMode::load(const QString& path, const std::function<void()>& then,
                        std::optional<double> metres_per_unit, Beside beside) {
  stages_->show_error({});
  jobs().start(
      tr("Open %1").arg(QFileInfo(path).fileName()), this,
      [this, path, then, metres_per_unit, beside](const RunContext& context) -> Result<Finish> {
        TURNSCAN_ASSIGN(NamedModels models,
                        load_models(path.toStdString(), context, metres_per_unit));
        return Finish([this, path, then, metres_per_unit, beside, models = std::move(models)] {
          if (const auto doubt = doubtful_unit(path, models); doubt && !metres_per_unit) {
            const auto unit = ask_unit_(*doubt);
            if (!unit) return Q_EMIT status(tr("%1 was not opened").arg(doubt->file));
            if (*unit != doubt->metres_per_unit) return load(path, then, unit, beside);
          }
          for (const auto& model : models) store_->set_file(model.second, path);
          const auto hidden = beside == kAlone ? visible_models() : std::vector<int>();
          const QString what = tr("open %1").arg(QFileInfo(path).fileName());
          if (const auto id = beside == kAlone ? recording_from(path) : std::nullopt) {
            store_->renew(*id, models.back().second, hidden, what);
            list_->select(*id);
          } else {
            list_->select(store_->add_instead(models, hidden, what).back());
          }
          Box box;
          for (const auto& [name, made] : models) {
            if (box_of(*made->drawable).empty()) continue;
            box.add(box_of(*made->drawable).min);
            box.add(box_of(*made->drawable).max);
          }
          if (preview_ == 0) view().bring_into_view(box);
          Q_EMIT file_opened(path);
          if (then) then();
        });
      },
      // If several files are loaded, each bad one is named.
      [this](const QString& text) { stages_->add_error(text); });
}

void ExplorerMode::show_until_mesh(const DrawablePtr& surface) {
  view().remove(preview_);
  ItemStyle style;
  style.visible = surface != nullptr;
  preview_ = surface ? view().add(surface, style) : 0;
  sync();
  if (surface) view().reset_camera();
}

void ExplorerMode::take_recording(const QString& folder, bool reconstruct) {
  // All recordings are on the same table: earlier results would overlap the new object.
  load(
      folder,
      [this, reconstruct] {
        if (reconstruct) run_stage(QString::fromStdString(kMeshStage));
      },
      {}, kAlone);
}

std::optional<int> ExplorerMode::recording_from(const QString& folder) const {
  for (const Model& model : store_->models())
    if (model.data->kind == ModelKind::kRecording &&
        QFileInfo(model.data->source) == QFileInfo(folder))
      return model.id;
  return std::nullopt;
}

std::vector<int> ExplorerMode::visible_models() const {
  std::vector<int> ids;
  for (const Model& model : store_->models())
    if (model.visible) ids.push_back(model.id);
  return ids;
}

/// What a stage of the selected model runs on: the recording that the model was made from, if there
/// is one, because a stage of a stage's points would not be what its name says.
std::optional<Model> ExplorerMode::stage_input() const {
  const Model* selected = store_->find(list_->selected());
  if (!selected) return std::nullopt;
  if (!selected->made) return *selected;
  if (const Model* input = store_->input_of(*selected)) return *input;
  Model removed = *selected;
  removed.data = selected->made->input;
  return removed;
}

void ExplorerMode::run_stage(const QString& stage) {
  const auto input = stage_input();
  const QString problem = stages_->first_error();
  stages_->show_error(problem);
  if (!input || !problem.isEmpty()) return;
  const QString title = stage == QString::fromStdString(kMeshStage)
                            ? tr("Reconstruct %1").arg(input->name)
                            : QString("%1 %2").arg(input->name, stage);
  jobs().start(
      title, this,
      [this, model = *input, stage = stage.toStdString(),
       options = stages_->options()](const RunContext& context) -> Result<Finish> {
        TURNSCAN_ASSIGN(StageRun run, run_stage_of(model, stage, options, context));
        return Finish([this, run = std::move(run)] {
          show_until_mesh(nullptr);
          const auto ids = store_->add_made(run.models, run.made, tr("reconstruct"));
          list_->select(ids.front());
          // Of this scan, whatever was looked at before.
          verdict_section_->set_open(true);
          if (run.made->stage == kMeshStage) reveal(verdict_);
          stages_->show_used(run.choices);
          if (!run.not_joined.isEmpty()) {
            stages_->show_error(
                tr("%1\nAnother side, Join by points shows how it lay.").arg(run.not_joined));
            join_section_->set_open(true);
            reveal(join_section_);
          }
          view().fit_unless_moved();  // a recording also shows the table
        });
      },
      [this](const QString& text) { stages_->show_error(text); },
      stage_phases(*input, stage.toStdString(), stages_->options()),
      // A recording with another pass has other data.
      QString("%1 %2 %3")
          .arg(title, QString::fromStdString(stages_->preset_text()))
          .arg(quintptr(input->data.get())));
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
          const QString name = tr("%1 filtered").arg(model.name);
          list_->select(
              store_->add_instead({{name, kept}}, {model.id}, tr("filter %1").arg(model.name))
                  .front());
        });
      },
      [this](const QString& text) { stages_->show_error(text); });
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
          const QString pair = tr("%1 to %2").arg(a.name, b.name);
          // Alone, because other models may hide it.
          const int id =
              store_->add_instead({{pair, made.colored}}, visible_models(), tr("distances"))
                  .front();
          list_->select(id);
          compare_->show_figures(pair, made.figures);
          reveal(compare_);
          legend_model_ = id;
          legend_ = distance_legend(b.name, made);
          sync();
        });
      },
      [this](const QString& text) { compare_->show_error(text); });
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
        return Finish([this, saved, path] {
          store_->set_file(saved, path);
          Q_EMIT status(tr("Wrote %1").arg(shown_path(path)));
        });
      },
      [this](const QString& text) { stages_->show_error(text); });
}

void ExplorerMode::save_all(const QString& folder) {
  const QStringList unsaved = store_->unsaved();
  for (const Model& model : store_->models()) {
    if (!unsaved.contains(model.name)) continue;
    const QString ending = has_texture(model.data->mesh) ? ".glb" : ".ply";
    const QString name = QDir(folder).filePath(QString(model.name).replace('/', '-'));
    QString path = name + ending;
    for (int i = 2; QFileInfo::exists(path); ++i)
      path = QString("%1-%2%3").arg(name).arg(i).arg(ending);
    save_as(model.id, path);
  }
}

void ExplorerMode::color_selected() {
  const Model* model = store_->find(list_->selected());
  const QString way = verdict_->color_way();
  if (colored_.item != 0) view().remove(colored_.item);
  colored_ = {};
  sync();
  if (!model || !model->data->quality || way.isEmpty()) return;
  jobs().start(
      tr("Colour the mesh"), this,
      [this, data = model->data, way](const RunContext& context) -> Result<Finish> {
        context.begin_phase("prepare the view", 0);
        return Finish([this, data, way, made = color_mesh(*data->quality, way)] {
          if (verdict_->color_way() != way) return;  // another one has been selected meanwhile
          colored_ = {0, data, made.drawable, made.legend};
          draw_colored();
        });
      },
      [this](const QString& text) { stages_->show_error(text); });
}

void ExplorerMode::export_report(int id, const QString& path) {
  const Model* model = store_->find(id);
  if (!model || !model->data->quality) return;
  stages_->show_error({});
  jobs().start(
      tr("Export %1").arg(QFileInfo(path).fileName()), this,
      [this, page = model->data->quality->page, path](const RunContext& context) -> Result<Finish> {
        TURNSCAN_ASSIGN(const ReportPage made, write_page(path.toStdString(), *page, context));
        const QString note =
            made.has_viewer ? QString() : tr("; without the 3D view, which this build lacks");
        return Finish(
            [this, path, note] { Q_EMIT status(tr("Wrote %1%2").arg(shown_path(path), note)); });
      },
      [this](const QString& text) { stages_->show_error(text); });
}

void ExplorerMode::restore_session(const LostSession& lost) {
  stages_->show_error({});
  jobs().start(
      tr("Restore the session"), this,
      [this, lost](const RunContext& context) -> Result<Finish> {
        TURNSCAN_ASSIGN(RestoredModels made, restore(lost, context));
        return Finish([this, lost, made = std::move(made)] {
          for (const auto& [of, file] : made.files) store_->set_file(of, file);
          const std::size_t place = lost.list.place;
          const bool is_fresh = store_->models().empty() && store_->history().isEmpty();
          if (is_fresh) {
            store_->set_states(made.states, place);
            list_->select(lost.list.chosen);
          } else if (!made.states[place].models.empty()) {
            list_->select(
                store_->add_models(made.states[place].models, tr("restore the session")).back());
          }
          if (is_fresh && lost.list.camera) view().set_camera(*lost.list.camera);
          if (made.missing.isEmpty()) {
            session_->take_over(lost);
            return;
          }
          stages_->show_error(tr("These could not be restored, and are kept in %1: %2")
                                  .arg(lost.folder, made.missing.join(", ")));
        });
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

}  // namespace turnscan::studio
