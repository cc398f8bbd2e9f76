#include <algorithm>
#include <cmath>
#include <limits>
#include <turnscan/core/units.hpp>
#include <turnscan/simulator/noise/noise.hpp>
#include <turnscan/simulator/noise/noise_apply.hpp>

namespace turnscan {

namespace {

/// Linear light of a colour byte (sRGB, IEC 61966-2-1).
double linear(std::uint8_t value) {
  const double v = value / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

double luminance(Rgb c) {
  return 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b);
}

Result<> check(const NoiseOptions& o) {
  if (!(o.sigma_m >= 0.0 && o.sigma_m <= 1.0))
    return fail(ErrorCode::kInvalidOption, "noise: sigma = {} m is outside 0 to 1 m", o.sigma_m);
  if (!(o.mixed_pixels >= 0.0 && o.mixed_pixels <= 1.0))
    return fail(ErrorCode::kInvalidOption, "mixed-pixels = {} is outside 0 to 1", o.mixed_pixels);
  if (!(o.mixed_reach_m >= 0.0 && o.mixed_reach_m <= 10.0))
    return fail(ErrorCode::kInvalidOption, "mixed-reach = {} m is outside 0 to 10 m",
                o.mixed_reach_m);
  if (o.window_px < 1 || o.window_px > kMaxNoiseWindow_px)
    return fail(ErrorCode::kInvalidOption, "noise-window = {} is outside 1 to {}", o.window_px,
                kMaxNoiseWindow_px);
  if (!(o.edge_fattening_px >= 0.0 && o.edge_fattening_px <= kMaxFattening_px))
    return fail(ErrorCode::kInvalidOption, "edge-fattening = {} is outside 0 to {}",
                o.edge_fattening_px, kMaxFattening_px);
  if (!(std::abs(o.wiggling_m) <= 1.0))
    return fail(ErrorCode::kInvalidOption, "wiggling = {} m is outside -1 to 1 m", o.wiggling_m);
  if (!(o.wiggling_period_m > 0.0))
    return fail(ErrorCode::kInvalidOption, "wiggling-period = {} m is not positive",
                o.wiggling_period_m);
  return {};
}

Result<> check_physics(const ScannerModel& model) {
  const NoiseModel& n = model.noise;
  if (n.physics == SensorPhysics::kNone)
    return fail(ErrorCode::kInvalidOption,
                "noise = physics: scanner {} has none; use noise = model, or set physics in its "
                "file",
                model.name);
  if (n.physics == SensorPhysics::kKinectV2) {
    if (model.kind == ScannerKind::kMatrix) return {};
    return fail(ErrorCode::kInvalidOption,
                "noise = physics: scanner {} is a line, kinect-v2 is for cameras", model.name);
  }
  const double fields[] = {n.line_width_m, n.line_focal_px, n.line_exposure};
  if (model.kind != ScannerKind::kLine || !(focal_baseline(model) > 0.0) ||
      std::any_of(std::begin(fields), std::end(fields), [](double v) { return !(v > 0.0); }))
    return fail(ErrorCode::kInvalidOption,
                "noise = physics: scanner {} must be a line with its receiver beside the sheet of "
                "light, and line-width, line-focal and line-exposure above 0",
                model.name);
  return {};
}

}  // namespace

Result<NoiseOptions> parse_noise_options(std::string_view text) {
  constexpr std::string_view kGaussian = "gaussian:";
  NoiseOptions options;
  if (text == "none") return options;
  if (text == "model" || text == "physics") {
    options.kind = text == "model" ? NoiseKind::kModel : NoiseKind::kPhysics;
    return options;
  }
  if (!text.starts_with(kGaussian))
    return fail(ErrorCode::kInvalidOption,
                "noise = {} is not known; write none, gaussian:SIGMA (e.g. gaussian:1.5mm), model "
                "or physics",
                text);
  const auto sigma = parse_quantity(text.substr(kGaussian.size()), Quantity::kLength);
  if (!sigma) return fail(ErrorCode::kInvalidOption, "noise: {}", sigma.error().message);
  if (!(*sigma >= 0.0 && *sigma <= 1.0))
    return fail(ErrorCode::kInvalidOption, "noise = {} is outside gaussian:0mm to gaussian:1000mm",
                text);
  options.kind = NoiseKind::kGaussian;
  options.sigma_m = *sigma;
  return options;
}

std::vector<float> triangle_albedos(const TriangleMesh& mesh) {
  std::vector<float> albedos;
  if (mesh.colors.size() != mesh.vertices.size()) return albedos;
  albedos.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    albedos.push_back(
        static_cast<float>((luminance(mesh.colors[t[0]]) + luminance(mesh.colors[t[1]]) +
                            luminance(mesh.colors[t[2]])) /
                           3.0));
  return albedos;
}

double focal_baseline(const ScannerModel& model) {
  if (model.kind == ScannerKind::kLine)
    return model.noise.line_focal_px * std::abs(model.receiver_m.x());
  return model.camera.fx * model.emitter_m.norm();
}

struct SensorNoise::Impl {
  noise::Setup setup;
};

SensorNoise::SensorNoise(std::unique_ptr<const Impl> impl) : impl_(std::move(impl)) {}
SensorNoise::SensorNoise(SensorNoise&&) noexcept = default;
SensorNoise& SensorNoise::operator=(SensorNoise&&) noexcept = default;
SensorNoise::~SensorNoise() = default;

Result<SensorNoise> SensorNoise::create(const ScannerModel& model, const NoiseOptions& options,
                                        std::uint64_t seed, std::uint32_t scanner_index) {
  TURNSCAN_TRY(check(options));
  TURNSCAN_TRY(model.check());
  NoiseModel copy = model.noise;
  TURNSCAN_TRY(describe(copy).check());
  if (options.kind == NoiseKind::kPhysics) TURNSCAN_TRY(check_physics(model));
  return SensorNoise(std::make_unique<const Impl>(
      Impl{{model, options, seed, scanner_index, focal_baseline(model), RayTable(model.camera)}}));
}

void SensorNoise::apply(const SensorView& view, const SampleGrid& exact, std::uint32_t frame,
                        MeasuredGrid& measured, bool with_sigma) const {
  const noise::Setup& setup = impl_->setup;
  measured.rect = exact.rect;
  measured.z.assign(exact.size(), 0.0f);
  measured.miss.assign(exact.miss.begin(), exact.miss.end());
  measured.sigma_m.clear();
  noise::Job job{setup, view, exact, frame, measured};
  switch (setup.options.kind) {
    case NoiseKind::kNone:
    case NoiseKind::kGaussian:
      noise::apply_gaussian(job);
      break;
    case NoiseKind::kModel:
      noise::apply_formulae(job);
      break;
    case NoiseKind::kPhysics:
      if (setup.model.noise.physics == SensorPhysics::kKinectV2)
        noise::apply_time_of_flight(job);
      else
        noise::apply_laser_line(job);
      break;
  }
  const bool phases = setup.options.kind == NoiseKind::kPhysics &&
                      setup.model.noise.physics == SensorPhysics::kKinectV2;
  if (!view.moments.empty() && !phases) noise::blur(job);
  if (setup.options.edge_fattening_px > 0.0 && noise::matches_patterns(setup.model))
    noise::fatten_edges(job);
  noise::add_systematic(job);
  if (with_sigma) noise::predict(job);
}

double SensorNoise::predicted_sigma_m(double z_m, double incidence_rad, double albedo) const {
  return noise::predicted_sigma_m(impl_->setup, z_m, incidence_rad, albedo);
}

}  // namespace turnscan
