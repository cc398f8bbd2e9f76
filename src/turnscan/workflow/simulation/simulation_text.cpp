#include <turnscan/workflow/simulation/simulation_text.hpp>

#include <turnscan/workflow/text/text_table.hpp>

namespace turnscan {

namespace {

/// "12.3 % measured, 80.0 % nothing, ..."
template <class Tally>
std::string shares(const Tally& tally) {
  std::uint64_t all = 0;
  for (const std::uint64_t count : tally) all += count;
  std::string text;
  for (std::size_t m = 0; m < tally.size(); ++m) {
    if (tally[m] == 0 && m != 0) continue;
    text += fmt::format("{}{:.2f} % {}", text.empty() ? "" : ", ",
                        all > 0 ? 100.0 * double(tally[m]) / double(all) : 0.0,
                        m == 0 ? "measured" : name_of(static_cast<Miss>(m)));
  }
  return text;
}

}  // namespace

std::string simulation_text(const Simulation& simulation) {
  const VirtualPasses& scan = simulation.scan;
  workflow::TextTable table({0, 1});
  table.add({"scanner", "of its samples"});
  for (std::size_t k = 0; k < scan.header().sensors.size(); ++k)
    table.add({scan.header().sensors[k].model, shares(scan.tally(k))});
  return table.text() + fmt::format("{} frames in {:.1f} s\n", scan.frames().size(),
                                    simulation.prepare_s + simulation.record_s);
}

}  // namespace turnscan
