#include <turnscan/core/units.hpp>
#include <turnscan/simulator/noise.hpp>

namespace turnscan {

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

}  // namespace turnscan
