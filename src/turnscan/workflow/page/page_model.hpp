#pragma once

#include <string>
#include <turnscan/workflow/page/page_fields.hpp>

namespace turnscan::page {

/// JSON for web/viewer.js: vertices quantised to 16 bits per coordinate over the extent of all
/// objects (a 65,000th of it), the per-vertex fields, and triangles, as base64 of PackedMesh.
std::string model_json(const std::vector<PageObject>& objects, const std::vector<Field>& fields);

}  // namespace turnscan::page
