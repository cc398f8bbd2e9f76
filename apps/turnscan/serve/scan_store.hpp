#pragma once
// Scans on disk. Each is a folder FOLDER/ID with the folder `recording` and what was made of it:
// mesh.glb, mesh.3mf, mesh.stl, mesh.ply, report.json, report.html and advice.png. All that is
// known of a scan is read from these files, so that a server that starts again knows as much as
// before.

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/io/file/folder.hpp>

namespace turnscan::serve {

using Json = nlohmann::ordered_json;

/// A result open for reading; nobody else's rename or removal changes what is read.
class ResultFile {
 public:
  ResultFile(int descriptor, std::uint64_t bytes) : descriptor_(descriptor), bytes_(bytes) {}
  ~ResultFile();
  ResultFile(const ResultFile&) = delete;
  ResultFile& operator=(const ResultFile&) = delete;

  std::uint64_t bytes() const { return bytes_; }
  /// Up to `most` bytes from a position; empty on failure.
  std::string read(std::uint64_t from, std::size_t most) const;

 private:
  int descriptor_;
  std::uint64_t bytes_;
};

/// Media type of a result; empty: no such file is given out.
std::string media_type(const std::string& name);

/// Names from outside are compared with those that are there, and never become part of a path
/// before. All fail with kNotFound for an id without a scan.
class ScanStore {
 public:
  /// Creates the folder if there is none. Fails with kIo and kNoPermission. Once the context is
  /// cancelled, what is read below stops.
  static Result<ScanStore> open(const std::filesystem::path& folder, const RunContext& context);

  /// A new folder, named after the time (UTC). Fails with kIo.
  Result<std::string> create() const;
  /// Removes a folder that nothing was written to.
  void remove_if_empty(const std::string& id) const;
  /// Deletes a scan with all that was made of it. Fails with kIo.
  Result<> remove(const std::string& id) const;

  /// {id, state} of each, the newest first. state: "unfinished" (its writer was ended; can be gone
  /// on with), "recorded", "done" (judged, with a mesh), "damaged".
  Json list() const;
  /// The same with device, date, frames, bytes and files.
  Result<Json> describe(const std::string& id) const;
  /// {objects: [{name, verdict}], next_pass}. Fails with kMissingData before there is a mesh.
  Result<Json> verdict(const std::string& id) const;
  Result<std::shared_ptr<const ResultFile>> file(const std::string& id,
                                                 const std::string& name) const;
  /// {files: [{name, bytes}]} of the recording; name: "frames.csv", "depth/000000.png".
  Result<Json> recording(const std::string& id) const;
  /// folder: empty for the recording's own.
  Result<std::shared_ptr<const ResultFile>> recorded(const std::string& id,
                                                     const std::string& folder,
                                                     const std::string& name) const;
  Result<std::filesystem::path> folder(const std::string& id) const;

  const std::filesystem::path& root() const { return root_->path(); }

 private:
  ScanStore(file::Folder root, const RunContext& context)
      : root_(std::make_shared<const file::Folder>(std::move(root))), context_(context) {}
  Result<file::Folder> scan(const std::string& id) const;

  std::shared_ptr<const file::Folder> root_;
  RunContext context_;
};

}  // namespace turnscan::serve
