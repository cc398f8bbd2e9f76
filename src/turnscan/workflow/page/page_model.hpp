#pragma once

#include <string>
#include <turnscan/workflow/page/page_fields.hpp>

namespace turnscan::page {

/// JSON for web/viewer.js: vertices quantised to 16 bits a coordinate over the size of all objects
/// (a 65,000th of it), what is known of each, and triangles, as base64 of PackedMesh.
std::string model_json(const std::vector<PageObject>& objects, const std::vector<Field>& fields);

}  // namespace turnscan::page
