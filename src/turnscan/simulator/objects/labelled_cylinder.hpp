#pragma once
// The cylinder with a printed label around it: what a colour camera resolves, as text.

#include <array>
#include <cstdint>
#include <string_view>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan::objects {

/// A line of capitals, figures and signs. It begins at angle_rad (0: the front, +Z; towards +X,
/// which is to the right for who looks from outside).
struct LabelLine {
  std::string_view text;
  double cap_height_m;  ///< of a capital, seven dots
  double baseline_m;    ///< above the platter
  double angle_rad;
};

inline constexpr int kGlyphColumns = 5, kGlyphRows = 7;
/// Dots from one character to the next.
inline constexpr int kGlyphAdvance = 6;

/// Columns of a character from the left, bit 0 the upper row; nothing for one that there is not.
std::array<std::uint8_t, kGlyphColumns> glyph_of(char character);

/// From the top to the bottom.
std::array<LabelLine, 7> label_lines();

/// The cylinder of SolidCylinder with a texture, 0.1 mm a pixel.
TriangleMesh make_labelled_cylinder(TriangleMesh cylinder);

}  // namespace turnscan::objects
