#include "bench/texture/label_reading.hpp"

#include <array>
#include <cmath>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/simulator/objects/labelled_cylinder.hpp>

namespace turnscan::bench {

namespace {

using namespace turnscan::objects;

constexpr double kRadius_m = SolidCylinder::diameter_m / 2;
constexpr double kMinCosine = 0.70710678;
/// A character with a blank around it, so that a full stop is no block.
constexpr int kColumns = kGlyphColumns + 2, kRows = kGlyphRows + 2;
using Dots = Eigen::Matrix<double, kColumns * kRows, 1>;

Dots of_unit_length(Dots dots) {
  dots.array() -= dots.mean();
  const double length = dots.norm();
  return length > 1e-9 ? Dots(dots / length) : dots;
}

Dots template_of(char character) {
  const auto glyph = glyph_of(character);
  Dots dots = Dots::Constant(1.0);
  for (int c = 0; c < kGlyphColumns; ++c)
    for (int r = 0; r < kGlyphRows; ++r)
      if ((glyph[std::size_t(c)] >> r & 1u) != 0) dots[(r + 1) * kColumns + c + 1] = 0.0;
  return of_unit_length(dots);
}

class Reader {
 public:
  Reader(const ColorImage& picture, const CameraIntrinsics& camera, const Pose& T_camera_label)
      : picture_(picture), camera_(camera), T_(T_camera_label) {
    for (char c = '!'; c <= 'Z'; ++c)
      if (glyph_of(c) != decltype(glyph_of(c)){}) templates_.emplace_back(c, template_of(c));
  }

  bool faces(double angle, double y) const {
    const Vec3d normal(std::sin(angle), 0.0, std::cos(angle));
    const Vec3d p = T_ * Vec3d(kRadius_m * normal + y * Vec3d::UnitY());
    return -(T_.linear() * normal).dot(p.normalized()) > kMinCosine;
  }

  /// What stands there; left and base: of the character, metres along the label and above y = 0.
  char read(double left, double base, double dot) const {
    char best = ' ';
    double most = -1.0;
    for (int sx = -1; sx <= 1; ++sx)
      for (int sy = -1; sy <= 1; ++sy) {
        const Dots seen = dots_at(left + 0.5 * sx * dot, base + 0.5 * sy * dot, dot);
        for (const auto& [character, expected] : templates_) {
          const double match = seen.dot(expected);
          if (match > most) most = match, best = character;
        }
      }
    return best;
  }

 private:
  Dots dots_at(double left, double base, double dot) const {
    Dots dots;
    for (int r = 0; r < kRows; ++r)
      for (int c = 0; c < kColumns; ++c)
        dots[r * kColumns + c] = level(left + (c - 0.5) * dot, base + (kGlyphRows - r + 0.5) * dot);
    return of_unit_length(dots);
  }

  double level(double along, double y) const {
    const double angle = along / kRadius_m;
    const Vec3d p = T_ * Vec3d(kRadius_m * std::sin(angle), y, kRadius_m * std::cos(angle));
    const double u = p.x() / p.z() * camera_.fx + camera_.cx;
    const double v = p.y() / p.z() * camera_.fy + camera_.cy;
    const int x = int(std::floor(u)), row = int(std::floor(v));
    if (x < 0 || row < 0 || x + 1 >= picture_.width || row + 1 >= picture_.height) return 0.0;
    const double fu = u - x, fv = v - row;
    const auto grey = [&](int i, int j) { return double(picture_.at(i, j).g); };
    return (1 - fv) * ((1 - fu) * grey(x, row) + fu * grey(x + 1, row)) +
           fv * ((1 - fu) * grey(x, row + 1) + fu * grey(x + 1, row + 1));
  }

  const ColorImage& picture_;
  const CameraIntrinsics& camera_;
  const Pose& T_;
  std::vector<std::pair<char, Dots>> templates_;
};

}  // namespace

std::map<double, Reading> read_label(const ColorImage& picture, const CameraIntrinsics& camera,
                                     const Pose& T_camera_label) {
  const Reader reader(picture, camera, T_camera_label);
  std::map<double, Reading> out;
  for (const LabelLine& line : label_lines()) {
    const double dot = line.cap_height_m / kGlyphRows;
    for (std::size_t i = 0; i < line.text.size(); ++i) {
      const double left = line.angle_rad * kRadius_m + double(i) * kGlyphAdvance * dot;
      const double middle = left + 0.5 * kGlyphColumns * dot;
      if (line.text[i] == ' ' || !reader.faces(middle / kRadius_m, line.baseline_m)) continue;
      Reading& reading = out[line.cap_height_m];
      ++reading.all;
      reading.right += reader.read(left, line.baseline_m, dot) == line.text[i] ? 1 : 0;
    }
  }
  return out;
}

}  // namespace turnscan::bench
