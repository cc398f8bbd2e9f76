#pragma once
// 3D Scanner: view, calibrate, record.

#include <memory>
#include <optional>
#include <turnscan/capture/session/device_calibration.hpp>
#include <turnscan/turntable/detection/average.hpp>
#include <vector>

#include "app/mode.hpp"
#include "view/drawable.hpp"

class QCheckBox;
class QComboBox;
class QLabel;
class QLayout;
class QPushButton;
class QTimer;

namespace turnscan {
struct Calibration;
}

namespace turnscan::studio {

class LiveFeed;
class MessageLabel;
class OptionForm;
class PickTool;
class RecordPanel;
struct LiveState;

/// Number of display updates since the recording began.
struct LiveUpdates {
  std::size_t pictures = 0, coverages = 0, surfaces = 0;
};

class ScannerMode : public Mode {
  Q_OBJECT
 public:
  explicit ScannerMode(const Services& services, QWidget* parent = nullptr);
  ~ScannerMode() override;

  void undo() override { undo_pick(); }
  QString undo_text() const override { return picks_.empty() ? QString() : tr("click"); }
  void shut_down() override;

  /// Shows how to place the object, repositions it if the source can, and continues its recording.
  void scan_another_side(const AnotherSide& side);
  /// Plays the device of an unfinished recording, which the next click goes on with.
  void resume_recording(const QString& folder);
  void set_device(const QString& uri);
  /// Plays the chosen device, once those that there are have been looked for.
  void play_when_listed();
  RecordPanel& recording() { return *record_; }
  bool is_recording() const { return recording_; }
  const LiveUpdates& updates() const { return updates_; }
  const Calibration* calibration() const { return calibration_.get(); }
  void load_calibration(const QString& path);
  void save_calibration(const QString& path);
  /// Adds a point on the platter's rim, sensor frame.
  void add_pick(const Vec3d& point);
  void undo_pick();
  std::size_t picks() const { return picks_.size(); }
  /// The last comparison of the platter with the calibration.
  const std::optional<RigCheck>& rig_check() const { return rig_; }

 protected:
  void showEvent(QShowEvent* event) override;
  /// Space records and stops.
  void keyPressEvent(QKeyEvent* event) override;

 private:
  struct CalibrationOptions;

  void build_device();
  void build_calibration();
  QLayout* make_pick_buttons(QWidget* parent);
  QLayout* make_calibration_files(QWidget* parent);
  void build_recording();
  QWidget* make_banner();
  void show_rig(const std::optional<RigCheck>& rig);
  void show_empty_text();
  void list_devices();
  QString chosen_uri() const;
  /// A table and its speed belong to one device: clears those of another.
  void take_device(const QString& uri);
  void forget_calibration();
  void toggle_play();
  /// Plays what is chosen in place of what plays.
  void play_chosen();
  void poll();
  void ended();
  void show_state(const LiveState& state);
  void show_picture(const LiveState& state);
  void show_seen(const LiveState& state);
  void start_average();
  void average_done(std::unique_ptr<FrameSequence> frames);
  void show_average(std::shared_ptr<const AveragedScan> scan, const DrawablePtr& drawable,
                    const std::string& check);
  void calibrate();
  void start_picking(bool on);
  void fit_picks();
  void clear_picks();
  /// Why points are not used; empty: they are.
  QString problem_of_picks(const Calibration& picked) const;
  void show_platter(const LiveState& state);
  void show_calibration(std::shared_ptr<const Calibration> calibration, bool kept = false);
  void draw_calibration();
  void clear_calibration();
  void drop_kept_calibration();
  void note_known_table();
  void toggle_record();
  void set_still(bool still);

  std::unique_ptr<LiveFeed> feed_;
  std::unique_ptr<CalibrationOptions> options_;
  std::unique_ptr<PickTool> pick_tool_;
  std::shared_ptr<const AveragedScan> scan_;
  std::shared_ptr<const Calibration> calibration_;
  QString played_uri_, played_text_;
  bool for_next_device_ = false;   ///< the calibration was loaded before a device was opened
  bool is_kept_ = false;           ///< the calibration is that of an earlier recording
  bool kept_is_outdated_ = false;  ///< the stored calibration of the current device does not fit
  std::vector<Vec3d> picks_;
  std::shared_ptr<const Calibration> before_picks_;  ///< used without them
  std::optional<DetectedPlatter> platter_;           ///< the last that was detected

  JobRunner* quick_;
  QTimer* poll_;
  QComboBox* device_;
  QPushButton *play_, *live_, *average_, *calibrate_, *pick_, *undo_pick_, *save_;
  QCheckBox* filter_;
  QLabel *live_text_, *calibration_text_, *chip_;
  RecordPanel* record_;
  QWidget* banner_;
  MessageLabel* banner_text_;
  std::optional<RigCheck> rig_;
  LiveUpdates updates_;
  OptionForm *average_form_, *detect_form_;
  MessageLabel *device_error_, *calibration_error_;
  int live_item_ = 0, scan_item_ = 0, ring_item_ = 0, picks_item_ = 0, seen_item_ = 0;
  bool play_again_ = false;  ///< another device was chosen; this one ends
  bool plays_when_listed_ = false;
  bool calibrates_ = false;  ///< once the averaged scan is there
  bool averaging_ = false, still_ = false, framed_ = false, recording_ = false;
};

}  // namespace turnscan::studio
