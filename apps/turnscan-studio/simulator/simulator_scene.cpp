// The scene of the Simulator: as a description, as a file, in the settings, and its undo steps.

#include <QLineEdit>
#include <QListWidget>
#include <QSettings>
#include <QTimer>
#include <algorithm>
#include <turnscan/io/file/atomic_file.hpp>

#include "app/jobs.hpp"
#include "app/paths.hpp"
#include "simulator/simulator_parts.hpp"
#include "widgets/option_form.hpp"
#include "widgets/section.hpp"

namespace turnscan::studio {

namespace {

constexpr std::size_t kSceneUndoSteps = 200;

}  // namespace

const SceneDescription& SimulatorMode::scene() {
  scene_->scanners.clear();
  for (const auto& scanner : scanners_)
    scene_->scanners.push_back(scanner->editor->entry(scene_->placement));
  return *scene_;
}

/// Makes the current scene an undo step, if it differs from the last one.
void SimulatorMode::place_changed() {
  if (!scanners_are_valid()) return;
  const std::string now = scene_toml(scene());
  if (step_ < int(steps_.size()) && steps_[std::size_t(step_)] == now) return;
  steps_.resize(std::min(steps_.size(), std::size_t(step_ + 1)));
  steps_.push_back(now);
  if (steps_.size() > kSceneUndoSteps) steps_.erase(steps_.begin());
  step_ = int(steps_.size()) - 1;
  store();
  Q_EMIT undo_changed();
}

void SimulatorMode::go_to_step(int step) {
  if (step < 0 || step >= int(steps_.size())) return;
  step_ = step;
  SceneDescription scene;
  if (parse_scene(steps_[std::size_t(step)], "undo", scene)) apply_scene(std::move(scene));
  Q_EMIT undo_changed();
}

QString SimulatorMode::undo_text() const { return step_ > 0 ? tr("change of the rig") : QString(); }

QString SimulatorMode::redo_text() const {
  return step_ + 1 < int(steps_.size()) ? tr("change of the rig") : QString();
}

/// While a scanner's fields contradict each other, the last that did not are kept.
bool SimulatorMode::scanners_are_valid() const {
  return std::all_of(scanners_.begin(), scanners_.end(),
                     [](const auto& scanner) { return scanner->editor->error().isEmpty(); });
}

void SimulatorMode::store() {
  QSettings settings;
  if (scanners_are_valid())
    settings.setValue("simulator/scene", QString::fromStdString(scene_toml(scene())));
  settings.setValue("simulator/folder", folder_->text());
  for (const auto& [name, form] : forms_)
    if (name == "coverage") form->store("simulator/coverage");
}

void SimulatorMode::restore() {
  const QSettings settings;
  folder_->setText(settings.value("simulator/folder", "~/simulation").toString());
  for (const auto& [name, form] : forms_)
    if (name == "coverage") form->restore("simulator/coverage");
  SceneDescription scene;
  const std::string text = settings.value("simulator/scene").toString().toStdString();
  // Invalid settings come from an older version: they are ignored.
  const bool good =
      !text.empty() && parse_scene(text, "settings", scene) && scene.next_passes.empty();
  if (!good) {
    scene = SceneDescription();
    scene.object = "builtin:doll";
    scene.motion.frames = 60;
  }
  if (scene.scanners.empty()) scene.scanners.push_back({"kinect-v2", {}});
  apply_scene(std::move(scene));
  if (scanners_.empty()) (void)add_entry({"kinect-v2", {}});
}

void SimulatorMode::apply_scene(SceneDescription scene) {
  while (!scanners_.empty()) {
    list_->setCurrentRow(0);
    take_scanner(0);
  }
  const auto scanners = std::move(scene.scanners);
  *scene_ = std::move(scene);
  scene_->scanners.clear();
  for (const auto& [name, form] : forms_) form->refresh();
  for (const ScannerEntry& entry : scanners) add_entry(entry);
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
  for (const auto& scanner : scanners_)
    if (const QString text = scanner->editor->error(); !text.isEmpty())
      return error_->show_text(text);
  jobs().start(
      tr("Save scene"), this,
      [this, path, text = scene_toml(scene())](const RunContext&) -> Result<Finish> {
        TURNSCAN_TRY(write_file_atomically(path.toStdString(), text));
        return Finish([this, path] { Q_EMIT status(tr("Wrote %1").arg(shown_path(path))); });
      },
      [this](const QString& text) { error_->show_text(text); });
}

}  // namespace turnscan::studio
