#pragma once

class QString;

namespace turnscan::studio {

/// Before the application object is made: the surface that VTK needs, high-DPI screens.
void prepare_application();
/// Where the settings are kept.
void name_application();

}  // namespace turnscan::studio
