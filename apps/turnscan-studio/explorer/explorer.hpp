#pragma once
// Model Explorer: load, process, compare, edit, save.

#include <map>
#include <memory>

#include "app/mode.hpp"
#include "explorer/models.hpp"
#include "explorer/output/doubtful_unit.hpp"
#include "explorer/output/export_model.hpp"
#include "view/scene_view.hpp"

namespace turnscan::studio {

class ComparePanel;
class DeviationPanel;
class EditPanel;
class FramePanel;
class JoinPanel;
class LookPanel;
class MeasurePanel;
class ModelList;
class Section;
class SectionPanel;
class SessionKeeper;
class SidePanel;
struct LostSession;
class StagePanel;
class ToolButtons;
class VerdictPanel;
class VoxelPanel;

class ExplorerMode : public Mode {
  Q_OBJECT
 public:
  explicit ExplorerMode(const Services& services, QWidget* parent = nullptr);
  ~ExplorerMode() override;

  bool open_file(const QString& path) override;
  void undo() override { store_->undo(); }
  void redo() override { store_->redo(); }
  QString undo_text() const override { return store_->undo_text(); }
  QString redo_text() const override { return store_->redo_text(); }
  void save() override;
  void remove_selected() override;
  void shut_down() override;

  void open_dialog();
  /// Asks for export options and a path for the selected model.
  void export_dialog();
  void export_as(int id, const QString& path, const ExportOptions& options);
  /// Reconstructs a recording after the queued jobs, and writes its meshes into a folder, unless
  /// that is empty. `done` is called unless it is cancelled; text: the result, or the error.
  void reconstruct_queued(const QString& recording, const QString& folder,
                          const std::function<void(bool good, const QString& text)>& done);
  /// The title of that job.
  static QString queue_title(const QString& recording);
  /// Shows a contact sheet of the visible models; see SheetDialog.
  void show_stages();
  /// Rotates the view once; see TurntableMovie.
  void make_movie(const QString& path, int frames);
  /// Sets the callback that asks for the unit of a file whose size is implausible.
  void set_unit_question(UnitQuestion question) { ask_unit_ = std::move(question); }
  /// Loads a recording and then optionally runs all stages.
  void take_recording(const QString& folder, bool reconstruct);
  /// Draws a surface, table frame, in place of the models until the next mesh, or until it fails.
  void show_until_mesh(const DrawablePtr& surface);
  bool shows_surface() const { return preview_ != 0; }
  void run_stage(const QString& stage);
  void save_as(int id, const QString& path);
  /// All that are in no file, as NAME.ply, or NAME.glb with a texture; no file is replaced.
  void save_all(const QString& folder);
  void save_preset(const QString& path);
  /// Exports the report page of the run that made a model.
  void export_report(int id, const QString& path);
  /// Opens what an earlier session left, with its undo steps and its view; as one step in addition
  /// to what is open already.
  void restore_session(const LostSession& lost);

  ModelStore& store() { return *store_; }
  ModelList& list() { return *list_; }
  StagePanel& stages() { return *stages_; }
  ComparePanel& comparison() { return *compare_; }
  DeviationPanel& deviations() { return *deviations_; }
  MeasurePanel& measurements() { return *measure_; }
  SectionPanel& section() { return *section_; }
  EditPanel& edits() { return *edits_; }
  SessionKeeper& session() { return *session_; }
  SidePanel& side() { return *side_; }
  VerdictPanel& verdict() { return *verdict_; }
  FramePanel& frames() { return *frames_; }

 Q_SIGNALS:
  void file_opened(const QString& path);

 private:
  enum Beside { kOthers, kAlone };  ///< whether other models stay visible
  void load(const QString& path, const std::function<void()>& then,
            std::optional<double> metres_per_unit = std::nullopt, Beside beside = kOthers);
  std::vector<int> visible_models() const;
  std::optional<Model> stage_input() const;
  std::optional<int> recording_from(const QString& folder) const;
  void movie_dialog();
  void run_filter();
  void run_comparison();
  void add_sections();
  void connect_panels();
  /// The two models of a split view, left and right; nullptr if it is not split.
  std::pair<const Model*, const Model*> side_by_side() const;
  ItemStyle style_of(const Model& model) const;
  DrawablePtr drawable_of(const Model& model) const;
  void sync();
  void draw_missing();
  void color_selected();
  void draw_colored();
  void report_dialog();
  void show_frames(const Model* model);
  void on_selection(int id);

  ModelStore* store_;
  ModelList* list_;
  StagePanel* stages_;
  ComparePanel* compare_;
  ToolButtons* tools_;
  DeviationPanel* deviations_;
  MeasurePanel* measure_;
  SectionPanel* section_;
  EditPanel* edits_;
  SidePanel* side_;
  JoinPanel* join_;
  Section* join_section_;
  VerdictPanel* verdict_;
  LookPanel* look_;
  VoxelPanel* voxels_;
  FramePanel* frames_;
  Section *frames_section_, *voxels_section_, *verdict_section_, *side_section_;
  SessionKeeper* session_;
  struct Shown {
    int item = 0;
    ModelDataPtr data;
    DrawablePtr drawable;
  };
  int preview_ = 0;       ///< item of show_until_mesh(); 0: none
  int legend_model_ = 0;  ///< the legend is shown while this model is visible
  Legend legend_;
  std::map<int, Shown> shown_;  ///< by model
  UnitQuestion ask_unit_;
  std::vector<int> queued_results_;  ///< models
  Shown missing_;                    ///< the surface of the selected mesh that no view saw
  /// The selected mesh coloured by a property.
  struct Colored {
    int item = 0;
    ModelDataPtr of;
    DrawablePtr drawable;
    Legend legend;
  } colored_;
};

}  // namespace turnscan::studio
