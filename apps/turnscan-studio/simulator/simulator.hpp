#pragma once
// Scanner Simulator: build a rig, run it, see its coverage.

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "app/mode.hpp"
#include "view/drawable.hpp"

class QComboBox;
class QLineEdit;
class QListWidget;
class QPushButton;
class QStackedWidget;
class QTableWidget;
class QTimer;

namespace turnscan {
struct CoverageMapOptions;
struct SceneDescription;
struct ScannerEntry;
struct PlacedObject;
}  // namespace turnscan

namespace turnscan::studio {

class MessageLabel;
class OptionForm;
struct ItemStyle;
struct SimulationResult;

/// Transfers samples from the tracing threads to the view.
struct SampleStream {
  std::mutex mutex;
  std::vector<Vec3f> points;
};

class SimulatorMode : public Mode {
  Q_OBJECT
 public:
  explicit SimulatorMode(const Services& services, QWidget* parent = nullptr);
  ~SimulatorMode() override;

  bool open_file(const QString& path) override;
  void shut_down() override { store(); }
  void undo() override {
    place_changed();
    go_to_step(step_ - 1);
  }
  void redo() override { go_to_step(step_ + 1); }
  QString undo_text() const override;
  QString redo_text() const override;
  void remove_selected() override;

  void set_object(const QString& object);
  void add_scanner(const QString& model);
  void load_scene(const QString& path);
  void save_scene(const QString& path);
  void run();
  /// The scene in the form read by the command line's --scene.
  const SceneDescription& scene();
  void set_folder(const QString& folder);
  const SimulationResult* result() const { return result_.get(); }
  /// Whether the object of the scene is loaded.
  bool ready() const;
  int scanner_count() const { return int(scanners_.size()); }

 private:
  friend class RigTool;
  struct RigScanner;

  void build_object();
  void build_scanners();
  void build_options();
  void build_run();
  void build_coverage();
  void build_sweep();
  void load_preview();
  void draw_rig();
  void draw_scanner(RigScanner& scanner);
  void select_scanner(int row);
  void drag_scanner(RigScanner& scanner);
  bool add_entry(const ScannerEntry& entry);
  void take_scanner(int row);
  void show_titles();
  ItemStyle lines_style(const RigScanner& scanner) const;
  void show_object(const QString& object);
  void apply_scene(SceneDescription scene);
  void go_to_step(int step);
  void place_changed();
  void show_samples();
  void clear_samples();
  void show_result(std::shared_ptr<SimulationResult> result);
  void show_coloring(int index);
  void fill_holes();
  void fly_to_hole(int row);
  bool scanners_are_valid() const;
  void store();
  void restore();
  double aim_height() const;

  std::unique_ptr<SceneDescription> scene_;
  std::unique_ptr<CoverageMapOptions> coverage_;
  std::vector<std::unique_ptr<RigScanner>> scanners_;
  std::shared_ptr<const PlacedObject> placed_;
  std::shared_ptr<SampleStream> stream_;
  std::shared_ptr<SimulationResult> result_;
  std::unique_ptr<class RigTool> tool_;

  JobRunner* quick_;  ///< for previews, in parallel with the long jobs
  QTimer* preview_;
  QTimer* poll_;
  QTimer* pause_;  ///< after which a change by a slider or by typing is one step of undo
  QComboBox* object_;
  const RigScanner* swept_ = nullptr;  ///< compared only: it may be gone
  QListWidget* list_;
  QStackedWidget* places_;
  QLineEdit* folder_;
  QPushButton* run_;
  QPushButton* send_;
  QPushButton* reconstruct_;
  QComboBox* coloring_;
  QTableWidget* holes_;
  QWidget* coverage_box_;
  MessageLabel* error_;
  std::vector<std::pair<QString, OptionForm*>> forms_;
  int object_item_ = 0, table_item_ = 0, coverage_item_ = 0, hole_item_ = 0;
  std::vector<std::string> steps_;  ///< undo steps: the scene as TOML, oldest first
  int step_ = 0;
  std::vector<int> sample_items_;
  std::size_t samples_shown_ = 0;
};

}  // namespace turnscan::studio
