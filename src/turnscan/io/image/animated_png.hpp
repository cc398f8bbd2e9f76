#pragma once
// Combines several PNG images into an animation.

#include <span>
#include <string>
#include <turnscan/core/result.hpp>

namespace turnscan {

/// An animated PNG (PNG, third edition, W3C 2025: acTL, fcTL, fdAT) that loops forever, with each
/// image shown for milliseconds_each (1 to 65535). Programs without support for animations show the
/// first image. images: PNG files of the same size and kind, at least one; fails with kFormat if
/// they are not.
Result<std::string> animated_png(std::span<const std::string> images, int milliseconds_each);

}  // namespace turnscan
