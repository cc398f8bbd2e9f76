#include "explorer/looking/movie.hpp"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QProcess>
#include <QStandardPaths>
#include <numbers>

#include "app/jobs.hpp"
#include "view/scene_view.hpp"

namespace turnscan::studio {

namespace {

constexpr int kFramesPerSecond = 24;
constexpr int kLongest_ms = 600000;

/// Runs ffmpeg into a file beside the film, which takes its place when it is whole.
Result<> run_ffmpeg(const QString& pictures, const QString& film, const RunContext& context) {
  const QFileInfo info(film);
  const QString part = info.dir().filePath(".part-" + info.completeBaseName() + ".mp4");
  QProcess ffmpeg;
  ffmpeg.setProcessChannelMode(QProcess::MergedChannels);
  // Players want even sides, and this layout of colours.
  ffmpeg.start(
      "ffmpeg",
      {"-nostdin", "-loglevel", "error", "-y", "-framerate", QString::number(kFramesPerSecond),
       "-i", QDir(pictures).filePath("%04d.png"), "-vf", "crop=trunc(iw/2)*2:trunc(ih/2)*2",
       "-pix_fmt", "yuv420p", "-movflags", "+faststart", part});
  for (int waited = 0; !ffmpeg.waitForFinished(100) && waited < kLongest_ms; waited += 100) {
    if (!context.cancelled() && ffmpeg.state() != QProcess::NotRunning) continue;
    ffmpeg.kill();
    ffmpeg.waitForFinished();
    break;
  }
  const bool good = ffmpeg.exitStatus() == QProcess::NormalExit && ffmpeg.exitCode() == 0 &&
                    QFileInfo(part).size() > 0;
  if (good && !context.cancelled()) {
    QFile::remove(film);
    if (QFile::rename(part, film)) return {};
  }
  QFile::remove(part);
  TURNSCAN_TRY(context.check());
  return fail_at(film.toStdString(), ErrorCode::kIo, "ffmpeg made no film: {}",
                 QString::fromLocal8Bit(ffmpeg.readAll()).trimmed().toStdString());
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
  constexpr int kQuick = 80;  // of 100: larger files, sooner
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
        TURNSCAN_TRY(run_ffmpeg(folder->path(), path, context));
        return Finish([this, path] {
          Q_EMIT done(path);
          deleteLater();
        });
      },
      [this](const QString& text) { end_with(text); });
}

}  // namespace turnscan::studio
