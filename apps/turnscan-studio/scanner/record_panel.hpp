#pragma once
// Where to, how long and with what: the panel of a recording, and how it goes on.

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
  /// What is recorded next is added to the recording in this folder; empty: a recording of its own.
  void set_next_pass(const QString& folder, const QString& advice);
  /// Each device's table has its own speed; the one typed before the first device is that one's.
  void set_device(const QString& uri);
  bool reconstruct() const;
  /// What is to be recorded; nullopt: something is wrong, and it is shown.
  std::optional<RecordingRequest> request();
  void show_error(const QString& text);
  /// What is said of the recording before does not belong to what plays now.
  void forget_last();
  /// open: a sensor is there to be recorded.
  void show_state(const LiveState& state, bool open);
  MotorPanel& motor() { return *motor_; }
  void store() const;
  /// Errors, progress and the button, which are to stay in sight.
  QWidget* footer() const { return footer_; }

 Q_SIGNALS:
  void clicked();

 private:
  struct Options;
  void build_options();
  void build_next_pass(QVBoxLayout* layout);
  QString seen_text(const CoverageSummary& seen) const;
  QString progress_text(const LiveState& state) const;

  std::unique_ptr<Options> options_;
  QString device_;
  QString next_pass_;  ///< folder that gets another pass; empty: none
  QWidget* footer_;
  ParagraphLabel* advice_;
  QPushButton* leave_;
  QLineEdit* folder_;
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
