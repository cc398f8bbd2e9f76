#pragma once
// Names and numbers as they are shown.

#include <QString>
#include <cstddef>
#include <string>

namespace turnscan::studio {

/// 12345 -> "12 345", with narrow no-break spaces
QString grouped(std::size_t number);

/// Three digits of a number with its unit: "1.98754mm" -> "1.99 mm", "256000000" -> "256 000 000";
/// other texts stay.
QString short_value(const QString& text);

/// "voxel-min-points" -> "Voxel min points"
QString title_of(const std::string& name);

/// A text of the library in the language of the window, where `scripts/translate` knows it, else as
/// it is.
QString translated(const QString& text);
inline QString translated_title(const std::string& name) { return translated(title_of(name)); }

}  // namespace turnscan::studio
