#pragma once
// One scanner of the rig, what it is and where it stands, as fields and sliders.

#include <QWidget>
#include <memory>
#include <optional>
#include <turnscan/simulator/scene_file.hpp>

namespace turnscan::studio {

class OptionForm;

class ScannerEditor : public QWidget {
  Q_OBJECT
 public:
  /// base: the parameters of the entry's preset or file.
  ScannerEditor(const ScannerEntry& entry, ScannerParameters base, ScannerSetup setup,
                QWidget* parent);
  ~ScannerEditor() override;

  /// Empty; or why the fields are no scanner, in the words of the command line.
  QString error() const;
  /// The last one that the fields were.
  const ScannerModel& model() const { return model_; }
  /// refresh() shows changes.
  ScannerPlacement& placement() { return setup_->placement; }
  void refresh();
  /// With the values that differ from its preset or file, and from the common place; its whole
  /// place if there is none.
  ScannerEntry entry(std::optional<ScannerPlacement> common) const;
  /// Name of its preset or file, and whether it was changed.
  QString title() const;

  /// Takes over everything but the place.
  void fill(const QString& preset_or_file);
  /// Writes the fields as a scanner's file, which takes the place of what they came from.
  void save_as(const QString& file);

 Q_SIGNALS:
  void changed();
  void failed(const QString& text);
  void saved(const QString& file);

 private:
  using Values = std::vector<std::pair<std::string, std::string>>;
  Values changed_keys() const;
  OptionForm* add_form(OptionTable table, const QStringList& sliders, QWidget* section);
  void build();
  void take_fields();
  void save_dialog();

  QString name_;
  ScannerParameters base_, before_;
  std::unique_ptr<ScannerSetup> setup_;  ///< what the fields refer to
  ScannerModel model_;
  QString problem_;
  std::vector<OptionForm*> forms_;
};

}  // namespace turnscan::studio
