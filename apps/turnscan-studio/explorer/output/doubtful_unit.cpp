#include "explorer/output/doubtful_unit.hpp"

#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>
#include <algorithm>
#include <turnscan/recording/plausibility/plausibility.hpp>

#include "explorer/output/export_model.hpp"

namespace turnscan::studio {

namespace {

constexpr double kUsualSmallest_m = 0.02, kUsualLargest_m = 1.0;

QString name_of_unit(double metres) {
  if (metres == kFileUnits_m[0]) return QObject::tr("Millimetres");
  if (metres == kFileUnits_m[1]) return QObject::tr("Centimetres");
  return metres == kFileUnits_m[2] ? QObject::tr("Inches") : QObject::tr("Metres");
}

}  // namespace

std::optional<DoubtfulUnit> doubtful_unit(const QString& path, const NamedModels& models) {
  const std::string ending = "." + QFileInfo(path).suffix().toLower().toStdString();
  if (!units_are_free(ending)) return std::nullopt;
  Box box;
  for (const auto& [name, data] : models) {
    if (data->kind == ModelKind::kRecording || box_of(*data->drawable).empty()) continue;
    box.add(box_of(*data->drawable).min);
    box.add(box_of(*data->drawable).max);
  }
  const double size = box.size().maxCoeff();
  if (box.empty() || !(size > 0.0) || (size >= kSmallestObject_m && size <= kLargestObject_m))
    return std::nullopt;
  DoubtfulUnit doubt{QFileInfo(path).fileName(), size, unit_of_format(ending), 1.0};
  // A size that is usual on a turntable, or else the nearest to it.
  double best = 1e300;
  for (const double unit : kFileUnits_m) {
    const double as = size / doubt.metres_per_unit * unit;
    const double off = std::max({1.0, as / kUsualLargest_m, kUsualSmallest_m / as});
    if (off < best) best = off, doubt.likely = unit;
  }
  return doubt;
}

QString size_of_model(double metres) {
  return metres < 1.0 ? QObject::tr("%1 mm").arg(1e3 * metres, 0, 'g', 3)
                      : QObject::tr("%1 m").arg(metres, 0, 'g', 3);
}

std::optional<double> ask_unit(const DoubtfulUnit& doubt, QWidget* parent) {
  QMessageBox question(
      QMessageBox::Question, QObject::tr("Which unit?"),
      QObject::tr("%1 does not say its unit. Read in %2 it is %3 large. In which unit is it?")
          .arg(doubt.file, name_of_unit(doubt.metres_per_unit).toLower(),
               size_of_model(doubt.size_m)),
      QMessageBox::NoButton, parent);
  question.setObjectName("unit_question");
  std::vector<std::pair<const QAbstractButton*, double>> answers;
  for (const double unit : kFileUnits_m) {
    auto* made = question.addButton(
        QString("%1 (%2)").arg(name_of_unit(unit),
                               size_of_model(doubt.size_m / doubt.metres_per_unit * unit)),
        QMessageBox::AcceptRole);
    if (unit == doubt.likely) question.setDefaultButton(made);
    answers.emplace_back(made, unit);
  }
  question.addButton(QMessageBox::Cancel);
  question.exec();
  for (const auto& [made, unit] : answers)
    if (question.clickedButton() == made) return unit;
  return std::nullopt;
}

}  // namespace turnscan::studio
