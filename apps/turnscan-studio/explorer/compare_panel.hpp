#pragma once

#include <QWidget>
#include <memory>
#include <optional>
#include <set>

class QComboBox;
class QLabel;
class QLayout;
class QPushButton;

namespace turnscan {
struct Evaluation;
struct EvaluateOptions;
}  // namespace turnscan

namespace turnscan::studio {

class MessageLabel;
class ModelStore;
class OptionForm;
class ParagraphLabel;

/// Compares two models: side by side, overlaid, or by their distance.
class ComparePanel : public QWidget {
  Q_OBJECT
 public:
  enum Way { kOff = -1, kSideBySide = 0, kOverlay = 1, kDistance = 2 };

  explicit ComparePanel(ModelStore& store, QWidget* parent = nullptr);
  ~ComparePanel() override;

  Way way() const { return way_; }
  int reference() const;  ///< id of the model
  int compared() const;
  const EvaluateOptions& options() const { return *options_; }
  QString first_error() const;
  /// nullopt: nothing is shown.
  void show_figures(const QString& pair, const std::optional<Evaluation>& figures);
  /// That of the two models whose bounding box contains the other's; 0: neither.
  int enclosing() const;
  void show_error(const QString& text);
  void stop();

 Q_SIGNALS:
  void changed();
  void distance_wanted();

 private:
  QLayout* make_choice();
  QLayout* make_way_buttons();
  void fill();
  void choose(Way way);
  void enable();

  ModelStore& store_;
  std::unique_ptr<EvaluateOptions> options_;
  QComboBox *reference_, *compared_;
  QPushButton* ways_[3];
  OptionForm* form_;
  QLabel* figures_;
  ParagraphLabel* note_;
  std::set<int> known_;  ///< the models at the last update
  MessageLabel* error_;
  Way way_ = kOff;
};

}  // namespace turnscan::studio
