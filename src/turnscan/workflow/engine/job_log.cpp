#include <turnscan/workflow/engine/job_log.hpp>

#include <fmt/format.h>
namespace turnscan::engine {

std::string last_line_of(const file::Folder& folder, const std::string& log) {
  const auto text = folder.read(log, std::uint64_t(64) << 20);
  const auto end = text ? text->find_last_not_of("\r\n\t ") : std::string::npos;
  if (end == std::string::npos)
    return fmt::format("it left no result; see {}", (folder.path() / log).string());
  const auto begin = text->rfind('\n', end);
  const std::size_t from = begin == std::string::npos ? 0 : begin + 1;
  return text->substr(from, end + 1 - from);
}

}  // namespace turnscan::engine
