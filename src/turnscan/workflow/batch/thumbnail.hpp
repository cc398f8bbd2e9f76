#pragma once

#include <filesystem>

namespace turnscan::batch {

/// Draws what a task has made, if that has a shape, as thumbnail.png beside it. Nobody's result
/// depends on it: what cannot be drawn is left out.
void draw_thumbnail(const std::filesystem::path& result);

}  // namespace turnscan::batch
