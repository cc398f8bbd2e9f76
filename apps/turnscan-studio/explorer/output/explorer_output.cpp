// Output of the Explorer: exports, and the queue of recordings.

#include <QDir>
#include <QFileInfo>
#include <turnscan/core/mesh_texture.hpp>

#include "app/jobs.hpp"
#include "app/paths.hpp"
#include "explorer/explorer.hpp"
#include "explorer/looking/movie.hpp"
#include "explorer/looking/voxel_panel.hpp"
#include "explorer/model_list.hpp"
#include "explorer/output/export_dialog.hpp"
#include "explorer/output/stage_sheet.hpp"
#include "explorer/scan_quality.hpp"
#include "explorer/stage_panel.hpp"
#include "explorer/stage_runs.hpp"

namespace turnscan::studio {

namespace {

QString title_of_recording(const QString& path) {
  const QFileInfo info(path);
  return info.isDir() ? info.fileName() : info.completeBaseName();
}

/// "24 686 triangles, GREEN"
QString outcome_text(const StageRun& run) {
  QStringList parts;
  for (const auto& [name, data] : run.models) {
    QString text = count_text(*data);
    if (data->quality) {
      const std::string_view colour = data->quality->verdict.colour();
      text += ", " + QString::fromUtf8(colour.data(), int(colour.size()));
    }
    parts << text;
  }
  if (!run.not_joined.isEmpty()) parts << run.not_joined;
  return parts.join("; ");
}

/// Writes the meshes of a run: NAME.ply, NAME-2.ply, ...; .glb for a texture.
Result<QStringList> write_run(const StageRun& run, const QString& folder, const QString& name) {
  if (!QDir().mkpath(folder))
    return fail_at(folder.toStdString(), ErrorCode::kIo, "the folder cannot be made");
  QStringList files;
  for (const auto& [title, data] : run.models) {
    const QString number = files.isEmpty() ? QString() : QString("-%1").arg(files.size() + 1);
    const QString file =
        QDir(folder).filePath(name + number + (has_texture(data->mesh) ? ".glb" : ".ply"));
    TURNSCAN_TRY(save_model(*data, file.toStdString()));
    files << file;
  }
  return files;
}

}  // namespace

void ExplorerMode::export_dialog() {
  const Model* model = store_->find(list_->selected());
  if (!model || model->data->kind == ModelKind::kRecording) {
    stages_->show_error(tr("Select a mesh or a cloud to export"));
    return;
  }
  stages_->show_error({});
  ExportDialog dialog(*model->data, model->name, this);
  if (dialog.exec() != QDialog::Accepted) return;
  const QString ending = dialog.ending();
  QString path = ask_save_path(this, tr("Export %1").arg(model->name), model->name + ending,
                               QString("*%1").arg(ending));
  if (path.isEmpty()) return;
  if (!path.endsWith(ending, Qt::CaseInsensitive)) path += ending;
  export_as(model->id, path, dialog.options());
}

void ExplorerMode::export_as(int id, const QString& path, const ExportOptions& options) {
  const Model* model = store_->find(id);
  if (!model) return;
  stages_->show_error({});
  jobs().start(
      tr("Export %1").arg(QFileInfo(path).fileName()), this,
      [this, data = model->data, path, options](const RunContext& context) -> Result<Finish> {
        TURNSCAN_TRY(export_model(*data, options, path.toStdString(), context));
        return Finish([this, path] { Q_EMIT status(tr("Wrote %1").arg(shown_path(path))); });
      },
      [this](const QString& text) { stages_->show_error(text); });
}

void ExplorerMode::movie_dialog() {
  const QString pictures = tr("Pictures, NAME-0001.png and so on (*.png)");
  const bool film = can_make_films();
  const QString path =
      ask_save_path(this, tr("Turntable movie"), film ? "turntable.mp4" : "turntable.png",
                    film ? tr("Film (*.mp4)") + ";;" + pictures : pictures);
  if (path.isEmpty()) return;
  constexpr int kFrames = 120;  // five seconds
  make_movie(path, kFrames);
}

void ExplorerMode::show_stages() {
  stages_->show_error({});
  // All that was made from one recording, of which the list shows one at a time; else what it
  // shows.
  const auto input = stage_input();
  std::vector<ShownStage> stages, visible;
  for (const Model& model : store_->models()) {
    const ShownStage shown{model, voxels_->least_of(model)};
    const Model* from = store_->input_of(model);
    if (input && from && from->id == input->id) stages.push_back(shown);
    if (model.visible) visible.push_back(shown);
  }
  jobs().start(
      tr("Stages"), this,
      [this,
       shown = stages.empty() ? visible : stages](const RunContext& context) -> Result<Finish> {
        TURNSCAN_ASSIGN(const QImage sheet, stage_sheet(shown, context));
        return Finish([this, sheet] {
          auto* dialog = new SheetDialog(sheet, this);
          connect(dialog, &SheetDialog::failed, stages_, &StagePanel::show_error);
          connect(dialog, &SheetDialog::saved, this, [this](const QString& file) {
            Q_EMIT status(tr("Wrote %1").arg(shown_path(file)));
          });
          dialog->show();
        });
      },
      [this](const QString& text) { stages_->show_error(text); });
}

void ExplorerMode::make_movie(const QString& path, int frames) {
  stages_->show_error({});
  auto* movie = new TurntableMovie(view(), jobs(), path, frames, this);
  connect(movie, &TurntableMovie::progress, this, &Mode::described);
  connect(movie, &TurntableMovie::failed, stages_, &StagePanel::show_error);
  connect(movie, &TurntableMovie::done, this,
          [this](const QString& file) { Q_EMIT status(tr("Wrote %1").arg(shown_path(file))); });
}

QString ExplorerMode::queue_title(const QString& recording) {
  return tr("Reconstruct %1").arg(title_of_recording(recording));
}

void ExplorerMode::reconstruct_queued(
    const QString& recording, const QString& folder,
    const std::function<void(bool good, const QString& text)>& done) {
  const QString problem = stages_->first_error();
  if (!problem.isEmpty()) {
    done(false, problem);
    return;
  }
  jobs().start(
      queue_title(recording), this,
      [this, recording, folder, done,
       options = stages_->options()](const RunContext& context) -> Result<Finish> {
        Model model;
        model.name = title_of_recording(recording);
        TURNSCAN_ASSIGN(model.data, recording_model(recording.toStdString(), context));
        TURNSCAN_ASSIGN(StageRun run, run_stage_of(model, kMeshStage, options, context));
        QStringList files;
        if (!folder.isEmpty()) {
          TURNSCAN_ASSIGN(files, write_run(run, folder, model.name));
        }
        return Finish([this, done, run = std::move(run), files, name = model.name] {
          for (int i = 0; i < files.size(); ++i)
            store_->set_file(run.models[std::size_t(i)].second, files[i]);
          const auto ids = store_->add_made(run.models, run.made, tr("reconstruct %1").arg(name));
          // All are in the same place: only the last one is shown.
          for (const int id : queued_results_) store_->set_visible(id, false);
          queued_results_.insert(queued_results_.end(), ids.begin(), ids.end());
          list_->select(ids.front());
          done(true, outcome_text(run));
        });
      },
      [done](const QString& text) { done(false, text); });
}

}  // namespace turnscan::studio
