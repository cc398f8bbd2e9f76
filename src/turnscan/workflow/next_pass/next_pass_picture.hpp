#pragma once

#include <turnscan/core/image.hpp>
#include <turnscan/workflow/next_pass/next_pass.hpp>

namespace turnscan {

/// Two pictures side by side from where the sensor stood at the pass's first frame: how the object
/// lay, and how it lies in the first of the advised poses; what no view saw is magenta. Without a
/// pose the first alone. Fails as render_picture().
Result<ColorImage> next_pass_picture(const ObjectResult& object, const PassViews& pass,
                                     const NextPassAdvice& advice, const RunContext& context);

}  // namespace turnscan
