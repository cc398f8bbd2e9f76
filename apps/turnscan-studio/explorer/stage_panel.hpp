#pragma once
// Panels for the stages of the pipeline, in their order.

#include <QWidget>
#include <memory>
#include <string>
#include <turnscan/core/result.hpp>
#include <vector>

class QLabel;
class QLayout;
class QPushButton;

namespace turnscan {
class OptionTable;
struct ResolvedParameter;
struct ReconstructOptions;
}  // namespace turnscan

namespace turnscan::studio {

class MessageLabel;
struct MadeWith;
class OptionForm;
class Section;

class StagePanel : public QWidget {
  Q_OBJECT
 public:
  explicit StagePanel(QWidget* parent = nullptr);
  ~StagePanel() override;

  const ReconstructOptions& options() const { return *options_; }
  /// The first error in the options, or empty.
  QString first_error() const;
  /// Sets all options as they were in that run.
  void use(const MadeWith& made);
  void set_option(const std::string& stage, const QString& name, const QString& value);
  /// Shows the values that were used for automatic options.
  void show_used(const std::vector<ResolvedParameter>& choices);
  void show_error(const QString& text);
  void add_error(const QString& text);
  /// Widgets that stay visible.
  QWidget* error() const;
  QWidget* notice() const;
  QWidget* action() const;
  /// Enables the buttons of the stages, and of the filter, which takes clouds only.
  void set_target(bool has_input, bool cloud);

  /// TOML as read by the command line's --config.
  std::string preset_text() const;
  Result<> load_preset(const std::string& path);
  void store() const;  ///< stores the options in the settings

 Q_SIGNALS:
  /// A stage of saveable_stages(), or "mesh".
  void run(const QString& stage);
  void filter();
  /// Asks to write preset_text() to this path.
  void save_preset(const QString& path);

 private:
  void build();
  QLayout* make_preset_buttons();
  Section* make_section(const std::string& stage, OptionTable table);
  void restore();
  void reset();
  void show_notice();
  void add_run_button(const std::string& stage, Section& section);

  std::unique_ptr<ReconstructOptions> options_;
  std::vector<std::pair<std::string, OptionForm*>> forms_;
  std::vector<QPushButton*> run_buttons_;
  QPushButton* filter_ = nullptr;
  QPushButton* mesh_ = nullptr;
  MessageLabel* error_;
  QLabel* notice_;  ///< which options differ from the defaults
};

}  // namespace turnscan::studio
