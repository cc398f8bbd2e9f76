#pragma once
// Conversion factors between turns, degrees and radians. Internally all angles are in radians.

#include <numbers>

namespace turnscan {

inline constexpr double kTurn = 2.0 * std::numbers::pi;  ///< radians in a full turn
inline constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;
inline constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

}  // namespace turnscan
