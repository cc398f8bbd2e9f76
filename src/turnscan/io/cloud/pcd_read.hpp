#pragma once
// Reader for the Point Cloud Library's format (pointclouds.org, The PCD file format, versions .5 to
// .7).

#include <string_view>
#include <turnscan/core/result.hpp>
#include <turnscan/io/cloud/cloud_io.hpp>

namespace turnscan::pcd {

bool looks_like_pcd(std::string_view bytes);

/// The result still contains points that are not finite.
Result<CloudFile> parse_pcd(std::string_view bytes);

}  // namespace turnscan::pcd
