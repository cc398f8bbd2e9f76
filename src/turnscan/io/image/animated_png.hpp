#pragma once
// Several PNG images as one that moves.

#include <span>
#include <string>
#include <turnscan/core/result.hpp>

namespace turnscan {

/// An animated PNG (PNG, third edition, W3C 2025: acTL, fcTL, fdAT) that repeats for ever, each
/// image shown for milliseconds_each (1 to 65535). Programs that know no animation show the first.
/// images: PNG files of one size and kind, one at least; fails with kFormat when they are not.
Result<std::string> animated_png(std::span<const std::string> images, int milliseconds_each);

}  // namespace turnscan
