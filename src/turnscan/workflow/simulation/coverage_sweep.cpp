#include <turnscan/workflow/simulation/coverage_sweep.hpp>

#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/workflow/page/svg_plot.hpp>
#include <turnscan/workflow/text/text_table.hpp>

namespace turnscan {

namespace {

constexpr double kMostValues = 1000;

/// nullptr if there is none.
const OptionField* find_field(const std::vector<SceneTable>& tables, const std::string& name) {
  for (const SceneTable& table : tables)
    if (const OptionField* field = table.options.find(name)) return field;
  return nullptr;
}

std::string best_text(const SweepRange& range, const std::vector<SweptCoverage>& swept) {
  const SweptCoverage& best = best_of(swept);
  return fmt::format("{} = {} covers most: {:.1f} %", range.option,
                     format_quantity(best.value, range.quantity), 100.0 * best.covered);
}

}  // namespace

const SweptCoverage& best_of(const std::vector<SweptCoverage>& swept) {
  return *std::max_element(swept.begin(), swept.end(),
                           [](const auto& a, const auto& b) { return a.covered < b.covered; });
}

Result<SweepRange> parse_sweep_range(const std::string& text, SceneDescription scene) {
  const std::size_t equals = text.find('='), dots = text.find("..");
  std::size_t slash = dots == std::string::npos ? dots : text.find('/', dots);
  if (equals == std::string::npos || slash == std::string::npos || !(equals < dots))
    return fail(ErrorCode::kInvalidOption,
                "'{}' is not NAME=FROM..TO/STEP; write e.g. roll=-45deg..45deg/10deg", text);
  SweepRange range;
  range.option = text.substr(0, equals);
  const std::vector<SceneTable> tables = describe(scene);
  const OptionField* field = find_field(tables, range.option);
  if (field == nullptr || !field->range)
    return fail(ErrorCode::kInvalidOption,
                "the scene has no number '{}'; 'turnscan simulate --help-all' lists its "
                "options",
                range.option);
  range.quantity = field->quantity;
  // deg/s has a slash of its own.
  const auto ends_a_value = [&](std::size_t at) {
    return parse_quantity(std::string_view(text).substr(dots + 2, at - dots - 2), range.quantity)
        .has_value();
  };
  for (std::size_t next = slash; next != std::string::npos; next = text.find('/', next + 1)) {
    if (!ends_a_value(next)) continue;
    slash = next;
    break;
  }
  const auto read = [&](std::size_t begin, std::size_t end) {
    auto value = parse_quantity(std::string_view(text).substr(begin, end - begin), range.quantity);
    if (!value) value.error().message = range.option + ": " + value.error().message;
    return value;
  };
  TURNSCAN_ASSIGN(const double from, read(equals + 1, dots));
  TURNSCAN_ASSIGN(const double to, read(dots + 2, slash));
  TURNSCAN_ASSIGN(const double step, read(slash + 1, text.size()));
  // A last value that only rounding puts beyond the end is one of them.
  const double steps = std::floor((to - from) / step + 1e-9);
  if (!(step > 0.0) || !(steps >= 0.0) || steps >= kMostValues)
    return fail(ErrorCode::kInvalidOption,
                "{}: {} does not give 1 to {:.0f} values; give FROM <= TO and a STEP above 0",
                range.option, text.substr(equals + 1), kMostValues);
  for (int i = 0; i <= int(steps); ++i) {
    const double value = from + i * step;
    range.values.push_back(std::abs(value) < 1e-9 * step ? 0.0 : value);  // not 1e-15deg
  }
  return range;
}

Result<std::vector<SweptCoverage>> sweep_coverage(const SceneDescription& scene,
                                                  const SweepRange& range,
                                                  const CoverageMapOptions& options,
                                                  const RunContext& context) {
  context.begin_phase("read object", 0);
  TURNSCAN_ASSIGN(const TriangleMesh object, read_object(scene, context));
  std::vector<SweptCoverage> out;
  for (const double value : range.values) {
    SceneDescription varied = scene;
    const std::vector<SceneTable> tables = describe(varied);
    TURNSCAN_TRY(find_field(tables, range.option)->set(format_quantity(value, range.quantity)));
    TURNSCAN_ASSIGN(const Simulation simulation, prepare_simulation(varied, object, context));
    TURNSCAN_ASSIGN(const CoverageMap map, coverage_of(simulation, options, context));
    const auto share = [&](CoverageState state) {
      return map.state_m2[static_cast<std::size_t>(state)] / map.area_m2;
    };
    out.push_back({value, map.covered(), share(CoverageState::kThin), share(CoverageState::kMissed),
                   share(CoverageState::kUnreachable)});
  }
  return out;
}

std::string sweep_text(const SweepRange& range, const std::vector<SweptCoverage>& swept) {
  workflow::TextTable table({0});
  table.add({range.option, "covered", "of which thin", "missed", "unreachable"});
  const auto percent = [](double share) { return fmt::format("{:.1f} %", 100.0 * share); };
  for (const SweptCoverage& s : swept)
    table.add({format_quantity(s.value, range.quantity), percent(s.covered), percent(s.thin),
               percent(s.missed), percent(s.unreachable)});
  return table.text(0) + best_text(range, swept) + "\n";
}

std::string sweep_svg(const SweepRange& range, const std::vector<SweptCoverage>& swept) {
  page::Plot plot;
  plot.title = "Coverage over " + range.option;
  plot.description = best_text(range, swept);
  const std::string unit = range.quantity == Quantity::kAngle    ? " in deg"
                           : range.quantity == Quantity::kLength ? " in mm"
                                                                 : "";
  const double scale = range.quantity == Quantity::kAngle    ? 360.0 / kTurn
                       : range.quantity == Quantity::kLength ? 1e3
                                                             : 1.0;
  plot.x_label = range.option + unit + "; " + plot.description;
  plot.y_label = "Covered share of the surface in %";
  plot.series.emplace_back();
  for (const SweptCoverage& s : swept) {
    plot.x.push_back(scale * s.value);
    plot.series.front().y.push_back(100.0 * s.covered);
  }
  plot.marked = std::size_t(&best_of(swept) - swept.data());
  return page::svg_file(plot);
}

}  // namespace turnscan
