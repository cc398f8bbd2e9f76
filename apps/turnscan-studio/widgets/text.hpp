#pragma once
// Formats names and numbers for display.

#include <QString>
#include <cstddef>
#include <string>

namespace turnscan::studio {

/// 12345 -> "12 345", with narrow no-break spaces
QString grouped(std::size_t number);

/// Rounds a number with its unit to three digits: "1.98754mm" -> "1.99 mm", "256000000" -> "256 000
/// 000"; other texts are unchanged.
QString short_value(const QString& text);

/// "voxel-min-points" -> "Voxel min points"
QString title_of(const std::string& name);

/// A text of the library in the language of the window if `scripts/translate` knows it, else
/// unchanged.
QString translated(const QString& text);
inline QString translated_title(const std::string& name) { return translated(title_of(name)); }

}  // namespace turnscan::studio
