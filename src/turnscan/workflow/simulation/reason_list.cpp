#include <turnscan/workflow/simulation/reason_list.hpp>

#include <fmt/format.h>

#include <turnscan/simulator/sampling/samples.hpp>

namespace turnscan::workflow {

std::string reason_list() {
  std::string out;
  for (int m = 0; m < kMissCount; ++m)
    out += fmt::format("{}{} {}", m == 0 ? "" : ", ", m, name_of(static_cast<Miss>(m)));
  return out;
}

}  // namespace turnscan::workflow
