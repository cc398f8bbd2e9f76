#include "explorer/session.hpp"

#include <QCoreApplication>
#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QStandardPaths>
#include <algorithm>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/io/file/atomic_file.hpp>

namespace turnscan::studio {

namespace {

constexpr int kPause_ms = 300;  // in which changes gather
constexpr const char* kList = "session.json";

QString lock_of(const QString& folder) { return folder + ".lock"; }

QByteArray list_text(const std::vector<KeptModel>& models) {
  QJsonArray list;
  for (const KeptModel& model : models) {
    QJsonObject entry{{"name", model.name},
                      {"file", model.file},
                      {"in_own_file", model.in_own_file},
                      {"visible", model.visible},
                      {"own_colors", model.own_colors},
                      {"color", model.color.name()},
                      {"opacity", model.opacity}};
    if (model.metres_per_unit) entry["metres_per_unit"] = *model.metres_per_unit;
    list.append(entry);
  }
  return QJsonDocument(QJsonObject{{"models", list}}).toJson();
}

/// Empty where the list is damaged or missing.
std::vector<KeptModel> read_list(const QString& folder) {
  QFile file(QDir(folder).filePath(kList));
  std::vector<KeptModel> out;
  if (!file.open(QIODevice::ReadOnly)) return out;
  for (const QJsonValue& value :
       QJsonDocument::fromJson(file.readAll()).object().value("models").toArray()) {
    const QJsonObject entry = value.toObject();
    KeptModel model;
    model.name = entry.value("name").toString();
    model.file = entry.value("file").toString();
    model.in_own_file = entry.value("in_own_file").toBool();
    // The session's own files lie in its folder.
    if (!model.in_own_file) model.file = QDir(folder).filePath(QFileInfo(model.file).fileName());
    model.visible = entry.value("visible").toBool(true);
    model.own_colors = entry.value("own_colors").toBool(true);
    model.color = QColor(entry.value("color").toString());
    model.opacity = std::clamp(entry.value("opacity").toDouble(1.0), 0.0, 1.0);
    if (const double unit = entry.value("metres_per_unit").toDouble(); unit > 0.0)
      model.metres_per_unit = unit;
    out.push_back(model);
  }
  return out;
}

void remove_folder(const QString& folder) {
  QDir(folder).removeRecursively();
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
  timer_.setInterval(kPause_ms);
  connect(&timer_, &QTimer::timeout, this, &SessionKeeper::write);
  connect(&store_, &ModelStore::changed, &timer_, QOverload<>::of(&QTimer::start));
}

SessionKeeper::~SessionKeeper() {
  writer_.clear();
  writer_.waitForDone();
  if (lock_) QDir(folder_).removeRecursively();
}

QString SessionKeeper::default_root() {
  return QDir(QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation))
      .filePath("sessions");
}

std::optional<LostSession> SessionKeeper::find_lost(const QString& root) {
  const QStringList folders =
      QDir(root).entryList(QDir::Dirs | QDir::NoDotAndDotDot, QDir::Name | QDir::Reversed);
  for (const QString& name : folders) {
    LostSession lost{QDir(root).filePath(name), {}};
    QLockFile lock(lock_of(lost.folder));
    lock.setStaleLockTime(0);
    if (!lock.tryLock(0)) continue;  // of a process that lives
    lock.unlock();
    lost.models = read_list(lost.folder);
    if (!lost.models.empty()) return lost;
    remove_folder(lost.folder);
  }
  return std::nullopt;
}

void SessionKeeper::discard(const LostSession& lost) { remove_folder(lost.folder); }

void SessionKeeper::take_over(const LostSession& lost) {
  taken_over_ << lost.folder;
  timer_.start();
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

void SessionKeeper::write() {
  if (!lock_) {
    if (store_.models().empty()) return;
    // Locked before it is there: no other start takes it for a lost one.
    QDir().mkpath(QFileInfo(folder_).path());
    auto lock = std::make_unique<QLockFile>(lock_of(folder_));
    lock->setStaleLockTime(0);
    if (!lock->tryLock(0) || !QDir().mkpath(folder_)) {
      report(tr("The session is not kept: %1 cannot be made").arg(folder_));
      return;
    }
    lock_ = std::move(lock);
  }
  std::vector<KeptModel> list;
  std::vector<std::pair<QString, ModelDataPtr>> files;
  std::map<QString, std::weak_ptr<const ModelData>> kept;
  for (const Model& model : store_.models()) {
    KeptModel entry{model.name,
                    store_.file_of(*model.data),
                    true,
                    model.visible,
                    model.own_colors,
                    model.color,
                    model.opacity,
                    model.data->metres_per_unit};
    if (entry.file.isEmpty()) {
      entry.in_own_file = false;
      for (const auto& [file, data] : kept_)
        if (data.lock() == model.data) entry.file = file;
      if (entry.file.isEmpty()) {
        // PLY keeps the confidence of vertices, but no texture.
        entry.file =
            QString("%1.%2").arg(next_file_++).arg(has_texture(model.data->mesh) ? "glb" : "ply");
        files.emplace_back(entry.file, model.data);
      }
      kept.emplace(entry.file, model.data);
    } else {
      entry.file = QFileInfo(entry.file).absoluteFilePath();
    }
    list.push_back(std::move(entry));
  }
  QStringList unused;
  for (const auto& [file, data] : kept_)
    if (kept.count(file) == 0) unused << QDir(folder_).filePath(file);
  kept_ = std::move(kept);
  writer_.start([this, folder = folder_, files = std::move(files), text = list_text(list), unused,
                 replaced = std::exchange(taken_over_, {})] {
    const auto write_all = [&]() -> Result<> {
      for (const auto& [file, data] : files)
        TURNSCAN_TRY(save_model(*data, QDir(folder).filePath(file).toStdString()));
      return write_file_atomically(QDir(folder).filePath(kList).toStdString(), text.toStdString());
    };
    if (const auto written = write_all(); !written) {
      const QString reason = QString::fromStdString(written.error().text());
      QMetaObject::invokeMethod(
          this,
          [this, reason, replaced] {
            kept_.clear();  // whatever was not written is tried again with the next change
            taken_over_ << replaced;
            report(tr("The session is not kept: %1").arg(reason));
          },
          Qt::QueuedConnection);
      return;
    }
    for (const QString& file : unused) QFile::remove(file);
    for (const QString& lost : replaced) remove_folder(lost);
  });
}

Result<RestoredModels> restore(const LostSession& lost, const RunContext& context) {
  RestoredModels out;
  std::map<QString, NamedModels> opened;  // a file may hold several models
  std::map<QString, std::size_t> used;
  for (const KeptModel& entry : lost.models) {
    TURNSCAN_TRY(context.check());
    if (opened.count(entry.file) == 0) {
      auto models = load_models(entry.file.toStdString(), context, entry.metres_per_unit);
      if (!models && models.error().code == ErrorCode::kCancelled)
        return tl::unexpected<Error>(models.error());
      opened[entry.file] = models ? std::move(*models) : NamedModels();
    }
    const NamedModels& models = opened[entry.file];
    const std::size_t next = used[entry.file]++;
    if (next >= models.size()) {
      out.missing << entry.name;
      continue;
    }
    out.models.push_back({0, entry.name, models[next].second, entry.visible, entry.color,
                          entry.own_colors, entry.opacity});
    out.files << (entry.in_own_file ? entry.file : QString());
  }
  return out;
}

}  // namespace turnscan::studio
