#pragma once
// A turntable animation of the view, as pictures or as a film.

#include <QObject>
#include <QPointer>
#include <QString>
#include <QTemporaryDir>
#include <QTimer>
#include <memory>

namespace turnscan::studio {

class JobRunner;
class SceneView;

/// Whether ffmpeg is available to make films.
bool can_make_films();

/// Takes a picture at each step while the window stays responsive; finally restores the camera.
class TurntableMovie : public QObject {
  Q_OBJECT
 public:
  /// path: .mp4, or .png for NAME-0001.png and so on. Deletes itself when it has finished.
  TurntableMovie(SceneView& view, JobRunner& jobs, const QString& path, int frames,
                 QObject* parent);

 Q_SIGNALS:
  void progress(const QString& text);
  void failed(const QString& text);
  void done(const QString& path);

 private:
  void step();
  void end_with(const QString& error);
  void make_film();
  QString file_of(int frame) const;

  QPointer<SceneView> view_;
  JobRunner& jobs_;
  QString path_;
  int frames_, taken_ = 0;
  bool film_;
  std::shared_ptr<QTemporaryDir> folder_;
  QTimer timer_;
};

}  // namespace turnscan::studio
