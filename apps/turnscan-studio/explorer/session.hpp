#pragma once
// Keeps the models of a running session on disk, so that a crash or a kill does not lose them.

#include <QLockFile>
#include <QObject>
#include <QThreadPool>
#include <QTimer>
#include <functional>
#include <map>
#include <optional>

#include "explorer/loading.hpp"
#include "explorer/models.hpp"
#include "explorer/session_list.hpp"

namespace turnscan::studio {

/// What remains of a session that did not end properly.
struct LostSession {
  QString folder;
  KeptList list;

  /// The models at its end.
  const std::vector<KeptModel>& models() const { return list.states[list.place].models; }
};

/// Writes each model that is not in a file once, and the list of all undo and redo states, into a
/// separate folder below a root, shortly after they change; the folder is removed when the session
/// ends, unless set_stays().
class SessionKeeper : public QObject {
  Q_OBJECT
 public:
  /// The store must outlive it.
  SessionKeeper(ModelStore& store, const QString& root, QObject* parent = nullptr);
  ~SessionKeeper() override;

  /// Root folder of this user's sessions.
  static QString default_root();
  /// The newest session that has models and does not belong to a running process. Removes empty
  /// ones.
  static std::optional<LostSession> find_lost(const QString& root);
  static void discard(const LostSession& lost);

  /// Provides the camera and the id of the selected model with each write. They change more often
  /// than models, and are written with the next change, or shortly after look_changed().
  using Look = std::function<std::pair<CameraPlace, int>()>;
  void set_look(Look look) { look_ = std::move(look); }
  void look_changed();

  /// Removes the lost session once its models are stored as part of this one.
  void take_over(const LostSession& lost);
  /// Writes pending changes now, and waits for that.
  void flush();
  /// Whether the session stays when it ends, as after a crash. False: it should, and cannot be
  /// written.
  bool set_stays(bool stays);

 Q_SIGNALS:
  /// The session cannot be stored, with the reason; emitted once.
  void failed(const QString& text);

 private:
  void write();
  /// The file of a model's data, added to `kept` and, if it is not yet written, to `files`.
  using Files = std::vector<std::pair<QString, ModelDataPtr>>;
  using Kept = std::map<QString, std::weak_ptr<const ModelData>>;
  KeptModel keep(const Model& model, Kept& kept, Files& files);
  bool take_folder();
  void report(const QString& text);

  ModelStore& store_;
  QString folder_;
  std::unique_ptr<QLockFile> lock_;
  QTimer timer_;
  QThreadPool writer_;  ///< a single thread, so that the list is written after its files
  Look look_;
  Kept kept_;               ///< by file
  QStringList taken_over_;  ///< folders
  int next_file_ = 1;
  bool failed_ = false, stays_ = false;
};

/// The models of a lost session, in all of its states.
struct RestoredModels {
  std::vector<ModelState> states;
  std::map<ModelDataPtr, QString> files;  ///< files of the user
  QStringList missing;  ///< names of the models of its last state that cannot be read
};
/// Fails with kCancelled.
Result<RestoredModels> restore(const LostSession& lost, const RunContext& context);

}  // namespace turnscan::studio
