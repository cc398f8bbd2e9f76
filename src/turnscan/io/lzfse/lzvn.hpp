#pragma once

#include <string_view>
#include <turnscan/io/lzfse/output.hpp>

namespace turnscan::lzfse {

/// Unpacks the payload of an LZVN block; false if it is damaged or does not fill the output.
bool unpack_lzvn(std::string_view payload, BlockOutput& output);

}  // namespace turnscan::lzfse
