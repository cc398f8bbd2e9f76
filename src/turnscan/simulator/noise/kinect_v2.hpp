#pragma once
// Model of the Kinect v2 as a pipeline: from the light on its pixels over nine raw correlations per
// pixel to depth, as the open driver decodes them.

#include <array>
#include <cstddef>
#include <turnscan/sensors/noise_model.hpp>
#include <turnscan/simulator/noise/noise_kernel.hpp>
#include <vector>

namespace turnscan::kinect_v2 {

/// Planes of a part of the image, row by row, with a dark border of one pixel.
struct Layout {
  int width = 0, height = 0;  ///< without the border

  int stride() const { return width + 2; }
  std::size_t size() const { return std::size_t(stride()) * std::size_t(height + 2); }
  /// (0, 0) is the first pixel within the border.
  std::size_t at(int column, int row) const {
    return std::size_t(row + 1) * std::size_t(stride()) + std::size_t(column + 1);
  }
};

using Plane = std::vector<float>;

/// Sums of phasors over everything that a pixel sees, and of their magnitudes (both as at 16 MHz
/// before the modulation's contrast).
struct Light {
  Layout layout;
  std::array<Plane, noise::kFrequencies> re, im;
  Plane amplitude;

  /// Sets everything to dark.
  void reset(const Layout& to);
  noise::Phasors row(int y);
};

/// correlations[3 * f + k]: frequency f (80, 16, 120 MHz), phase step k (0, 120, 240 deg).
struct Raw {
  Layout layout;
  std::array<Plane, 9> correlations;
};

/// Directions of the lines of sight, planes of a layout; the border is not read.
struct Rays {
  Plane z_per_range;    ///< cosine between the line of sight and the optical axis
  Plane along_emitter;  ///< emitter's position along the line of sight, m
  float emitter2 = 0.0f;
};

struct Decoded {
  Layout layout;
  Plane z;  ///< metres; also for pixels that the verdict rejects, 0 if nothing was decoded
  std::vector<std::uint8_t> verdict;  ///< noise::Verdict
  Plane amplitude;
};

/// Temporary memory of decode().
struct Workspace {
  std::array<Plane, noise::kFrequencies> re, im, norm, smooth_re, smooth_im;
  Plane half_path, unlike;
};

/// Simulates the raw readings of the sensor. first_counter[y] is the counter of the first pixel of
/// row y; random numbers depend only on key and a pixel's counter.
void expose(Light& light, const NoiseModel& model, noise::Key key, std::uint32_t first_counter,
            std::uint32_t counter_stride, Raw& raw,
            const noise::NoiseKernel& kernel = noise::NoiseKernels::current());

/// Decodes them as the driver does: bilateral filter on the complex values, phase unwrapping of the
/// three frequencies, range gate and rejection of flying pixels.
void decode(const Raw& raw, const Rays& rays, noise::Gate gate, Workspace& work, Decoded& out,
            const noise::NoiseKernel& kernel = noise::NoiseKernels::current());

/// One sigma of the point that a pixel measures, along z and before the driver's filter: the excess
/// of a white surface at grazing incidence by axial-grazing over the noise of its correlations.
double grazing_sigma_m(const NoiseModel& model, double z_m, double incidence_rad);

/// One sigma of the depth of a flat patch, from the noise of the correlations (the phases' errors
/// sqrt(2/3) sigma / amplitude, averaged over the frequencies and over the filter's 3 x 3 pixels)
/// and of the points at grazing incidence. NaN if there is too little light for the driver.
double sigma_m(const NoiseModel& model, double range_m, double incidence_rad, double albedo);

}  // namespace turnscan::kinect_v2
