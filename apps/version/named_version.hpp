#pragma once

#include <string>

namespace turnscan {

/// Tag and revision that the program was built from, e.g. "v0.1.0, 33e5837c"; empty: not known.
extern const char* const kRevision;

/// Of the program, for people: "0.1.0 (33e5837c)". Files have version().
std::string named_version();

}  // namespace turnscan
