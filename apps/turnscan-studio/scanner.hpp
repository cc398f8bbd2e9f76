#pragma once
// 3D Scanner: look, calibrate, record.

#include <memory>
#include <optional>
#include <turnscan/turntable/average.hpp>
#include <vector>

#include "mode.hpp"

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
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
struct LiveState;

class ScannerMode : public Mode {
  Q_OBJECT
 public:
  explicit ScannerMode(const Services& services, QWidget* parent = nullptr);
  ~ScannerMode() override;

  void undo() override { undo_pick(); }
  void shut_down() override;

  void set_device(const QString& uri);
  void set_folder(const QString& folder);
  const Calibration* calibration() const { return calibration_.get(); }
  void load_calibration(const QString& path);
  void save_calibration(const QString& path);
  /// A point on the platter's rim, sensor frame.
  void add_pick(const Vec3d& point);
  void undo_pick();
  std::size_t picks() const { return picks_.size(); }

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  struct RecordOptions;

  void build_device();
  void build_calibration();
  void build_recording();
  void list_devices();
  void toggle_play();
  void poll();
  void show_state(const LiveState& state);
  void start_average();
  void average_done(std::unique_ptr<FrameSequence> frames);
  void calibrate();
  void start_picking(bool on);
  void fit_picks();
  void show_calibration(std::shared_ptr<const Calibration> calibration);
  void draw_calibration();
  void toggle_record();
  void set_still(bool still);

  std::unique_ptr<LiveFeed> feed_;
  std::unique_ptr<RecordOptions> options_;
  std::unique_ptr<PickTool> pick_tool_;
  std::shared_ptr<const AveragedScan> scan_;
  std::shared_ptr<const Calibration> calibration_;
  std::vector<Vec3d> picks_;

  JobRunner* quick_;
  QTimer* poll_;
  QComboBox* device_;
  QPushButton *play_, *average_, *calibrate_, *pick_, *undo_pick_, *record_;
  QCheckBox *filter_, *reconstruct_;
  QLabel *live_text_, *calibration_text_, *record_text_;
  QLineEdit* folder_;
  OptionForm *record_form_, *average_form_, *detect_form_;
  MessageLabel *device_error_, *calibration_error_, *record_error_;
  int live_item_ = 0, scan_item_ = 0, ring_item_ = 0, picks_item_ = 0;
  bool averaging_ = false, still_ = false, recording_ = false, framed_ = false;
};

}  // namespace turnscan::studio
