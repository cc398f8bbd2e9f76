#pragma once
// The page for a person beside the turntable, as web/ bundled it into one file.

#include <string>

namespace turnscan::serve {

struct Page {
  std::string html;    ///< empty: it was not built
  std::string policy;  ///< content security policy: its own script and style, and this server
};

Page read_page();

}  // namespace turnscan::serve
