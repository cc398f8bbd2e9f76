#pragma once

#include <filesystem>

namespace turnscan::batch {

/// Draws the result of a task, if it has a shape, as thumbnail.png next to it. No result depends on
/// it: errors are ignored.
void draw_thumbnail(const std::filesystem::path& result);

}  // namespace turnscan::batch
