#pragma once

#include <string>
#include <turnscan/reconstruction/pipeline.hpp>
#include <vector>

namespace turnscan::cli {

/// What was made, which parameters were used and why, and how long it took: a few tables.
std::string reconstruction_text(const Reconstruction& reconstruction);

/// Names the objects that are not watertight, or succeeds.
Result<> check_watertight(const Reconstruction& reconstruction);

/// Writes the meshes: all objects into one 3MF or GLB file, else one file per object, numbered when
/// there are several. Returns the names of the files.
Result<std::vector<std::string>> write_objects(const std::string& path,
                                               const Reconstruction& reconstruction);

}  // namespace turnscan::cli
