#pragma once
// Distribution of a surface's error, from the expected errors of its vertices.

#include <optional>
#include <vector>

namespace turnscan {

class ErrorShares {
 public:
  /// Adds a piece of the surface. expected_error_m: standard deviation, 0 or more; area_m2: its
  /// weight.
  void add(double expected_error_m, double area_m2);

  /// Share of the surface, 0 to 1, expected to be within this distance of the truth; 0 for an empty
  /// surface. The errors of simulated scans (bench/expected_error) have the tails of Student's t
  /// with five degrees of freedom, scaled to 0.683 within one expected error.
  double within(double distance_m) const;

  /// Its inverse, by bisection; nullopt if it is a metre or more, or there is no surface.
  std::optional<double> error_of(double share) const;

 private:
  struct Piece {
    double sigma_m, area_m2;
  };
  std::vector<Piece> pieces_;
};

}  // namespace turnscan
