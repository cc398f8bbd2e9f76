#pragma once
// What a laser line scanner's camera sees of one sample: the image of the line across its own
// direction, and where the peak finder says it is. Pixel u = f * (b - x) / z shows a point at depth
// z and x metres beside the middle of the line, towards the camera at distance b.

#include <cstdint>
#include <optional>
#include <span>
#include <turnscan/core/pose.hpp>
#include <turnscan/sensors/noise_model.hpp>
#include <vector>

namespace turnscan {

/// One strip of the line's width, as the surface sends it back.
struct LineSpot {
  double beside_m;  ///< from the middle of the line, towards the camera
  double z_m;
  double light;  ///< electrons in a pixel that this light fills
  double width_m;
};

struct LinePeak {
  double position_px;
  double height;
};

/// Places of the strips across the line: a speckle grain apart (at most 64, at least 9), out to
/// three sigma. One at 0 for a line without width.
std::vector<double> line_strips_m(const NoiseModel& model);

/// Relative light of a strip (beside_m from the middle): 1 in the middle.
double line_profile(const NoiseModel& model, double beside_m);

/// Size of a speckle grain on the surface: wavelength / (2 aperture) (Goodman 2007); 0 without.
double speckle_grain_m(const NoiseModel& model);

/// Factor by which speckle changes the light of a point of the surface (its own frame), of mean 1
/// and standard deviation line_contrast. Frozen on the surface: the same as long as the point stays
/// within its grain and the direction to the camera within the angle of the aperture.
double speckle_factor(const NoiseModel& model, std::uint64_t seed, const Vec3d& p_body,
                      const Vec3d& to_camera_body);

/// The strongest peak of a column: of the runs of pixels about a top that reaches threshold, out to
/// a twentieth of its height but not below floor, the one with the most light. Its place is the
/// centre of gravity of what is above that foot (Fisher and Naidu 1996).
std::optional<LinePeak> find_peak(std::span<const float> electrons, double threshold,
                                  double floor = 0.0);

/// The measured depth; none when there is no peak. Electrons are drawn from key.
std::optional<double> measure_line(const NoiseModel& model, double focal_baseline,
                                   std::span<const LineSpot> spots, std::uint64_t key);

/// One sigma of the depth of a flat patch: speckle (the variance of the centre of gravity of a
/// Gaussian line of grains: contrast^2 * grain * width / (4 sqrt(pi)), width one sigma) and the
/// noise of the electrons. NaN where the peak stays under the threshold.
double laser_line_sigma_m(const NoiseModel& model, double focal_baseline, double z_m,
                          double incidence_rad, double albedo);

/// Electrons that a pixel filled by the middle of the line gets.
double line_light(const NoiseModel& model, double z_m, double incidence_rad, double albedo);

}  // namespace turnscan
