#pragma once
// Files that do not say their unit, and are implausibly large or small in the usual one.

#include <QString>
#include <functional>
#include <optional>

#include "explorer/loading.hpp"

class QWidget;

namespace turnscan::studio {

struct DoubtfulUnit {
  QString file;
  double size_m = 0.0;           ///< largest side, as the file was read
  double metres_per_unit = 1.0;  ///< with that
  double likely = 1e-3;          ///< of the units below the one that makes most sense
};

/// Millimetres, centimetres, inches, metres.
inline constexpr double kFileUnits_m[] = {1e-3, 1e-2, 0.0254, 1.0};

/// Of an OBJ, STL or PLY that is smaller than 4 mm or larger than 2.5 m as it was read: what stands
/// on a turntable is not.
std::optional<DoubtfulUnit> doubtful_unit(const QString& path, const NamedModels& models);

/// "13.9 m", "139 mm"
QString size_of_model(double metres);

/// Metres per unit of the file. A dialog, unless a test answers.
using UnitQuestion = std::function<double(const DoubtfulUnit&)>;
double ask_unit(const DoubtfulUnit& doubt, QWidget* parent);

}  // namespace turnscan::studio
