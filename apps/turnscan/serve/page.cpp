#include "serve/page.hpp"

#include <fmt/format.h>

#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/sensors/scanner_file.hpp>
#include <turnscan/workflow/page/encoding.hpp>

namespace turnscan::serve {

namespace {

/// The content of the only element of this name.
std::string content_of(const std::string& html, const std::string& element) {
  const auto begin = html.find("<" + element + ">"), end = html.rfind("</" + element + ">");
  if (begin == std::string::npos || end == std::string::npos) return "";
  const auto first = begin + element.size() + 2;
  return html.substr(first, end - first);
}

}  // namespace

Page read_page() {
  Page page;
  const auto data = data_folder();
  if (!data) return page;
  page.html = read_file(*data / "page" / "serve.html").value_or("");
  // A GLB's pictures become blobs; the decoder of the growing surface is WebAssembly.
  page.policy = fmt::format(
      "default-src 'none'; script-src '{}' 'wasm-unsafe-eval'; style-src '{}'; img-src 'self' "
      "blob: data:; "
      "connect-src 'self' blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
      page::csp_hash(content_of(page.html, "script")),
      page::csp_hash(content_of(page.html, "style")));
  return page;
}

}  // namespace turnscan::serve
