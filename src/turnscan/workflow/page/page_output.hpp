#pragma once
// Pages of reconstructions.

#include <string>
#include <turnscan/reconstruction/result.hpp>
#include <turnscan/workflow/page/page.hpp>
#include <vector>

namespace turnscan {

/// The meshes of a reconstruction with what is known of their vertices.
std::vector<PageObject> page_objects(const Reconstruction& reconstruction);

/// "dir/doll.html" -> "doll".
std::string page_title(const std::string& path);

/// Which of the names that were given for reports is the JSON file and which the page: by their
/// endings, .html and .htm being a page. Fails with kInvalidOption when there are two of a kind.
struct ReportFiles {
  std::string json, page;
};
Result<ReportFiles> sort_report_files(const std::vector<std::string>& names);

/// Succeeds when both can be written there (empty: is not). Fails as check_output_file().
Result<> check_report_files(const ReportFiles& files);

/// make_page() into a file. Fails as both do.
Result<ReportPage> write_page(const std::string& path, const PageInput& input,
                              const RunContext& context);

}  // namespace turnscan
