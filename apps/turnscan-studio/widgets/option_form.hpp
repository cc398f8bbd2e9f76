#pragma once
// Input fields for an options struct of the library, generated from its OptionTable, which defines
// names, ranges, units, help and error messages. The label of a value that differs from its default
// is a link that resets it.

#include <QMap>
#include <QString>
#include <QWidget>
#include <turnscan/core/option_table.hpp>
#include <vector>

class QGridLayout;
class QLabel;
class QSlider;

namespace turnscan::studio {

class OptionForm : public QWidget {
  Q_OBJECT
 public:
  /// The table refers to a struct that must outlive the form. The editor of the field "voxel-size"
  /// has the object name "option:voxel-size". hide: fields without a row. sliders: numbers that
  /// get one too, "slider:voxel-size".
  explicit OptionForm(OptionTable table, const QStringList& hide = {}, QWidget* parent = nullptr,
                      const QStringList& sliders = {});

  /// Whether every typed text was accepted; the struct holds the last valid values.
  bool valid() const;
  /// The first error, in the words of the command line; empty: none.
  QString first_error() const;
  /// Shows the current values of the struct.
  void refresh();
  void reset_to_defaults();
  /// Shows only those fields, of the ones whose name begins so, that apply.
  void show_fields(const QString& prefix, bool apply);
  /// Shows the value that an automatic option had in the last run; `why` becomes the tool tip.
  void show_used(const QString& field, const QString& value, const QString& why);

  /// Values that differ from the defaults, by name.
  QMap<QString, QString> values() const;
  /// Ignores unknown names and values that are no longer valid.
  void set_values(const QMap<QString, QString>& values);

  /// Store values() in the settings, and restore them.
  void store(const QString& group) const;
  void restore(const QString& group);

  const OptionTable& table() const { return table_; }

 Q_SIGNALS:
  void changed();

 private:
  struct Row {
    const OptionField* field = nullptr;
    QWidget* editor = nullptr;
    QSlider* slider = nullptr;                  ///< may be none
    QLabel *error = nullptr, *label = nullptr;  ///< a flag has no label
    std::string initial;                        ///< the default
    QString problem;
  };

  void add_row(const OptionField& field, bool with_slider);
  QWidget* make_editor(std::size_t row);
  QSlider* make_slider(std::size_t row);
  void take(std::size_t row, const QString& text);
  void show_problem(Row& row);
  void mark(const Row& row);
  void show_value(const Row& row);
  void show_on_slider(const Row& row);

  OptionTable table_;
  std::vector<Row> rows_;
  QGridLayout* grid_;
};

}  // namespace turnscan::studio
