#include "serve/scan_store.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <turnscan/core/utc_time.hpp>
#include <turnscan/recording/recording.hpp>

namespace turnscan::serve {

namespace {

namespace fs = std::filesystem;

constexpr const char* kRecording = "recording";
constexpr const char* kReport = "report.json";

/// As we make them, so that no name with a dot, slash or control character is ever looked for.
bool is_id(const std::string& text) {
  return !text.empty() && text.size() <= 64 &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) {
           return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || c == '-';
         });
}

std::uint64_t bytes_below(const fs::path& folder) {
  std::uint64_t bytes = 0;
  std::error_code error;
  for (fs::recursive_directory_iterator it(folder, error), end; it != end && !error;
       it.increment(error))
    if (it->is_regular_file(error)) bytes += it->file_size(error);
  return bytes;
}

std::string id_of_now() {
  std::string id;
  for (const char c : utc_text(utc_now_s())) {
    if (c >= '0' && c <= '9') id += c;
    if (c == 'T') id += '-';
  }
  return id;
}

std::string state_of(const file::Folder& scan, const Result<Recording>& recording) {
  if (!recording) return "damaged";
  if (!recording->complete()) return "unfinished";
  return scan.has(kReport) ? "done" : "recorded";
}

/// The report without its numbers of each vertex, which are most of it.
Json read_report(const std::string& text) {
  const auto keep = [](int, Json::parse_event_t event, Json& value) {
    return event != Json::parse_event_t::key ||
           (value != "expected_error_m" && value != "seen_by" && value != "invented");
  };
  Json report = Json::parse(text, keep, false);
  if (report.is_object() && report.contains("reconstruction") &&
      report["reconstruction"].is_object()) {
    Json inner = report["reconstruction"];
    inner["next_pass"] = report.value("next_pass", Json());
    return inner;
  }
  return report;
}

tl::unexpected<Error> no_file() { return fail(ErrorCode::kNotFound, "there is no such file"); }

/// A single component: what is opened by it lies in the folder itself.
bool is_name(const std::string& name) {
  return !name.empty() && name != "." && name != ".." &&
         name.find_first_of(std::string_view("/\0", 2)) == std::string::npos;
}

Result<std::shared_ptr<const ResultFile>> opened(const file::Folder& folder,
                                                 const std::string& name) {
  if (!is_name(name)) return no_file();
  const int descriptor =
      openat(folder.descriptor(), name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  struct stat status {};
  if (descriptor < 0) return no_file();
  if (fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
    close(descriptor);
    return no_file();
  }
  return std::make_shared<const ResultFile>(descriptor, std::uint64_t(status.st_size));
}

/// Bytes of a regular file; nullopt: it is none.
std::optional<std::uint64_t> bytes_of(const file::Folder& folder, const std::string& name) {
  struct stat status {};
  if (fstatat(folder.descriptor(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0 ||
      !S_ISREG(status.st_mode))
    return std::nullopt;
  return std::uint64_t(status.st_size);
}

void list_files(const file::Folder& folder, const std::string& before, Json& files) {
  std::vector<std::string> names = folder.names();
  std::sort(names.begin(), names.end());
  for (const std::string& name : names)
    if (const auto bytes = bytes_of(folder, name))
      files.push_back({{"name", before + name}, {"bytes", *bytes}});
}

}  // namespace

ResultFile::~ResultFile() { close(descriptor_); }

std::string ResultFile::read(std::uint64_t from, std::size_t most) const {
  std::string bytes(most, '\0');
  const ssize_t got = pread(descriptor_, bytes.data(), most, static_cast<off_t>(from));
  bytes.resize(got > 0 ? std::size_t(got) : 0);
  return bytes;
}

std::string media_type(const std::string& name) {
  static const std::map<std::string, std::string> kTypes{
      {".glb", "model/gltf-binary"},        {".3mf", "model/3mf"},         {".stl", "model/stl"},
      {".ply", "application/x-ply"},        {".json", "application/json"}, {".png", "image/png"},
      {".html", "text/html; charset=utf-8"}};
  const auto found = kTypes.find(fs::path(name).extension().string());
  return found == kTypes.end() ? "" : found->second;
}

Result<ScanStore> ScanStore::open(const fs::path& folder, const RunContext& context) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    return fail_at(folder.string(), ErrorCode::kIo, "cannot be created ({}); name another folder",
                   error.message());
  TURNSCAN_ASSIGN(file::Folder root, file::Folder::open(fs::absolute(folder)));
  TURNSCAN_TRY(root.check_own());
  return ScanStore(std::move(root), context);
}

Result<std::string> ScanStore::create() const {
  const std::string now = id_of_now();
  std::string id = now;
  for (int i = 2; root_->has(id); ++i) id = fmt::format("{}-{}", now, i);
  TURNSCAN_TRY(root_->make_subfolder(id));
  return id;
}

void ScanStore::remove_if_empty(const std::string& id) const {
  const auto own = scan(id);
  std::error_code ignored;
  if (own) fs::remove(own->path(), ignored);
}

Result<> ScanStore::remove(const std::string& id) const {
  TURNSCAN_TRY(scan(id));
  return root_->remove(id);
}

Result<file::Folder> ScanStore::scan(const std::string& id) const {
  if (is_id(id))
    if (auto found = root_->subfolder(id)) return found;
  return fail(ErrorCode::kNotFound, "there is no scan of that id");
}

Result<fs::path> ScanStore::folder(const std::string& id) const {
  TURNSCAN_ASSIGN(const file::Folder own, scan(id));
  return own.path();
}

Json ScanStore::list() const {
  std::vector<std::string> ids = root_->names();
  std::sort(ids.rbegin(), ids.rend());
  Json out = Json::array();
  for (const std::string& id : ids) {
    const auto own = scan(id);
    if (!own || !own->has(kRecording)) continue;
    // With a report it was complete; opening each recording would take long.
    out.push_back(
        {{"id", id},
         {"state", own->has(kReport)
                       ? "done"
                       : state_of(*own, Recording::open(own->path() / kRecording, context_))}});
  }
  return out;
}

Result<Json> ScanStore::describe(const std::string& id) const {
  TURNSCAN_ASSIGN(const file::Folder own, scan(id));
  if (!own.has(kRecording)) return fail(ErrorCode::kNotFound, "nothing was recorded yet");
  const fs::path path = own.path() / kRecording;
  const auto recording = Recording::open(path, context_);
  Json out{{"id", id}, {"state", state_of(own, recording)}};
  if (recording) {
    const CaptureSettings& settings = recording->capture_settings();
    const auto started = settings.find(kStartedAt);
    out["started_at"] = started == settings.end() ? Json() : Json(started->second);
    out["device"] = recording->header().source;
    out["frames"] = recording->frames().size();
  } else {
    out["error"] = recording.error().message;
  }
  out["bytes"] = bytes_below(own.path());
  out["files"] = Json::array();
  std::vector<std::string> names = own.names();
  std::sort(names.begin(), names.end());
  for (const std::string& name : names)
    if (const auto bytes = bytes_of(own, name); bytes && !media_type(name).empty())
      out["files"].push_back({{"name", name}, {"bytes", *bytes}, {"type", media_type(name)}});
  return out;
}

Result<Json> ScanStore::verdict(const std::string& id) const {
  TURNSCAN_ASSIGN(const file::Folder own, scan(id));
  if (!own.has(kReport)) return fail(ErrorCode::kMissingData, "there is no mesh of this scan yet");
  TURNSCAN_ASSIGN(const std::string text, own.read(kReport));
  const Json report = read_report(text);
  if (!report.is_object() || !report.contains("objects") || !report["objects"].is_array())
    return fail(ErrorCode::kFormat, "report.json of this scan is damaged; reconstruct it again");
  Json out{{"objects", Json::array()}, {"next_pass", report.value("next_pass", Json())}};
  for (const Json& object : report["objects"]) {
    if (!object.is_object()) continue;
    out["objects"].push_back(
        {{"name", object.value("name", Json())}, {"verdict", object.value("verdict", Json())}});
  }
  return out;
}

Result<std::shared_ptr<const ResultFile>> ScanStore::file(const std::string& id,
                                                          const std::string& name) const {
  TURNSCAN_ASSIGN(const file::Folder own, scan(id));
  if (media_type(name).empty()) return no_file();
  return opened(own, name);
}

Result<Json> ScanStore::recording(const std::string& id) const {
  TURNSCAN_ASSIGN(const file::Folder own, scan(id));
  TURNSCAN_ASSIGN(const file::Folder root, own.subfolder(kRecording));
  Json files = Json::array();
  list_files(root, "", files);
  for (const std::string& name : root.names())
    if (const auto inner = root.subfolder(name)) list_files(*inner, name + "/", files);
  return Json{{"files", std::move(files)}};
}

Result<std::shared_ptr<const ResultFile>> ScanStore::recorded(const std::string& id,
                                                              const std::string& folder,
                                                              const std::string& name) const {
  TURNSCAN_ASSIGN(const file::Folder own, scan(id));
  TURNSCAN_ASSIGN(const file::Folder root, own.subfolder(kRecording));
  if (folder.empty()) return opened(root, name);
  if (is_name(folder))
    if (const auto inner = root.subfolder(folder)) return opened(*inner, name);
  return no_file();
}

}  // namespace turnscan::serve
