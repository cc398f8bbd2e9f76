#pragma once
// The models of a session, kept on disk while it runs: a crash or a kill loses none of them.

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

/// What a session that did not end well has left.
struct LostSession {
  QString folder;
  KeptList list;

  /// As they were at its end.
  const std::vector<KeptModel>& models() const { return list.states[list.place].models; }
};

/// Writes the models that are in no file, each once, and the list of all states that undo and redo
/// lead to, into a folder of its own below a root, a moment after they change; the folder is
/// removed at a good end.
class SessionKeeper : public QObject {
  Q_OBJECT
 public:
  /// The store must outlive it.
  SessionKeeper(ModelStore& store, const QString& root, QObject* parent = nullptr);
  ~SessionKeeper() override;

  /// Where this person's sessions are.
  static QString default_root();
  /// The newest that no living process keeps and that has models. What is empty is removed.
  static std::optional<LostSession> find_lost(const QString& root);
  static void discard(const LostSession& lost);

  /// Where the camera is, and which model is chosen, asked for with each writing. They change more
  /// often than models, and are written with the next change, or a moment after look_changed().
  using Look = std::function<std::pair<CameraPlace, int>()>;
  void set_look(Look look) { look_ = std::move(look); }
  void look_changed();

  /// Removes the lost session once its models are kept as those of this one.
  void take_over(const LostSession& lost);
  /// Writes now what is to be written, and waits for it.
  void flush();

 Q_SIGNALS:
  /// The session cannot be kept, with the reason: once.
  void failed(const QString& text);

 private:
  void write();
  /// The file of a model's data, made known to `kept` and, if it is yet to be written, `files`.
  using Files = std::vector<std::pair<QString, ModelDataPtr>>;
  using Kept = std::map<QString, std::weak_ptr<const ModelData>>;
  KeptModel keep(const Model& model, Kept& kept, Files& files);
  bool take_folder();
  void report(const QString& text);

  ModelStore& store_;
  QString folder_;
  std::unique_ptr<QLockFile> lock_;
  QTimer timer_;
  QThreadPool writer_;  ///< one thread, so that the list is written after its files
  Look look_;
  Kept kept_;               ///< by file
  QStringList taken_over_;  ///< folders
  int next_file_ = 1;
  bool failed_ = false;
};

/// The models of a lost session, in all of its states.
struct RestoredModels {
  std::vector<ModelState> states;
  std::map<ModelDataPtr, QString> files;  ///< those of the person's
  QStringList missing;                    ///< names of those that cannot be read, of its last state
};
/// Fails with kCancelled.
Result<RestoredModels> restore(const LostSession& lost, const RunContext& context);

}  // namespace turnscan::studio
