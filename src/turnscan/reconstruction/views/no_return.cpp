#include <algorithm>
#include <cmath>
#include <optional>
#include <turnscan/reconstruction/views/no_return.hpp>

namespace turnscan::views {

namespace {

using Mask = Image<std::uint8_t>;

/// Share of the outermost pixels that show something other than the empty border.
constexpr double kMinOutside = 0.8;

/// Calls body(x, y) along a line of pixels inside the empty border.
template <class Body>
void along(const DepthView& view, int axis, int line, bool backwards, const Body& body) {
  const int length = (axis == 0 ? view.width : view.height) - 2;
  for (int i = 0; i < length; ++i) {
    const int at = 1 + (backwards ? length - 1 - i : i);
    axis == 0 ? body(at, line) : body(line, at);
  }
}

class NoReturn {
 public:
  explicit NoReturn(const DepthView& view) : view_(view), mask_(view.width, view.height, 0) {}

  bool surroundings_return() const {
    int all = 0, with = 0;
    const auto count = [&](int x, int y) {
      ++all;
      with += returned(x, y) ? 1 : 0;
    };
    for (const int row : {1, view_.height - 2}) along(view_, 0, row, false, count);
    for (const int column : {1, view_.width - 2}) along(view_, 1, column, false, count);
    return with >= kMinOutside * all;
  }

  Mask enclosed() {
    for (std::size_t i = 0; i < mask_.pixels.size(); ++i) mask_.pixels[i] = 1;
    for (const int axis : {0, 1}) {
      const int lines = (axis == 0 ? view_.height : view_.width) - 1;
      for (int line = 1; line < lines; ++line) {
        for (const bool backwards : {false, true}) clear_up_to_return(axis, line, backwards);
      }
    }
    for (int y = 0; y < view_.height; ++y) {
      for (int x = 0; x < view_.width; ++x)
        if (border(x, y) || returned(x, y)) mask_.at(x, y) = 0;
    }
    return opened();
  }

 private:
  bool border(int x, int y) const {
    return x == 0 || y == 0 || x + 1 == view_.width || y + 1 == view_.height;
  }
  bool returned(int x, int y) const {
    return view_.pixels[std::size_t(y) * std::size_t(view_.width) + std::size_t(x)] != 0;
  }

  void clear_up_to_return(int axis, int line, bool backwards) {
    bool met = false;
    along(view_, axis, line, backwards, [&](int x, int y) {
      met = met || returned(x, y);
      if (!met) mask_.at(x, y) = 0;
    });
  }

  /// The union of the squares of 3 x 3 pixels in the mask.
  Mask opened() const {
    Mask out(view_.width, view_.height, 0);
    bool any = false;
    for (int y = 1; y + 1 < view_.height; ++y) {
      for (int x = 1; x + 1 < view_.width; ++x) {
        bool whole = true;
        around(x, y, [&](int u, int v) { whole = whole && mask_.at(u, v) != 0; });
        if (whole) around(x, y, [&](int u, int v) { out.at(u, v) = 1; });
        any |= whole;
      }
    }
    return any ? out : Mask();
  }

  template <class Body>
  static void around(int x, int y, const Body& body) {
    for (int v = y - 1; v <= y + 1; ++v) {
      for (int u = x - 1; u <= x + 1; ++u) body(u, v);
    }
  }

  const DepthView& view_;
  Mask mask_;
};

constexpr float kRimStep_m = 0.05f;

constexpr float kBeyond_m = 1e9f;

/// Depth known for a pixel: a measurement, or infinity if it is empty in the relevant range; else
/// nullopt.
std::optional<float> depth_of(const DepthView& view, std::uint32_t word) {
  constexpr std::uint32_t kUnbounded = 65534;
  if ((word & 0xffffu) != 0) return float(word & 0xffffu) * view.unit_m + view.bias_m;
  if (word >> 17 << 1 == kUnbounded) return kBeyond_m;
  return std::nullopt;
}

}  // namespace

Image<std::uint8_t> enclosed_no_return(const DepthView& view) {
  if (view.parallel || view.width < 5 || view.height < 5) return {};
  NoReturn pixels(view);
  return pixels.surroundings_return() ? pixels.enclosed() : Mask();
}

std::vector<int> rim_widths(const DepthView& view) {
  std::vector<int> out;
  for (int y = 1; y + 1 < view.height; ++y) {
    std::optional<float> last;
    int without = 0;  // pixels since then
    for (int x = 1; x + 1 < view.width; ++x) {
      const std::uint32_t word =
          view.pixels[std::size_t(y) * std::size_t(view.width) + std::size_t(x)];
      without += word == 0 ? 1 : 0;
      const std::optional<float> depth = depth_of(view, word);
      if (!depth) continue;
      if (last && std::abs(*depth - *last) > kRimStep_m) out.push_back(without);
      last = depth;
      without = 0;
    }
  }
  return out;
}

}  // namespace turnscan::views
