#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <turnscan/simulator/noise/kinect_v2.hpp>
#include <turnscan/simulator/noise/noise.hpp>

namespace turnscan::kinect_v2 {

namespace {

using Planes = std::array<Plane, noise::kFrequencies>;

noise::Phasors at(Planes& re, Planes& im, std::size_t offset) {
  noise::Phasors p{};
  for (std::size_t f = 0; f < re.size(); ++f) {
    p.re[f] = re[f].data() + offset;
    p.im[f] = im[f].data() + offset;
  }
  return p;
}

template <class Planes>
void clear(Planes& planes, std::size_t size) {
  for (Plane& plane : planes) plane.assign(size, 0.0f);
}

void prepare(Workspace& work, Decoded& out, const Layout& layout) {
  for (Planes* planes : {&work.re, &work.im, &work.norm, &work.smooth_re, &work.smooth_im})
    clear(*planes, layout.size());
  work.half_path.assign(layout.size(), 0.0f);
  work.unlike.assign(layout.size(), 0.0f);
  out.layout = layout;
  out.z.assign(layout.size(), 0.0f);
  out.amplitude.assign(layout.size(), 0.0f);
  out.verdict.assign(layout.size(), noise::kDark);
}

void combine_row(const Raw& raw, std::size_t row, Workspace& work,
                 const noise::NoiseKernel& kernel) {
  std::array<const float*, 9> v{};
  for (std::size_t k = 0; k < v.size(); ++k) v[k] = raw.correlations[k].data() + row;
  std::array<float*, noise::kFrequencies> norm{};
  for (std::size_t f = 0; f < norm.size(); ++f) norm[f] = work.norm[f].data() + row;
  kernel.combine(raw.layout.width, v.data(), at(work.re, work.im, row), norm.data());
}

void decode_row(const Layout& layout, std::size_t row, const Rays& rays, noise::Gate gate,
                Workspace& work, Decoded& out, const noise::NoiseKernel& kernel) {
  std::array<const float*, noise::kFrequencies> norm{};
  for (std::size_t f = 0; f < norm.size(); ++f) norm[f] = work.norm[f].data() + row;
  const noise::Phasors smooth = at(work.smooth_re, work.smooth_im, row);
  kernel.smooth(layout.width, layout.stride(), at(work.re, work.im, row), norm.data(), smooth,
                work.unlike.data() + row);
  kernel.unwrap(layout.width, smooth, work.half_path.data() + row, out.amplitude.data() + row,
                out.verdict.data() + row);
  kernel.depth(layout.width, work.half_path.data() + row,
               {rays.z_per_range.data() + row, rays.along_emitter.data() + row, rays.emitter2},
               gate, out.z.data() + row, out.verdict.data() + row);
}

constexpr double kFilter = 1.0 / 3.0;  // nine nearly equal weights

double amplitude_of(const NoiseModel& m, double range_m, double incidence_rad, double albedo) {
  return m.tof_amplitude * albedo * std::max(std::cos(incidence_rad), 0.0) / (range_m * range_m);
}

double correlation_sigma_m(const NoiseModel& m, double amplitude) {
  double phases = 0.0;
  for (const double gain : {1.322581, 1.0, 1.612903}) {
    const double relative = m.tof_relative_noise * amplitude / gain;
    const double variance =
        m.tof_read_noise * m.tof_read_noise + m.tof_shot_noise * amplitude + relative * relative;
    phases += 2.0 / 3.0 * variance * gain * gain / (amplitude * amplitude);
  }
  constexpr double kMetresPerTurn = 299792458.0 / (2.0 * 216e6);  // of each phase
  return kFilter * kMetresPerTurn / (2.0 * std::numbers::pi) * std::sqrt(phases);
}

/// The filter averages dissimilar depths less: by the square root of two at this sigma (measured).
constexpr double kApart_m = 0.086;

/// The excess of a white surface over the noise of its correlations.
double grazing_after_filter_m(const NoiseModel& m, double z_m, double incidence_rad) {
  const double more = axial_sigma_m(m, z_m, incidence_rad) - axial_sigma_m(m, z_m, 0.0);
  if (!(more > 0.0)) return 0.0;
  const double frontal = correlation_sigma_m(m, amplitude_of(m, z_m, 0.0, kDefaultAlbedo));
  const double here = correlation_sigma_m(m, amplitude_of(m, z_m, incidence_rad, kDefaultAlbedo));
  const double wanted = frontal + more;
  return std::sqrt(std::max(wanted * wanted - here * here, 0.0));
}

}  // namespace

void Light::reset(const Layout& to) {
  layout = to;
  clear(re, to.size());
  clear(im, to.size());
  amplitude.assign(to.size(), 0.0f);
}

noise::Phasors Light::row(int y) { return at(re, im, layout.at(0, y)); }

void expose(Light& light, const NoiseModel& model, noise::Key key, std::uint32_t first_counter,
            std::uint32_t counter_stride, Raw& raw, const noise::NoiseKernel& kernel) {
  raw.layout = light.layout;
  clear(raw.correlations, light.layout.size());
  const noise::CorrelationNoise noise{float(model.tof_read_noise), float(model.tof_shot_noise),
                                      float(model.tof_relative_noise)};
  for (int y = 0; y < light.layout.height; ++y) {
    const std::size_t row = light.layout.at(0, y);
    std::array<float*, 9> v{};
    for (std::size_t k = 0; k < v.size(); ++k) v[k] = raw.correlations[k].data() + row;
    kernel.correlate(light.layout.width, light.row(y), light.amplitude.data() + row, key,
                     first_counter + std::uint32_t(y) * counter_stride, noise, v.data());
  }
}

void decode(const Raw& raw, const Rays& rays, noise::Gate gate, Workspace& work, Decoded& out,
            const noise::NoiseKernel& kernel) {
  const Layout& layout = raw.layout;
  prepare(work, out, layout);
  for (int y = 0; y < layout.height; ++y) combine_row(raw, layout.at(0, y), work, kernel);
  for (int y = 0; y < layout.height; ++y)
    decode_row(layout, layout.at(0, y), rays, gate, work, out, kernel);
  for (int y = 0; y < layout.height; ++y) {
    const std::size_t row = layout.at(0, y);
    kernel.edges(layout.width, layout.stride(), out.z.data() + row, out.amplitude.data() + row,
                 work.unlike.data() + row, out.verdict.data() + row);
  }
}

double grazing_sigma_m(const NoiseModel& m, double z_m, double incidence_rad) {
  const double after = grazing_after_filter_m(m, z_m, incidence_rad) / kFilter;
  if (after == 0.0) return 0.0;
  // after = before * sqrt(1 + (before / kApart_m)^2), solved for before.
  const double share = 2.0 * after / kApart_m;
  return kApart_m * std::sqrt(0.5 * (std::sqrt(1.0 + share * share) - 1.0));
}

double sigma_m(const NoiseModel& m, double range_m, double incidence_rad, double albedo) {
  const double amplitude = amplitude_of(m, range_m, incidence_rad, albedo);
  constexpr double kMin = 10.0 / 3.0;  // in each frequency, for the driver's sum of 10
  if (!(amplitude >= kMin)) return std::numeric_limits<double>::quiet_NaN();
  return std::hypot(correlation_sigma_m(m, amplitude),
                    grazing_after_filter_m(m, range_m, incidence_rad));
}

}  // namespace turnscan::kinect_v2
