#pragma once
// Fields for the options of a library's struct, made from its OptionTable: names, ranges, units,
// help and the words of errors have their one source there.

#include <QMap>
#include <QString>
#include <QWidget>
#include <turnscan/core/option_table.hpp>
#include <vector>

class QGridLayout;
class QLabel;

namespace turnscan::studio {

class OptionForm : public QWidget {
  Q_OBJECT
 public:
  /// The table refers to a struct that must outlive the form. The editor of the field "voxel-size"
  /// has the object name "option:voxel-size". hide: fields that get no row.
  explicit OptionForm(OptionTable table, const QStringList& hide = {}, QWidget* parent = nullptr);

  /// Whether every text that was typed was accepted; the struct holds the last good values.
  bool valid() const;
  /// The first thing that is wrong, in the words of the command line; empty: nothing.
  QString first_error() const;
  /// Shows what the struct holds now.
  void refresh();
  void reset_to_defaults();
  /// What an automatic value was in the last run; `why` becomes the tool tip.
  void show_used(const QString& field, const QString& value, const QString& why);

  /// Values that differ from the defaults, by name.
  QMap<QString, QString> values() const;
  /// Unknown names and values that no longer fit are passed over.
  void set_values(const QMap<QString, QString>& values);

  /// Keeps values() in the settings, and takes them from there.
  void store(const QString& group) const;
  void restore(const QString& group);

  const OptionTable& table() const { return table_; }

 Q_SIGNALS:
  void changed();

 private:
  struct Row {
    const OptionField* field = nullptr;
    QWidget* editor = nullptr;
    QLabel* error = nullptr;
    std::string initial;  ///< the default
    QString problem;
  };

  void add_row(const OptionField& field);
  QWidget* make_editor(std::size_t row);
  void take(std::size_t row, const QString& text);
  void show_problem(Row& row);
  void show_value(const Row& row);

  OptionTable table_;
  std::vector<Row> rows_;
  QGridLayout* grid_;
};

}  // namespace turnscan::studio
