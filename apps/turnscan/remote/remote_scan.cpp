#include "remote/remote_scan.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <thread>
#include <turnscan/workflow/mesh_output.hpp>
#include <turnscan/workflow/output_file.hpp>

namespace turnscan::remote {

namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kBetweenLooks{250};
constexpr std::uint64_t kSteps = 1000;
constexpr const char* kMeshEndings[] = {".glb", ".3mf", ".stl", ".ply"};

/// One component of a path here, though it was said elsewhere.
bool is_plain(const std::string& name) {
  return !name.empty() && name.front() != '.' &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) {
           return std::isalnum(c) != 0 || c == '.' || c == '-' || c == '_';
         });
}

Error with_place(Error error, const std::string& id) {
  const char* joint = error.message.find("; ") == std::string::npos ? "; " : " - ";
  error.message += fmt::format("{}on the rig it is scan {}", joint, id);
  return error;
}

class RemoteScan {
 public:
  RemoteScan(RemoteRig& rig, const ScanRequest& request, bool record_only, const Ask& ask,
             cli::Session& session)
      : rig_(rig), request_(request), record_only_(record_only), ask_(ask), session_(session) {}

  Result<> run() {
    TURNSCAN_TRY(check_outputs());
    Json body{{"device", request_.setup.devices.front()}};
    if (record_only_)
      body["record_only"] = true;
    else if (request_.passes || !ask_)
      body["passes"] = request_.passes.value_or(1);
    TURNSCAN_ASSIGN(const Json started, rig_.operate("scans", body));
    if (!started.is_object() || !started.value("id", Json()).is_string())
      return tl::unexpected<Error>(rig_.not_understood());
    id_ = started["id"].get<std::string>();
    if (!is_plain(id_)) return tl::unexpected<Error>(rig_.not_understood());
    session_.context().begin_phase("scan on the rig", kSteps);
    auto done = follow();
    session_.status().set("");
    if (done) done = fetch();
    if (!done) return tl::unexpected<Error>(with_place(std::move(done).error(), id_));
    return apart_;
  }

 private:
  Result<> check_outputs() const {
    if (!record_only_) TURNSCAN_TRY(check_meshes());
    if (request_.recording.empty()) return {};
    TURNSCAN_TRY(check_output_folder(request_.recording, request_.overwrite_unfinished));
    std::error_code ignored;
    if (fs::symlink_status(part(), ignored).type() != fs::file_type::not_found)
      return fail(ErrorCode::kAlreadyExists, "{}: is in the way; remove it, or use another name",
                  part().string());
    return {};
  }

  /// Where the recording is, without a slash at its end.
  fs::path recording() const {
    const fs::path path(request_.recording);
    return path.has_filename() ? path : path.parent_path();
  }
  /// Its name until it is whole.
  fs::path part() const { return recording().string() + ".part"; }

  Result<> check_meshes() const {
    const std::string ending = ending_of(request_.mesh);
    if (std::find(std::begin(kMeshEndings), std::end(kMeshEndings), ending) ==
        std::end(kMeshEndings))
      return fail(ErrorCode::kInvalidOption,
                  "{}: a rig makes .glb, .3mf, .stl and .ply; use one of them", request_.mesh);
    TURNSCAN_TRY(check_mesh_file(request_.mesh));
    TURNSCAN_TRY(check_output_file(request_.report, ".json"));
    TURNSCAN_TRY(check_output_file(request_.page, ".html"));
    return check_output_file(request_.advice_picture, ".png");
  }

  /// Until it has ended.
  Result<> follow() {
    for (;;) {
      if (!session_.context().check()) return cancel();
      TURNSCAN_ASSIGN(const Json state, rig_.get("state"));
      try {
        TURNSCAN_ASSIGN(const bool ended, look(state.at("job")));
        if (ended) return {};
      } catch (const Json::exception&) {
        return tl::unexpected<Error>(rig_.not_understood());
      }
      std::this_thread::sleep_for(kBetweenLooks);
    }
  }

  Result<> cancel() {
    TURNSCAN_TRY(rig_.operate("job/cancel"));
    return fail(ErrorCode::kCancelled, "scan: cancelled; what was recorded is kept there");
  }

  Result<bool> look(const Json& job) {
    if (!job.is_object() || job.at("id") != id_)
      return fail(ErrorCode::kDeviceLost, "{}: does something else meanwhile; look at its scans",
                  rig_.address());
    const auto state = job.at("state").get<std::string>();
    if (state == "asking") {
      TURNSCAN_TRY(answer(job.at("question")));
      return false;
    }
    if (state == "running") {
      show(job);
      return false;
    }
    if (job.at("text").is_string()) text_ = job.at("text").get<std::string>();
    for (const Json& note : job.at("notes")) text_ += "Note: " + note.get<std::string>() + "\n";
    if (job.at("error").is_null()) return true;
    Error error{code_named(job.at("code").get<std::string>()), job.at("error").get<std::string>(),
                ""};
    if (state != "done") return tl::unexpected<Error>(std::move(error));
    apart_ = tl::unexpected<Error>(std::move(error));
    return true;
  }

  Result<> answer(const Json& question) {
    bool more = false;
    if (ask_) {
      TURNSCAN_ASSIGN(more, ask_(question.at("advice").get<std::string>(),
                                 question.at("pass").get<std::uint32_t>()));
    }
    TURNSCAN_TRY(rig_.operate("job/answer", {{"another_side", more}}));
    return {};
  }

  void show(const Json& job) {
    session_.status().set(fmt::format("{}, {} frames", job.at("phase").get<std::string>(),
                                      job.at("frames").get<std::uint64_t>()));
    if (!job.at("fraction").is_number()) return;
    const double fraction = std::clamp(job.at("fraction").get<double>(), 0.0, 1.0);
    const auto steps = static_cast<std::uint64_t>(fraction * double(kSteps));
    if (steps > shown_) session_.context().advance(steps - shown_);
    shown_ = std::max(shown_, steps);
  }

  /// Their names, as the rig lists them at a path.
  Result<std::vector<std::string>> files_of(const std::string& path) {
    TURNSCAN_ASSIGN(const Json listed, rig_.get(path));
    std::vector<std::string> names;
    try {
      for (const Json& file : listed.at("files")) names.push_back(file.at("name"));
    } catch (const Json::exception&) {
      return tl::unexpected<Error>(rig_.not_understood());
    }
    return names;
  }

  Result<> fetch() {
    if (!record_only_) TURNSCAN_TRY(fetch_meshes());
    TURNSCAN_TRY(fetch_recording());
    if (record_only_) session_.print("{}", with_place_of_recording(text_));
    return {};
  }

  Result<> fetch_meshes() {
    TURNSCAN_ASSIGN(const std::vector<std::string> names, files_of("scans/" + id_));
    session_.print("{}", with_place_of_recording(text_));
    const std::string ending = ending_of(request_.mesh);
    bool found = false;
    for (const std::string& name : names) {
      // mesh.ply, and of several objects or passes mesh-2.ply
      if (!is_plain(name) || !name.starts_with("mesh") || ending_of(name) != ending) continue;
      const std::string suffix = name.substr(4, name.size() - 4 - ending.size());
      if (!suffix.empty() && suffix.front() != '-') continue;
      TURNSCAN_TRY(fetch(name, with_suffix(request_.mesh, suffix)));
      found = true;
    }
    if (!found)
      return fail(ErrorCode::kMissingData,
                  "{}: made no {} file (a texture may not fit into it); use another format",
                  rig_.address(), ending);
    TURNSCAN_TRY(fetch("report.json", request_.report));
    TURNSCAN_TRY(fetch("report.html", request_.page));
    return fetch("advice.png", request_.advice_picture);
  }

  /// The rig says where it is there.
  std::string with_place_of_recording(std::string text) const {
    const std::string there = id_ + "/recording";
    const std::string here =
        request_.recording.empty()
            ? fmt::format("the recording of scan {}, which stays on the rig", id_)
            : request_.recording;
    for (auto at = text.find(there); at != std::string::npos;
         at = text.find(there, at + here.size()))
      text.replace(at, there.size(), here);
    return text;
  }

  Result<> fetch(const std::string& name, const std::string& to) {
    if (to.empty()) return {};
    TURNSCAN_TRY(rig_.download(fmt::format("scans/{}/files/{}", id_, name), to));
    session_.print("Wrote {}\n", to);
    return {};
  }

  Result<> fetch_recording() {
    if (request_.recording.empty()) return {};
    std::error_code error;
    fs::create_directories(fs::absolute(part()).parent_path(), error);
    if (!fs::create_directory(part(), error))
      return fail(error ? ErrorCode::kIo : ErrorCode::kAlreadyExists,
                  "{}: cannot be created; remove it, or use another name", part().string());
    auto fetched = fetch_into(part());
    if (fetched) fetched = clear_output_folder(request_.recording, request_.overwrite_unfinished);
    if (fetched) {
      fs::rename(part(), recording(), error);
      if (error)
        fetched =
            fail_at(request_.recording, ErrorCode::kIo, "cannot be created ({})", error.message());
    }
    std::error_code ignored;
    fs::remove_all(part(), ignored);
    return fetched;
  }

  Result<> fetch_into(const fs::path& folder) {
    const std::string base = "scans/" + id_ + "/recording";
    TURNSCAN_ASSIGN(const std::vector<std::string> names, files_of(base));
    for (const std::string& name : names) {
      const auto slash = name.find('/');
      const std::string first = name.substr(0, slash);
      if (!is_plain(first) || (slash != std::string::npos && !is_plain(name.substr(slash + 1))))
        return tl::unexpected<Error>(rig_.not_understood());
      std::error_code error;
      if (slash != std::string::npos) fs::create_directory(folder / first, error);
      TURNSCAN_TRY(rig_.download(base + "/" + name, (folder / name).string()));
    }
    return {};
  }

  RemoteRig& rig_;
  const ScanRequest& request_;
  bool record_only_;
  const Ask& ask_;
  cli::Session& session_;
  std::string id_, text_;
  std::uint64_t shown_ = 0;
  Result<> apart_;  ///< what did not fit of a scan that is done
};

}  // namespace

Result<> check_given(const cli::CommandLine& line, const std::vector<std::string>& here) {
  for (const std::string& name : line.given())
    if (name != "server" && name != "quiet" && name != "threads" &&
        std::find(here.begin(), here.end(), name) == here.end())
      return fail(ErrorCode::kInvalidOption,
                  "--{}: does not go with --server, where the options of the turnscan serve there "
                  "count; leave it out",
                  name);
  return {};
}

namespace {

Result<> run(RemoteRig& rig, const ScanRequest& request, bool record_only, const Ask& ask,
             cli::Session& session) {
  if (request.setup.devices.size() != 1)
    return fail(ErrorCode::kInvalidOption,
                "--device: a rig scans with one at a time; leave the others out");
  return RemoteScan(rig, request, record_only, ask, session).run();
}

}  // namespace

Result<> run_remote_scan(RemoteRig& rig, const ScanRequest& request, const Ask& ask,
                         cli::Session& session) {
  return run(rig, request, false, ask, session);
}

Result<> run_remote_capture(RemoteRig& rig, const ScanRequest& request, cli::Session& session) {
  return run(rig, request, true, {}, session);
}

}  // namespace turnscan::remote
