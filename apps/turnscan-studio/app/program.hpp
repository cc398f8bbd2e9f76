#pragma once

class QString;

namespace turnscan::studio {

/// Call before the application object is created: sets the surface format that VTK needs, high-DPI
/// screens.
void prepare_application();
/// Sets the names under which settings are stored.
void name_application();

}  // namespace turnscan::studio
