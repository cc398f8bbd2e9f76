#pragma once
// Gaussian noise and a caricature of mixed pixels (private to the simulator).

#include <turnscan/simulator/noise.hpp>
#include <turnscan/simulator/samples.hpp>

namespace turnscan {

/// Of the silhouette's pixels that count the share mixed_pixels, chosen at random, is moved
/// backwards by U(0, min(mixed_reach, step to the deepest of the four neighbours)); then noise of
/// sigma is added to all. A silhouette is where a neighbour sees nothing or something farther by
/// more than step_m; two neighbours on the platter never make one.
void measure_simply(const SampleGrid& exact, const NoiseOptions& options, double step_m,
                    std::uint64_t seed, std::uint32_t scanner, std::uint32_t frame,
                    std::vector<float>& z);

}  // namespace turnscan
