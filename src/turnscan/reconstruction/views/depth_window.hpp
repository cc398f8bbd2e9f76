#pragma once
// Packs the depths of a window into a view.

#include <turnscan/core/image.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan::views {

/// Raw depths of a window; unknown ones are kNoReturn, those only known to be empty kOutsideCrop.
using RawWindow = Image<std::uint16_t>;

inline bool measured(std::uint16_t raw) { return raw != kNoReturn && raw != kOutsideCrop; }

/// Fills the view's pixels from a window.
void pack_window(const RawWindow& raw, double edge_step_m, DepthView& view);

void set_pose(DepthView& view, const Pose& T_table_view);

}  // namespace turnscan::views
