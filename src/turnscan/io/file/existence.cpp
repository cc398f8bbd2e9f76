#include <turnscan/io/file/existence.hpp>

#include <system_error>

namespace turnscan::file {

namespace fs = std::filesystem;

Result<bool> is_there(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() != fs::file_type::none) return status.type() != fs::file_type::not_found;
  return fail_at(path.string(), ErrorCode::kIo, "it cannot be looked at ({}); check permissions",
                 error.message());
}

Result<> check_exists(const fs::path& path, std::string_view what) {
  TURNSCAN_ASSIGN(const bool there, file::is_there(path));
  if (there) return {};
  return fail_at(path.string(), ErrorCode::kNotFound, "there is no such {}; check the path", what);
}

}  // namespace turnscan::file
