#include <turnscan/core/units.hpp>
#include <turnscan/io/import/importers_common.hpp>

namespace turnscan::importers {

namespace {

bool asks_for_turntable(const ImportOptions& o) {
  return !o.turntable_axis.empty() || !o.turntable_center.empty() || o.turntable_radius_m ||
         o.platter_height_m || o.speed_rad_s;
}

/// Axis and centre as stated, or from the data set.
Result<TurntableInfo> stated_turntable(const ImportOptions& options,
                                       const std::optional<TurntableInfo>& known) {
  if (!known && (options.turntable_axis.empty() || options.turntable_center.empty()))
    return fail(ErrorCode::kInvalidOption,
                "the data set does not say where the turntable is; with turntable-radius, "
                "platter-height or speed give turntable-axis and turntable-center too");
  TurntableInfo table = known.value_or(TurntableInfo{});
  if (!options.turntable_axis.empty()) {
    TURNSCAN_ASSIGN(table.axis, parse_direction("turntable-axis", options.turntable_axis));
  }
  if (!options.turntable_center.empty()) {
    TURNSCAN_ASSIGN(table.center_m, parse_position("turntable-center", options.turntable_center));
  }
  if (options.turntable_radius_m) table.radius_m = options.turntable_radius_m;
  if (options.speed_rad_s)
    table.speed_rad_s = options.clockwise ? -*options.speed_rad_s : *options.speed_rad_s;
  return table;
}

}  // namespace

Result<> apply_turntable_options(const ImportOptions& options, bool on_platter,
                                 SequenceHeader& header) {
  if (asks_for_turntable(options)) {
    TURNSCAN_ASSIGN(header.turntable, stated_turntable(options, header.turntable));
  }
  if (!header.turntable) return {};
  TurntableInfo& table = *header.turntable;
  if (options.platter_height_m) {
    table.center_m += *options.platter_height_m * table.axis;
    add_note(header, fmt::format("the platter's surface was put {} above the given point of the "
                                 "axis",
                                 format_quantity(*options.platter_height_m, Quantity::kLength)));
  } else if (!on_platter && options.turntable_center.empty()) {
    add_note(header,
             "the turntable's centre is a point of the axis whose height above the platter is not "
             "known: a crop above the platter and a closed base need it; import again with "
             "--platter-height");
  }
  return {};
}

}  // namespace turnscan::importers
