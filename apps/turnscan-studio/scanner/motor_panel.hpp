#pragma once
// The board that drives the table, if there is one.

#include <QWidget>
#include <memory>
#include <string>
#include <turnscan/capture/session/capture.hpp>

class QComboBox;
class QLabel;
class QPushButton;

namespace turnscan::studio {

class JobRunner;
class MessageLabel;
class OptionForm;

class MotorPanel : public QWidget {
  Q_OBJECT
 public:
  explicit MotorPanel(QWidget* parent = nullptr);
  ~MotorPanel() override;

  /// Serial port; empty: no motor.
  std::string port() const;
  void set_port(const QString& port);
  const MotorOptions& options() const { return options_; }
  const CaptureStops& stops() const { return stops_; }
  QString first_error() const;
  /// Disables trying the motor while a recording uses the board.
  void set_in_use(bool in_use);
  /// Whether the table is turning by its button.
  bool turning() const;
  void stop();
  void store() const;
  void restore();

 private:
  void list_ports();
  void toggle_turn();

  MotorOptions options_;
  CaptureStops stops_;
  JobRunner* jobs_;
  QComboBox* port_;
  QPushButton* turn_;
  QLabel* text_;
  MessageLabel* error_;
  OptionForm *stops_form_, *form_;
};

}  // namespace turnscan::studio
