#pragma once
// The models of the Explorer, and every state of their list that undo goes back to.

#include <QColor>
#include <QObject>
#include <QString>
#include <QStringList>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <turnscan/core/frame.hpp>
#include <turnscan/geometry/selection/selection.hpp>
#include <vector>

#include "app/another_side.hpp"
#include "view/drawable.hpp"

namespace turnscan::studio {

struct ModelData;
struct ScanQuality;

enum class ModelKind { kMesh, kCloud, kRecording };

/// Of a mesh made from a recording.
struct MissingSurface {
  AnotherSide side;
  DrawablePtr drawable;  ///< what no view saw; nullptr: nothing worth drawing
};

/// The passes of a recording that a mesh is made of.
struct PassesOfMesh {
  std::shared_ptr<const ModelData> recording;
  std::map<std::uint32_t, Pose> T_mesh_table;  ///< where their tables lie, by the pass's number
};

/// Never changed once made: an edit makes new data, so that undo only swaps pointers.
struct ModelData {
  ModelKind kind = ModelKind::kCloud;
  TriangleMesh mesh;
  std::vector<float> confidence;      ///< of each vertex of mesh, or empty; saved with it
  PointCloud cloud;                   ///< of a recording: a preview
  std::vector<Viewpoint> viewpoints;  ///< of cloud.frame, where they are known
  std::shared_ptr<const FrameSequence> recording;  ///< or what another program recorded
  std::vector<std::string> recording_notes;        ///< what is missing in it
  std::shared_ptr<const MissingSurface> missing;   ///< of a mesh; nullptr: not known
  std::shared_ptr<const ScanQuality> quality;      ///< of a mesh as the scan made it, or nullptr
  std::shared_ptr<const PassesOfMesh> passes;      ///< the same, of a recording with several passes
  std::optional<double> metres_per_unit;           ///< that its file was read with, if it was told
  QString source;                                  ///< file, or what was run to make it
  QString report;                                  ///< several lines for people
  DrawablePtr drawable;
};
using ModelDataPtr = std::shared_ptr<const ModelData>;

struct Model {
  int id = 0;
  QString name;
  ModelDataPtr data;
  bool visible = true;
  QColor color;
  bool own_colors = true;
  double opacity = 1.0;
};

/// What an edit is about: triangles of a mesh, or points of a cloud.
struct SelectedParts {
  ModelDataPtr of;  ///< nullptr: nothing is selected
  std::shared_ptr<const Selection> parts;
  DrawablePtr drawable;  ///< how they are shown; nullptr: there are none
};

/// The models, what is selected of them, and what was done next.
struct ModelState {
  QString what;
  std::vector<Model> models;
  SelectedParts selected;
};

/// "24 686 triangles", "12 345 points" or "920 frames"
QString count_text(const ModelData& data);

class ModelStore : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;

  const std::vector<Model>& models() const { return models_; }
  const Model* find(int id) const;

  /// Every change is one step of undo; `what` names it: "Undo delete".
  int add(const QString& name, ModelDataPtr data);
  /// Several models as one step.
  std::vector<int> add_all(const std::vector<std::pair<QString, ModelDataPtr>>& made,
                           const QString& what);
  /// The same, with colours and visibility of their own; ids are given anew.
  std::vector<int> add_models(std::vector<Model> models, const QString& what);
  /// The same, hiding those that they were made from: they lie in the same place.
  std::vector<int> add_instead(const std::vector<std::pair<QString, ModelDataPtr>>& made,
                               const std::vector<int>& hidden, const QString& what);
  void rename(int id, const QString& name);
  void set_visible(int id, bool visible);
  void set_color(int id, const QColor& color, bool own_colors);
  /// Of several changes of one model in a row only the first is a step of undo.
  void set_opacity(int id, double opacity);
  void set_data(int id, ModelDataPtr data, const QString& what);
  /// The same of a file that was read again, as add_instead() does with a new one.
  void renew(int id, ModelDataPtr data, const std::vector<int>& hidden, const QString& what);
  void duplicate(int id);
  void remove(int id);
  /// A step of undo, too, unless nothing is selected and nothing was. It ends with the data that it
  /// is of.
  void select_parts(SelectedParts selected, const QString& what);
  const SelectedParts& selected_parts() const { return selected_; }

  /// The data are in this file now: opened from there, or saved.
  void set_file(const ModelDataPtr& data, const QString& file);
  /// Empty: in no file. A recording is its own folder.
  QString file_of(const ModelData& data) const;
  /// Names of the models that are in no file.
  QStringList unsaved() const;

  bool can_undo() const { return !undo_.empty(); }
  bool can_redo() const { return !redo_.empty(); }
  QString undo_text() const { return undo_.empty() ? QString() : undo_.back().what; }
  QString redo_text() const { return redo_.empty() ? QString() : redo_.back().what; }
  void undo();
  void redo();
  /// What each step did, oldest first, those that redo would bring back included.
  QStringList history() const;
  /// After how many of them the models are as they are now.
  std::size_t place_in_history() const { return undo_.size(); }
  /// Undoes or redoes until as many steps are done; more than there are: all.
  void go_to(std::size_t place);
  /// What undo goes back to, oldest first; the models as they are; what redo brings back, the next
  /// one first.
  std::vector<ModelState> states() const;
  /// Takes these in place of what there is, with `place` steps done. At least one more than that.
  void set_states(std::vector<ModelState> states, std::size_t place);

 Q_SIGNALS:
  void changed();

 private:
  void step(const QString& what);
  void drop_stale_selection();
  void step_back();
  void step_forward();
  std::vector<int> append(std::vector<Model> models);
  std::vector<Model> as_models(const std::vector<std::pair<QString, ModelDataPtr>>& made);
  Model* mutable_find(int id);
  QString free_name(const QString& wanted) const;

  std::vector<Model> models_;
  SelectedParts selected_;
  std::vector<ModelState> undo_, redo_;
  std::vector<std::pair<std::weak_ptr<const ModelData>, QString>> files_;
  int next_id_ = 1, next_color_ = 0;
};

}  // namespace turnscan::studio
