#pragma once
// The models of the Explorer, and all states of their list for undo.

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
#include <turnscan/reconstruction/result.hpp>
#include <vector>

#include "app/another_side.hpp"
#include "view/drawable.hpp"

namespace turnscan::studio {

struct ModelData;
struct ScanQuality;

enum class ModelKind { kMesh, kCloud, kRecording };

/// For a mesh made from a recording.
struct MissingSurface {
  AnotherSide side;
  DrawablePtr drawable;  ///< surface that no view saw; nullptr: nothing worth drawing
};

/// The passes of a recording that a mesh was made from.
struct PassesOfMesh {
  std::shared_ptr<const ModelData> recording;
  std::map<std::uint32_t, Pose> T_mesh_table;  ///< poses of their tables, by the pass's number
};

/// Immutable: an edit makes new data, so that undo only swaps pointers.
struct ModelData {
  ModelKind kind = ModelKind::kCloud;
  TriangleMesh mesh;
  std::vector<float> confidence;                   ///< per vertex of mesh, or empty; saved with it
  PointCloud cloud;                                ///< for a recording: a preview
  std::vector<Viewpoint> viewpoints;               ///< of cloud.frame, if known
  std::shared_ptr<const FrameSequence> recording;  ///< also one imported from another program
  std::vector<std::string> recording_notes;        ///< what is missing in it
  std::shared_ptr<const MissingSurface> missing;   ///< for a mesh; nullptr: not known
  std::shared_ptr<const ScanQuality> quality;      ///< for a mesh as made by the scan, else nullptr
  /// For a mesh: positions of the frames of its recording that it was made without.
  std::vector<std::size_t> left_out;
  std::shared_ptr<const PassesOfMesh> passes;  ///< the same, for a recording with several passes
  std::optional<double> metres_per_unit;       ///< with which its file was read, if specified
  QString source;                              ///< file, or the operation that made it
  QString report;                              ///< several human-readable lines
  DrawablePtr drawable;
};
using ModelDataPtr = std::shared_ptr<const ModelData>;

/// What a run made models from, and with which options.
struct MadeWith {
  ModelDataPtr input;                      ///< a recording, or a cloud without one
  std::string stage;                       ///< kMeshStage or one of saveable_stages()
  std::vector<ResolvedParameter> changed;  ///< options, as given; the reason is their default
  std::vector<ResolvedParameter> chosen;   ///< automatic options, and what the data made of them
};
using MadeWithPtr = std::shared_ptr<const MadeWith>;

struct Model {
  int id = 0;
  QString name;
  ModelDataPtr data;
  MadeWithPtr made = nullptr;  ///< nullptr: opened, or made by hand; an edit keeps it
  bool own = false;            ///< edited, or a duplicate: no run takes its place
  bool visible = true;
  QColor color;
  bool own_colors = true;
  double opacity = 1.0;
};

/// The one of these that the model was made from, also if that was read again since; nullptr: none.
const Model* input_of(const Model& model, const std::vector<Model>& among);

/// The parts that an edit applies to: triangles of a mesh, or points of a cloud.
struct SelectedParts {
  ModelDataPtr of;  ///< nullptr: nothing is selected
  std::shared_ptr<const Selection> parts;
  DrawablePtr drawable;  ///< highlight; nullptr: there are none
};

/// The models, the selected parts, and the next action.
struct ModelState {
  QString what;
  std::vector<Model> models;
  SelectedParts selected;
};

/// The only one of several passes that a mesh was made from; nullopt: all, or there is only one.
std::optional<std::uint32_t> only_pass(const ModelData& data);

/// "24 686 triangles", "12 345 points" or "920 frames"
QString count_text(const ModelData& data);

class ModelStore : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;

  const std::vector<Model>& models() const { return models_; }
  const Model* find(int id) const;

  /// Every change is one undo step; `what` names it: "Undo delete".
  int add(const QString& name, ModelDataPtr data);
  /// Adds several models as one step.
  std::vector<int> add_all(const std::vector<std::pair<QString, ModelDataPtr>>& made,
                           const QString& what);
  /// The same, with their own colours and visibility; ids are reassigned.
  std::vector<int> add_models(std::vector<Model> models, const QString& what);
  /// The same, hiding the models that they were made from, which are in the same place.
  std::vector<int> add_instead(const std::vector<std::pair<QString, ModelDataPtr>>& made,
                               const std::vector<int>& hidden, const QString& what);
  /// The same for the results of a run: what the same stage made of the same recording, or of a
  /// single pass of it, before, is replaced, except by hand-made models. Its other results are
  /// hidden.
  std::vector<int> add_made(const std::vector<std::pair<QString, ModelDataPtr>>& results,
                            const MadeWithPtr& made, const QString& what);
  const Model* input_of(const Model& model) const { return studio::input_of(model, models_); }
  void rename(int id, const QString& name);
  void set_visible(int id, bool visible);
  void set_color(int id, const QColor& color, bool own_colors);
  /// Of several consecutive changes of one model only the first is an undo step.
  void set_opacity(int id, double opacity);
  void set_data(int id, ModelDataPtr data, const QString& what);
  /// The same for a file that was reloaded, as add_instead() for a new one.
  void renew(int id, ModelDataPtr data, const std::vector<int>& hidden, const QString& what);
  void duplicate(int id);
  void remove(int id);
  /// Also an undo step, unless nothing is selected and nothing was. The selection is dropped when
  /// the data that it refers to are replaced.
  void select_parts(SelectedParts selected, const QString& what);
  const SelectedParts& selected_parts() const { return selected_; }

  /// Notes that the data are stored in this file: opened from it, or saved to it.
  void set_file(const ModelDataPtr& data, const QString& file);
  /// Empty: not in a file. For a recording, its own folder.
  QString file_of(const ModelData& data) const;
  /// Names of the models that are not saved in a file.
  QStringList unsaved() const;

  bool can_undo() const { return !undo_.empty(); }
  bool can_redo() const { return !redo_.empty(); }
  QString undo_text() const { return undo_.empty() ? QString() : undo_.back().what; }
  QString redo_text() const { return redo_.empty() ? QString() : redo_.back().what; }
  void undo();
  void redo();
  /// Description of each step, oldest first, including those that can be redone.
  QStringList history() const;
  /// Number of these steps that are applied now.
  std::size_t place_in_history() const { return undo_.size(); }
  /// Undoes or redoes until this number of steps is applied; all if there are fewer.
  void go_to(std::size_t place);
  /// States for undo, oldest first; the current models; states for redo, the next one first.
  std::vector<ModelState> states() const;
  /// Replaces all states, with `place` steps applied. There must be more states than `place`.
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
