#include <turnscan/reconstruction/options/finish_options.hpp>

namespace turnscan {

OptionTable describe(FinishOptions& o) {
  OptionTable table;
  table
      .choice(
          "holes", o.holes, {"smooth", "flat", "open"},
          "Surface that nothing measured: closed smoothly, closed as tightly as a soap film, or "
          "left open, the underside too. Needs the repair")
      .number("hole-size", o.hole_size_m, Quantity::kLength, {0.0, 1.0},
              "Longest side from which --holes flat and open apply; smaller holes are closed "
              "smoothly")
      .number("smooth", o.smooth_m, Quantity::kLength, {0.0, 0.02},
              "Smooth the mesh: waves of this length lose half of their height, shorter ones more; "
              "0 is off")
      .number("smallest-part", o.smallest_part_m, Quantity::kLength, {0.0, 10.0},
              "Drop parts of a mesh, not connected to the rest, whose longest side is shorter")
      .number("only-object", o.object, {1, 1000000},
              "Keep only the object of this number, the largest being 1; automatic: all");
  return table;
}

}  // namespace turnscan
