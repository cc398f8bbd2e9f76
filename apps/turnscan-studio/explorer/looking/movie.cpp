#include "explorer/looking/movie.hpp"

#include <QDir>
#include <QFileInfo>
#include <QStandardPaths>
#include <numbers>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/workflow/turning_picture.hpp>

#include "app/jobs.hpp"
#include "view/scene_view.hpp"

namespace turnscan::studio {

namespace {

constexpr double kFramesPerSecond = 24.0;

Result<> write_film(const QString& pictures, const QString& film, const RunContext& context) {
  std::vector<std::string> all;
  const QDir folder(pictures);
  for (const QString& name : folder.entryList({"*.png"}, QDir::Files, QDir::Name)) {
    TURNSCAN_ASSIGN(std::string bytes, read_file(folder.filePath(name).toStdString()));
    all.push_back(std::move(bytes));
  }
  return write_video(film.toStdString(), all, double(all.size()) / kFramesPerSecond, context);
}

}  // namespace

bool can_make_films() { return !QStandardPaths::findExecutable("ffmpeg").isEmpty(); }

TurntableMovie::TurntableMovie(SceneView& view, JobRunner& jobs, const QString& path, int frames,
                               QObject* parent)
    : QObject(parent),
      view_(&view),
      jobs_(jobs),
      path_(path),
      frames_(frames),
      film_(QFileInfo(path).suffix().toLower() == "mp4"),
      folder_(std::make_shared<QTemporaryDir>()) {
  connect(&timer_, &QTimer::timeout, this, &TurntableMovie::step);
  timer_.start(0);
}

QString TurntableMovie::file_of(int frame) const {
  const QString number = QString("%1").arg(frame, 4, 10, QChar('0'));
  const QFileInfo info(path_);
  return film_ ? folder_->filePath(number + ".png")
               : info.dir().filePath(QString("%1-%2.png").arg(info.completeBaseName(), number));
}

void TurntableMovie::step() {
  if (!view_) return end_with(tr("The view was closed"));
  view_->turn(2.0 * std::numbers::pi / frames_);
  const QString file = file_of(++taken_);
  constexpr int kQuick = 80;  // of 100: larger files, but faster
  if (!view_->screenshot().save(file, "PNG", kQuick))
    return end_with(tr("%1 cannot be written").arg(file));
  Q_EMIT progress(tr("Picture %1 of %2").arg(taken_).arg(frames_));
  if (taken_ < frames_) return;
  timer_.stop();
  if (film_) return make_film();
  Q_EMIT done(file_of(1));
  deleteLater();
}

void TurntableMovie::end_with(const QString& error) {
  timer_.stop();
  Q_EMIT failed(error);
  deleteLater();
}

void TurntableMovie::make_film() {
  const QString title = tr("Make the film");
  connect(&jobs_, &JobRunner::cancelled, this, [this, title](const QString& job) {
    if (job == title) deleteLater();
  });
  jobs_.start(
      title, this,
      [this, folder = folder_, path = path_](const RunContext& context) -> Result<Finish> {
        context.begin_phase("film", 0);
        TURNSCAN_TRY(write_film(folder->path(), path, context));
        return Finish([this, path] {
          Q_EMIT done(path);
          deleteLater();
        });
      },
      [this](const QString& text) { end_with(text); });
}

}  // namespace turnscan::studio
