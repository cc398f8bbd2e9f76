#pragma once
// Names and numbers as they are shown.

#include <QString>
#include <cstddef>
#include <string>

namespace turnscan::studio {

/// 12345 -> "12 345", with narrow no-break spaces
QString grouped(std::size_t number);

/// "voxel-min-points" -> "Voxel min points"
QString title_of(const std::string& name);

}  // namespace turnscan::studio
