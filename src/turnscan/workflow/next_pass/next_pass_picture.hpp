#pragma once

#include <turnscan/core/image.hpp>
#include <turnscan/workflow/next_pass/next_pass.hpp>

namespace turnscan {

/// Two pictures side by side from the sensor's position at the pass's first frame: the object as it
/// was, and in the first of the advised poses; unseen surface is magenta. Without a pose, only the
/// first picture. Fails as render_picture().
Result<ColorImage> next_pass_picture(const ObjectResult& object, const PassViews& pass,
                                     const NextPassAdvice& advice, const RunContext& context);

}  // namespace turnscan
