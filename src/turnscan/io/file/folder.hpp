#pragma once
// A folder of this program in which it writes and deletes, held open: a name in it is reached from
// the folder's descriptor and never through a symbolic link, so that nothing outside is touched,
// whatever others do to names meanwhile.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <vector>

namespace turnscan::file {

/// `name` is a single component. Errors carry the path. All fail with kIo (the system's message)
/// and, where something has to be there, with kNotFound.
class Folder {
 public:
  /// Follows links to the folder itself: its user names it.
  static Result<Folder> open(const std::filesystem::path& path);
  /// A folder in this one. Fails with kNoPermission if it is a link or belongs to another user.
  Result<Folder> subfolder(const std::string& name) const;
  /// The same, created if there is none.
  Result<Folder> make_subfolder(const std::string& name) const;

  Folder(Folder&& other) noexcept;
  Folder& operator=(Folder&& other) noexcept;
  ~Folder();

  const std::filesystem::path& path() const { return path_; }  ///< for people
  int descriptor() const { return descriptor_; }
  /// A path that leads to this very folder while it is open, for what takes no descriptor.
  std::filesystem::path anchor() const;

  /// Succeeds if the folder belongs to this user or the superuser. Fails with kNoPermission.
  Result<> check_own() const;
  /// Whether there is something of this name, be it a link.
  bool has(const std::string& name) const;
  std::vector<std::string> names() const;
  /// As read_file() and write_file_atomically(). A link is not read; writing takes its place.
  Result<std::string> read(const std::string& name, std::uint64_t max_bytes = kMaxFileBytes) const;
  Result<> write(const std::string& name, std::string_view text,
                 Durability durability = Durability::kSynced) const;
  /// Removes a file, a link (not what it leads to), or a folder with all that is in it; succeeds if
  /// there is none.
  Result<> remove(const std::string& name) const;
  /// Renames; what had the name `to` has the name `from` afterwards. On failure both are as they
  /// were.
  Result<> exchange(const std::string& from, const std::string& to) const;

 private:
  Folder(int descriptor, std::filesystem::path path)
      : descriptor_(descriptor), path_(std::move(path)) {}
  int descriptor_;
  std::filesystem::path path_;
};

}  // namespace turnscan::file
