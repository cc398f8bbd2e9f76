#include <turnscan/reconstruction/options/volumetric_options.hpp>

namespace turnscan {

OptionTable describe(VolumetricOptions& o) {
  OptionTable table;
  table
      .number("truncation", o.truncation_m, Quantity::kLength, {1e-5, 1.0},
              "Volumetric: truncation distance, within which a measurement counts along its ray; "
              "automatic: from the noise, or from how far frames see past what others measured")
      .flag("fit", o.fit, "Volumetric: move the vertices onto the frames' measurements")
      .number("fit-reach", o.fit_reach_m, Quantity::kLength, {1e-5, 0.1},
              "Volumetric: measurements farther from a vertex, across its normal, do not count in "
              "the fit; automatic: from the spacing")
      .number("fit-iterations", o.fit_iterations, {1, 20}, "Volumetric: steps of the fit")
      .flag("sharpen", o.sharpen,
            "Volumetric: if the noise shows that the sensor averages over neighbouring pixels, "
            "undo its effect on edges and thin parts")
      .flag("mark-invented", o.mark_invented,
            "Volumetric: paint unmeasured surface magenta, the rest in its colour or grey");
  return table;
}

}  // namespace turnscan
