#pragma once
// The panel of a recording: folder, duration, options, and progress.

#include <QWidget>
#include <memory>
#include <optional>

class QCheckBox;
class QLabel;
class QLineEdit;
class QProgressBar;
class QPushButton;
class QVBoxLayout;

namespace turnscan::studio {

class MessageLabel;
class MotorPanel;
class OptionForm;
class ParagraphLabel;
struct CoverageSummary;
struct LiveState;
struct RecordingRequest;

class RecordPanel : public QWidget {
  Q_OBJECT
 public:
  explicit RecordPanel(QWidget* parent = nullptr);
  ~RecordPanel() override;

  void set_folder(const QString& folder);
  /// Adds the next recording to the one in this folder; empty: makes a new recording.
  void set_next_pass(const QString& folder, const QString& advice);
  /// Goes on with the unfinished recording in this folder.
  void set_unfinished(const QString& folder);
  /// The folder of the last recording if its program ended before it did; else empty.
  static QString unfinished();
  /// Offers it no more.
  static void leave_unfinished();
  /// Each device's table has its own speed; a speed typed before the first device was set belongs
  /// to that one.
  void set_device(const QString& uri);
  bool reconstruct() const;
  /// The requested recording; nullopt: invalid, and the error is shown.
  std::optional<RecordingRequest> request();
  void show_error(const QString& text);
  /// Clears the text about the previous recording, which does not apply to the source playing now.
  void forget_last();
  /// open: a sensor is available for recording.
  void show_state(const LiveState& state, bool open);
  bool can_record() const { return record_->isEnabled(); }
  void take_focus() { record_->setFocus(); }
  MotorPanel& motor() { return *motor_; }
  void store() const;
  /// Errors, progress and the button, which stay visible.
  QWidget* footer() const { return footer_; }

 Q_SIGNALS:
  void clicked();

 private:
  struct Options;
  void build_options();
  void build_next_pass(QVBoxLayout* layout);
  QString seen_text(const CoverageSummary& seen) const;
  void show_free_folder();
  QString progress_text(const LiveState& state) const;

  std::unique_ptr<Options> options_;
  QString device_;
  QString next_pass_;     ///< folder to which a pass is added; empty: none
  bool resumes_ = false;  ///< what is added is the rest of its first pass
  QWidget* footer_;
  ParagraphLabel* advice_;
  QPushButton* leave_;
  QLineEdit* folder_;
  QLabel* free_folder_;
  QCheckBox* reconstruct_;
  QPushButton* record_;
  QProgressBar* bar_;
  QLabel *text_, *seen_;
  MessageLabel* error_;
  MotorPanel* motor_;
  OptionForm* speed_;
  std::vector<std::pair<QString, OptionForm*>> forms_;
};

}  // namespace turnscan::studio
