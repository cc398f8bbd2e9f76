#include "explorer/session.hpp"

#include <QCoreApplication>
#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QStandardPaths>
#include <algorithm>
#include <tuple>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/file/folder.hpp>

#include "explorer/editing/edits.hpp"

namespace turnscan::studio {

namespace {

constexpr int kPause_ms = 300;         // changes within it are written together
constexpr int kPauseOfLook_ms = 1500;  // the same, for changes of the camera
QString lock_of(const QString& folder) { return folder + ".lock"; }

void remove_folder(const QString& folder) {
  const QFileInfo info(folder);
  if (const auto root = file::Folder::open(info.path().toStdString()))
    (void)root->remove(info.fileName().toStdString());
  QFile::remove(lock_of(folder));  // of a killed process
}

}  // namespace

SessionKeeper::SessionKeeper(ModelStore& store, const QString& root, QObject* parent)
    : QObject(parent),
      store_(store),
      folder_(QDir(root).filePath(QString("%1-%2")
                                      .arg(QDateTime::currentMSecsSinceEpoch())
                                      .arg(QCoreApplication::applicationPid()))) {
  writer_.setMaxThreadCount(1);
  timer_.setSingleShot(true);
  connect(&timer_, &QTimer::timeout, this, &SessionKeeper::write);
  connect(&store_, &ModelStore::changed, this, [this] { timer_.start(kPause_ms); });
}

SessionKeeper::~SessionKeeper() {
  writer_.clear();
  writer_.waitForDone();
  if (stays_) return;
  if (lock_) remove_folder(folder_);
  // A session that was restored, if nothing has been written since.
  for (const QString& lost : taken_over_) remove_folder(lost);
}

bool SessionKeeper::set_stays(bool stays) {
  stays_ = stays;
  if (!stays) return true;
  failed_ = false;
  flush();
  return !failed_;
}

QString SessionKeeper::default_root() {
  return QDir(QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation))
      .filePath("sessions");
}

std::optional<LostSession> SessionKeeper::find_lost(const QString& root) {
  const QStringList folders = QDir(root).entryList(
      QDir::Dirs | QDir::NoSymLinks | QDir::NoDotAndDotDot, QDir::Name | QDir::Reversed);
  for (const QString& name : folders) {
    LostSession lost{QDir(root).filePath(name), {}};
    QLockFile lock(lock_of(lost.folder));
    lock.setStaleLockTime(0);
    if (!lock.tryLock(0)) continue;  // belongs to a running process
    lock.unlock();
    lost.list = read_list(lost.folder);
    if (!lost.list.states.empty() && !lost.models().empty()) return lost;
    remove_folder(lost.folder);
  }
  return std::nullopt;
}

void SessionKeeper::discard(const LostSession& lost) { remove_folder(lost.folder); }

void SessionKeeper::take_over(const LostSession& lost) {
  taken_over_ << lost.folder;
  timer_.start(kPause_ms);
}

void SessionKeeper::flush() {
  timer_.stop();
  write();
  writer_.waitForDone();
  QCoreApplication::sendPostedEvents(this);
}

void SessionKeeper::report(const QString& text) {
  if (failed_) return;
  failed_ = true;
  Q_EMIT failed(text);
}

void SessionKeeper::look_changed() {
  if (lock_ && !timer_.isActive()) timer_.start(kPauseOfLook_ms);
}

/// Locked before it exists, so that no other instance takes it for a lost one.
bool SessionKeeper::take_folder() {
  if (lock_) return true;
  QDir().mkpath(QFileInfo(folder_).path());
  auto lock = std::make_unique<QLockFile>(lock_of(folder_));
  lock->setStaleLockTime(0);
  if (!lock->tryLock(0) || !QDir().mkpath(folder_)) {
    report(tr("The session is not saved: %1 cannot be made").arg(folder_));
    return false;
  }
  lock_ = std::move(lock);
  return true;
}

KeptModel SessionKeeper::keep(const Model& model, Kept& kept, Files& files) {
  const ModelDataPtr& data = model.data;
  KeptModel entry{model.id,
                  model.name,
                  store_.file_of(*data),
                  true,
                  0,
                  model.visible,
                  model.own_colors,
                  model.color,
                  model.opacity,
                  data->metres_per_unit,
                  {},
                  model.own};
  if (!entry.file.isEmpty()) {
    entry.file = QFileInfo(entry.file).absoluteFilePath();
    return entry;
  }
  entry.in_own_file = false;
  for (const Kept* of : {&kept, &kept_})
    for (const auto& [file, known] : *of)
      if (entry.file.isEmpty() && known.lock() == data) entry.file = file;
  if (entry.file.isEmpty()) {
    // PLY keeps the confidence of vertices, but no texture.
    entry.file = QString("%1.%2").arg(next_file_++).arg(has_texture(data->mesh) ? "glb" : "ply");
    files.emplace_back(entry.file, data);
  }
  kept.emplace(entry.file, data);
  return entry;
}

void SessionKeeper::write() {
  const std::vector<ModelState> states = store_.states();
  if (!lock_ && states.size() == 1 && states[0].models.empty()) return;
  if (!take_folder()) return;
  KeptList list;
  Files files;
  Kept kept;
  std::map<QString, std::vector<const ModelData*>> in_file;
  for (const ModelState& state : states) {
    KeptState& entry = list.states.emplace_back();
    entry.what = state.what;
    for (const Model& model : state.models) {
      KeptModel made = keep(model, kept, files);
      if (const Model* input = input_of(model, state.models))
        made.made = {input->id, model.made->stage, model.made->changed, model.made->chosen};
      // The models of a file are in its order, all added in one step.
      auto& order = in_file[made.file];
      const auto at = std::find(order.begin(), order.end(), model.data.get());
      made.place_in_file = int(at - order.begin());
      if (at == order.end()) order.push_back(model.data.get());
      if (state.selected.drawable && model.data == state.selected.of)
        entry.selected_model = int(entry.models.size());
      entry.models.push_back(std::move(made));
    }
    if (entry.selected_model >= 0) entry.selected = *state.selected.parts;
  }
  list.place = store_.place_in_history();
  if (look_) std::tie(list.camera, list.chosen) = look_();
  QStringList unused;
  for (const auto& [file, data] : kept_)
    if (kept.count(file) == 0) unused << QDir(folder_).filePath(file);
  kept_ = std::move(kept);
  writer_.start([this, folder = folder_, files = std::move(files), list = std::move(list), unused,
                 replaced = std::exchange(taken_over_, {})] {
    const auto write_all = [&]() -> Result<> {
      for (const auto& [file, data] : files)
        TURNSCAN_TRY(save_model(*data, QDir(folder).filePath(file).toStdString()));
      return write_file_atomically(QDir(folder).filePath(kSessionList).toStdString(),
                                   list_text(list).toStdString());
    };
    if (const auto written = write_all(); !written) {
      const QString reason = QString::fromStdString(written.error().text());
      QMetaObject::invokeMethod(
          this,
          [this, reason, replaced] {
            kept_.clear();  // everything not written is retried with the next change
            taken_over_ << replaced;
            report(tr("The session is not saved: %1").arg(reason));
          },
          Qt::QueuedConnection);
      return;
    }
    for (const QString& file : unused) QFile::remove(file);
    for (const QString& lost : replaced) remove_folder(lost);
  });
}

namespace {

/// Reads the models of files, each file once.
class FileReader {
 public:
  explicit FileReader(const RunContext& context) : context_(context) {}

  /// nullptr: it cannot be read. Fails with kCancelled.
  Result<ModelDataPtr> read(const KeptModel& entry) {
    TURNSCAN_TRY(context_.check());
    auto known = opened_.find(entry.file);
    if (known == opened_.end()) {
      auto models = load_models(entry.file.toStdString(), context_, entry.metres_per_unit);
      if (!models && models.error().code == ErrorCode::kCancelled)
        return tl::unexpected<Error>(models.error());
      known = opened_.emplace(entry.file, models ? std::move(*models) : NamedModels()).first;
    }
    const NamedModels& models = known->second;
    if (models.empty()) return nullptr;
    // It may have been opened several times.
    return models[std::size_t(entry.place_in_file) % models.size()].second;
  }

 private:
  const RunContext& context_;
  std::map<QString, NamedModels> opened_;
};

}  // namespace

namespace {

/// What made each model of a state, where that is among them.
void restore_origins(const KeptState& state, std::vector<Model>& models) {
  const auto of = [&](int id) {
    return std::find_if(models.begin(), models.end(), [&](const Model& m) { return m.id == id; });
  };
  for (const KeptModel& entry : state.models) {
    const auto model = of(entry.id), input = of(entry.made.input);
    if (model == models.end() || input == models.end() || model == input) continue;
    model->made = std::make_shared<MadeWith>(
        MadeWith{input->data, entry.made.stage, entry.made.changed, entry.made.chosen});
  }
}

}  // namespace

Result<RestoredModels> restore(const LostSession& lost, const RunContext& context) {
  RestoredModels out;
  FileReader files(context);
  for (const KeptState& state : lost.list.states) {
    ModelState& made = out.states.emplace_back();
    made.what = state.what;
    for (std::size_t i = 0; i < state.models.size(); ++i) {
      const KeptModel& entry = state.models[i];
      TURNSCAN_ASSIGN(const ModelDataPtr data, files.read(entry));
      if (!data) {
        if (&state == &lost.list.states[lost.list.place]) out.missing << entry.name;
        continue;
      }
      if (entry.in_own_file) out.files[data] = entry.file;
      made.models.push_back({entry.id, entry.name, data, nullptr, entry.own, entry.visible,
                             entry.color, entry.own_colors, entry.opacity});
      if (state.selected_model != int(i) || state.selected.size() != parts_of(*data)) continue;
      made.selected = {data, std::make_shared<const Selection>(state.selected),
                       selection_drawable(*data, state.selected)};
    }
    restore_origins(state, made.models);
  }
  return out;
}

}  // namespace turnscan::studio
