#pragma once
// Report pages of reconstructions.

#include <string>
#include <turnscan/reconstruction/result.hpp>
#include <turnscan/workflow/page/page.hpp>
#include <vector>

namespace turnscan {

/// The meshes of a reconstruction with their per-vertex quantities.
std::vector<PageObject> page_objects(const Reconstruction& reconstruction);

/// "dir/doll.html" -> "doll".
std::string page_title(const std::string& path);

/// Sorts the file names given for reports into the JSON file and the page, by extension; .html and
/// .htm are pages. Fails with kInvalidOption if there are two of a kind.
struct ReportFiles {
  std::string json, page;
};
Result<ReportFiles> sort_report_files(const std::vector<std::string>& names);

/// Succeeds if both files can be written (empty: not requested). Fails as check_output_file().
Result<> check_report_files(const ReportFiles& files);

/// Writes make_page() to a file. Fails as make_page() and writing do.
Result<ReportPage> write_page(const std::string& path, const PageInput& input,
                              const RunContext& context);

}  // namespace turnscan
