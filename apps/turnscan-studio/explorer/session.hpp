#pragma once
// The models of a session, kept on disk while it runs: a crash or a kill loses none of them.

#include <QLockFile>
#include <QObject>
#include <QThreadPool>
#include <QTimer>
#include <map>
#include <optional>

#include "explorer/loading.hpp"
#include "explorer/models.hpp"

namespace turnscan::studio {

/// A model as a session keeps it.
struct KeptModel {
  QString name, file;
  bool in_own_file = false;  ///< a file of the person's; else one of the session's
  bool visible = true, own_colors = true;
  QColor color;
  double opacity = 1.0;
  std::optional<double> metres_per_unit = std::nullopt;  ///< of its own file, if it was told
};

/// What a session that did not end well has left.
struct LostSession {
  QString folder;
  std::vector<KeptModel> models;
};

/// Writes the models that are in no file, each once, and the list of all, into a folder of its own
/// below a root, a moment after they change; the folder is removed at a good end.
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

  /// Removes the lost session once its models are kept as those of this one.
  void take_over(const LostSession& lost);
  /// Writes now what is to be written, and waits for it.
  void flush();

 Q_SIGNALS:
  /// The session cannot be kept, with the reason: once.
  void failed(const QString& text);

 private:
  void write();
  void report(const QString& text);

  ModelStore& store_;
  QString folder_;
  std::unique_ptr<QLockFile> lock_;
  QTimer timer_;
  QThreadPool writer_;  ///< one thread, so that the list is written after its files
  std::map<QString, std::weak_ptr<const ModelData>> kept_;  ///< by file
  QStringList taken_over_;                                  ///< folders
  int next_file_ = 1;
  bool failed_ = false;
};

/// The models of a lost session.
struct RestoredModels {
  std::vector<Model> models;
  QStringList files;    ///< of each; empty: in no file of the person's
  QStringList missing;  ///< names of those that cannot be read
};
/// Fails with kCancelled.
Result<RestoredModels> restore(const LostSession& lost, const RunContext& context);

}  // namespace turnscan::studio
