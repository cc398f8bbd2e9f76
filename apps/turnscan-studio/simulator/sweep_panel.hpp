#pragma once

#include <QWidget>
#include <functional>
#include <optional>
#include <turnscan/workflow/simulation/coverage_sweep.hpp>

class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace turnscan::studio {

class JobRunner;
class MessageLabel;

/// Coverage over a range of one option of the selected scanner's place, as a plot.
class SweepPanel : public QWidget {
  Q_OBJECT
 public:
  /// A scene whose common place is that of the scanner to be swept.
  using Scene = std::function<Result<SceneDescription>()>;
  SweepPanel(JobRunner& jobs, Scene scene, const CoverageMapOptions& coverage, QWidget* parent);

  void run();
  const std::vector<SweptCoverage>& swept() const { return swept_; }

 Q_SIGNALS:
  /// The value that covers most is to be used.
  void best_wanted(const std::string& option, const std::string& value);

 private:
  void show_swept(const SweepRange& range, std::vector<SweptCoverage> swept);

  JobRunner& jobs_;
  Scene scene_;
  const CoverageMapOptions& coverage_;
  SweepRange range_;
  std::vector<SweptCoverage> swept_;
  QComboBox* option_;
  QLineEdit* values_;
  QPushButton *run_, *use_;
  class SweepPlot* plot_;
  QLabel* best_;
  MessageLabel* error_;
};

}  // namespace turnscan::studio
