#pragma once
// Detects files that do not state their unit and are implausibly large or small in the usual one.

#include <QString>
#include <functional>
#include <optional>

#include "explorer/loading.hpp"

class QWidget;

namespace turnscan::studio {

struct DoubtfulUnit {
  QString file;
  double size_m = 0.0;           ///< largest side, as read
  double metres_per_unit = 1.0;  ///< with which it was read
  double likely = 1e-3;          ///< the most plausible of the units below
};

/// Millimetres, centimetres, inches, metres.
inline constexpr double kFileUnits_m[] = {1e-3, 1e-2, 0.0254, 1.0};

/// For an OBJ, STL or PLY that is smaller than 4 mm or larger than 2.5 m as read, which is
/// implausible for an object on a turntable; else nullopt.
std::optional<DoubtfulUnit> doubtful_unit(const QString& path, const NamedModels& models);

/// "13.9 m", "139 mm"
QString size_of_model(double metres);

/// Returns metres per unit of the file; nullopt: it is not to be opened. A dialog, unless a test
/// answers.
using UnitQuestion = std::function<std::optional<double>(const DoubtfulUnit&)>;
std::optional<double> ask_unit(const DoubtfulUnit& doubt, QWidget* parent);

}  // namespace turnscan::studio
