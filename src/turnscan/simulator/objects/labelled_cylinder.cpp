#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/simulator/objects/labelled_cylinder.hpp>
#include <utility>

namespace turnscan::objects {

namespace {

constexpr double kTexel_m = 1e-4;
constexpr double kRadius_m = SolidCylinder::diameter_m / 2;
constexpr Rgb kPaper{236, 230, 214}, kInk{24, 26, 30}, kBand{176, 44, 40}, kTin{150, 156, 164};

using Glyph = std::array<std::uint8_t, kGlyphColumns>;

constexpr std::array<std::pair<char, Glyph>, 43> kGlyphs{{
    {'A', {0x7e, 0x11, 0x11, 0x11, 0x7e}}, {'B', {0x7f, 0x49, 0x49, 0x49, 0x36}},
    {'C', {0x3e, 0x41, 0x41, 0x41, 0x22}}, {'D', {0x7f, 0x41, 0x41, 0x22, 0x1c}},
    {'E', {0x7f, 0x49, 0x49, 0x49, 0x41}}, {'F', {0x7f, 0x09, 0x09, 0x09, 0x01}},
    {'G', {0x3e, 0x41, 0x49, 0x49, 0x7a}}, {'H', {0x7f, 0x08, 0x08, 0x08, 0x7f}},
    {'I', {0x00, 0x41, 0x7f, 0x41, 0x00}}, {'J', {0x20, 0x40, 0x41, 0x3f, 0x01}},
    {'K', {0x7f, 0x08, 0x14, 0x22, 0x41}}, {'L', {0x7f, 0x40, 0x40, 0x40, 0x40}},
    {'M', {0x7f, 0x02, 0x0c, 0x02, 0x7f}}, {'N', {0x7f, 0x04, 0x08, 0x10, 0x7f}},
    {'O', {0x3e, 0x41, 0x41, 0x41, 0x3e}}, {'P', {0x7f, 0x09, 0x09, 0x09, 0x06}},
    {'Q', {0x3e, 0x41, 0x51, 0x21, 0x5e}}, {'R', {0x7f, 0x09, 0x19, 0x29, 0x46}},
    {'S', {0x46, 0x49, 0x49, 0x49, 0x31}}, {'T', {0x01, 0x01, 0x7f, 0x01, 0x01}},
    {'U', {0x3f, 0x40, 0x40, 0x40, 0x3f}}, {'V', {0x1f, 0x20, 0x40, 0x20, 0x1f}},
    {'W', {0x3f, 0x40, 0x38, 0x40, 0x3f}}, {'X', {0x63, 0x14, 0x08, 0x14, 0x63}},
    {'Y', {0x07, 0x08, 0x70, 0x08, 0x07}}, {'Z', {0x61, 0x51, 0x49, 0x45, 0x43}},
    {'0', {0x3e, 0x51, 0x49, 0x45, 0x3e}}, {'1', {0x00, 0x42, 0x7f, 0x40, 0x00}},
    {'2', {0x42, 0x61, 0x51, 0x49, 0x46}}, {'3', {0x21, 0x41, 0x45, 0x4b, 0x31}},
    {'4', {0x18, 0x14, 0x12, 0x7f, 0x10}}, {'5', {0x27, 0x45, 0x45, 0x45, 0x39}},
    {'6', {0x3c, 0x4a, 0x49, 0x49, 0x30}}, {'7', {0x01, 0x71, 0x09, 0x05, 0x03}},
    {'8', {0x36, 0x49, 0x49, 0x49, 0x36}}, {'9', {0x06, 0x49, 0x49, 0x29, 0x1e}},
    {'.', {0x00, 0x60, 0x60, 0x00, 0x00}}, {',', {0x00, 0x50, 0x30, 0x00, 0x00}},
    {':', {0x00, 0x36, 0x36, 0x00, 0x00}}, {'-', {0x08, 0x08, 0x08, 0x08, 0x08}},
    {'/', {0x20, 0x10, 0x08, 0x04, 0x02}}, {'%', {0x23, 0x13, 0x08, 0x64, 0x62}},
    {'+', {0x08, 0x08, 0x3e, 0x08, 0x08}},
}};

/// Fills [left, right) x [low, high), metres along the label and above the platter.
void fill(ColorImage& image, double left, double right, double low, double high, Rgb color) {
  const auto column = [](double x) { return int(std::lround(x / kTexel_m)); };
  const auto row = [&](double y) { return image.height - int(std::lround(y / kTexel_m)); };
  for (int y = std::max(0, row(high)); y < std::min(image.height, row(low)); ++y)
    for (int x = column(left); x < column(right); ++x)
      image.at((x % image.width + image.width) % image.width, y) = color;
}

void print(ColorImage& image, const LabelLine& line) {
  const double dot = line.cap_height_m / kGlyphRows;
  double left = line.angle_rad * kRadius_m;
  for (const char character : line.text) {
    const Glyph glyph = glyph_of(character);
    for (int c = 0; c < kGlyphColumns; ++c)
      for (int r = 0; r < kGlyphRows; ++r)
        if ((glyph[std::size_t(c)] >> r & 1u) != 0) {
          const double low = line.baseline_m + (kGlyphRows - 1 - r) * dot;
          fill(image, left + c * dot, left + (c + 1) * dot, low, low + dot, kInk);
        }
    left += kGlyphAdvance * dot;
  }
}

ColorImage label() {
  const double around = kTurn * kRadius_m, height = SolidCylinder::height_m;
  ColorImage image(int(std::lround(around / kTexel_m)), int(std::lround(height / kTexel_m)), kTin);
  fill(image, 0.0, around, 0.012, 0.148, kPaper);
  for (const double y : {0.016, 0.138}) fill(image, 0.0, around, y, y + 0.006, kBand);
  for (const LabelLine& line : label_lines()) print(image, line);
  // Bars of 0.5 to 2 mm, all around.
  double x = 0.0;
  for (int i = 0; x + 0.002 < around; ++i) {
    const double width = 5e-4 * (1 + i * i % 4);
    fill(image, x, x + width, 0.026, 0.036, kInk);
    x += width + 5e-4 * (1 + i % 3);
  }
  return image;
}

}  // namespace

Glyph glyph_of(char character) {
  const auto* at = std::find_if(kGlyphs.begin(), kGlyphs.end(),
                                [&](const auto& known) { return known.first == character; });
  return at == kGlyphs.end() ? Glyph{} : at->second;
}

std::array<LabelLine, 7> label_lines() {
  constexpr double k3mm = 0.003;
  return {{{"TURNSCAN  3-D  SCANNER", 0.010, 0.120, 0.0},
           {"FILLED AND LABELLED ON A TURNTABLE", 0.005, 0.106, 0.0},
           {"THE FIVE BOXING WIZARDS JUMP QUICKLY. LOT 7Q4X-9ZK/05", k3mm, 0.096, 0.0},
           {"CONTENTS: WATER, SUGAR 12.5 %, SALT 0.3 %, LEMON +1 %", k3mm, 0.088, 1.0},
           {"KEEP DRY AND COOL, 4 - 18 DEG. USE BY 2027-11-30, 06:45", k3mm, 0.080, 2.5},
           {"SMALL PRINT OF 2 MM: JACKDAWS LOVE MY BIG SPHINX OF QUARTZ", 0.002, 0.072, 0.0},
           {"PRINT OF 1.5 MM: HOW VEXINGLY QUICK DAFT ZEBRAS JUMP 0123", 0.0015, 0.066, 0.0}}};
}

TriangleMesh make_labelled_cylinder(TriangleMesh cylinder) {
  cylinder.name = "labelled-cylinder";
  cylinder.colors.clear();
  auto texture = std::make_shared<MeshTexture>();
  texture->image = label();
  const auto height = float(SolidCylinder::height_m);
  for (const auto& t : cylinder.triangles) {
    std::array<Eigen::Vector2f, 3> corners;
    bool cap = false;
    float first = -1.0f;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3f& p = cylinder.vertices[t[k]];
      cap = cap || std::hypot(p.x(), p.z()) < 0.5f * float(kRadius_m);
      auto u = float(std::atan2(double(p.x()), double(p.z())) / kTurn);
      if (u < 0.0f) u += 1.0f;
      // Triangles across the front go on beyond the picture's edge.
      if (first >= 0.0f && u < first - 0.5f) u += 1.0f;
      if (first >= 0.0f && u > first + 0.5f) u -= 1.0f;
      if (first < 0.0f) first = u;
      corners[k] = {u, 1.0f - p.y() / height};
    }
    // Lid and base are of tin, as the border below the label.
    if (cap) corners.fill({0.5f, 0.99f});
    texture->corners.push_back(corners);
  }
  cylinder.texture = std::move(texture);
  return cylinder;
}

}  // namespace turnscan::objects
