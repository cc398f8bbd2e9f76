#include "serve/routes.hpp"

#include <turnscan/capture/source/plugins.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>

#include "serve/live_picture.hpp"

namespace turnscan::serve {

namespace {

constexpr std::chrono::milliseconds kBetweenEvents{100};
constexpr std::chrono::seconds kEventWait{1};
constexpr std::chrono::seconds kSignOfLife{10};
constexpr std::size_t kPiece = std::size_t(64) * 1024;
constexpr const char* kOperatorHeader = "Turnscan-Operator";
constexpr const char* kJsonType = "application/json";
// What is not the page shows and runs nothing; reports run the script that they bring, apart from
// this server.
constexpr const char* kNothing = "default-src 'none'; frame-ancestors 'none'";
constexpr const char* kApart = "sandbox allow-scripts";

std::vector<std::string> components(const std::string& path) {
  std::vector<std::string> out;
  for (std::size_t at = 1, next = 0; next != std::string::npos; at = next + 1) {
    next = path.find('/', at);
    out.push_back(path.substr(at, next == std::string::npos ? next : next - at));
  }
  return out;
}

/// What stands for the names of the pattern; nullopt: another path.
std::optional<std::vector<std::string>> matched(const char* pattern, const std::string& path) {
  const auto expected = components(pattern), given = components(path);
  if (expected.size() != given.size()) return std::nullopt;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (expected[i].starts_with('{'))
      names.push_back(given[i]);
    else if (expected[i] != given[i])
      return std::nullopt;
  }
  return names;
}

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void refuse(httplib::Response& response, int status, std::string_view code,
            const std::string& message) {
  response.status = status;
  response.set_content(text_of({{"error", {{"code", code}, {"message", message}}}}), kJsonType);
}

int status_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::kInvalidOption:
      return 400;
    case ErrorCode::kNotFound:
      return 404;
    case ErrorCode::kDeviceBusy:
    case ErrorCode::kMissingData:
      return 409;
    case ErrorCode::kResourceLimit:
      return 503;
    default:
      return 500;
  }
}

/// A recording that is being made looks unfinished on the disk.
void mark_running(Json& scan, const std::string& running_id) {
  if (scan["state"] == "unfinished" && scan["id"] == running_id) scan["state"] = "running";
}

void set_headers(httplib::Response& response) {
  response.set_header("X-Content-Type-Options", "nosniff");
  response.set_header("Referrer-Policy", "no-referrer");
  response.set_header("Cross-Origin-Resource-Policy", "same-origin");
  response.set_header("Cache-Control", "no-store");
}

}  // namespace

const std::vector<Route>& routes() {
  static const std::vector<Route> kRoutes{
      {"GET", "/api/v1/openapi.json", "describeInterface", "This description", false, "", kJsonType,
       200, &Rig::describe_interface},
      {"GET", "/api/v1/state", "getState", "What the rig does, and whether somebody operates it",
       false, "", "State", 200, &Rig::state},
      {"GET", "/api/v1/events", "watch",
       "The state whenever it changes, as server-sent events named 'state'", false, "",
       "text/event-stream", 200, &Rig::events},
      {"GET", "/api/v1/picture.jpg", "getPicture",
       "What the sensor sees, or saw last (409: nothing yet). It is new when 'picture' of the job "
       "is",
       false, "", "image/jpeg", 200, &Rig::picture},
      {"GET", "/api/v1/surface", "getSurface",
       "The surface seen so far in the recording that runs, or ran last, and how many frames it is "
       "made from. It is made while somebody asks at least every 5 seconds. 'model' is null if "
       "there is none yet, or it has the number 'have'",
       false, "", "Surface", 200, &Rig::surface, "have"},
      {"GET", "/api/v1/devices", "listDevices", "The sensors that can be scanned with", false, "",
       "Devices", 200, &Rig::devices},
      {"POST", "/api/v1/operator", "becomeOperator",
       "Become the one who operates the rig, or stay it: the key is kept for 30 seconds after its "
       "last use (409: somebody else operates)",
       false, "", "Operator", 200, &Rig::become_operator},
      {"DELETE", "/api/v1/operator", "leave", "Let somebody else operate the rig", true, "", "",
       200, &Rig::leave},
      {"GET", "/api/v1/scans", "listScans", "The scans on disk, the newest first", false, "",
       "Scans", 200, &Rig::scans},
      {"POST", "/api/v1/scans", "startScan",
       "Scan what is on the turntable (409: the rig is at "
       "work)",
       true, "NewScan", "Started", 202, &Rig::start_scan},
      {"GET", "/api/v1/scans/{id}", "getScan", "One scan: its files, frames, bytes, state", false,
       "", "Scan", 200, &Rig::scan},
      {"DELETE", "/api/v1/scans/{id}", "deleteScan",
       "Delete a scan, its recording and all that was made of it (409: the rig is at work on it)",
       true, "", "", 200, &Rig::remove},
      {"POST", "/api/v1/scans/{id}/resume", "resumeScan",
       "Go on with a recording that was not finished, on the device that it was made with (409: it "
       "was finished, or the rig is at work)",
       true, "", "Started", 202, &Rig::resume},
      {"GET", "/api/v1/scans/{id}/verdict", "getVerdict",
       "How good each object of a scan is, and how to lay it for another pass (409: there is no "
       "mesh)",
       false, "", "Verdict", 200, &Rig::verdict},
      {"GET", "/api/v1/scans/{id}/files/{name}", "getFile", "A mesh, a report, a picture", false,
       "", "application/octet-stream", 200, &Rig::file},
      {"GET", "/api/v1/scans/{id}/recording", "listRecording",
       "The files of a recording (409: it is being made)", false, "", "Files", 200,
       &Rig::recording},
      {"GET", "/api/v1/scans/{id}/recording/{name}", "getRecorded", "A file of a recording", false,
       "", "application/octet-stream", 200, &Rig::recorded},
      {"GET", "/api/v1/scans/{id}/recording/{folder}/{name}", "getRecordedImage",
       "A file in a folder of a recording", false, "", "application/octet-stream", 200,
       &Rig::recorded},
      {"POST", "/api/v1/scans/{id}/reconstruct", "reconstruct",
       "Make meshes and report of a recording again (409: the rig is at work)", true, "", "Started",
       202, &Rig::reconstruct},
      {"POST", "/api/v1/job/answer", "answer",
       "Say whether the object lies another way now, or is done (409: nothing was asked)", true,
       "Answer", "", 202, &Rig::answer_question},
      {"POST", "/api/v1/job/cancel", "cancel",
       "End what the rig does; what was recorded is kept (409: it does nothing)", true, "", "", 202,
       &Rig::cancel}};
  return kRoutes;
}

Rig::Rig(ScanStore store, const ScanRequest& settings, Access access)
    : store_(store),
      given_devices_(settings.setup.devices),
      access_(std::move(access)),
      page_(read_page()),
      jobs_(std::move(store), settings) {}

bool Rig::admit(const httplib::Request& request, httplib::Response& response) const {
  set_headers(response);
  const auto why = refusal(access_, request);
  if (!why) return true;
  response.set_header("Content-Security-Policy", kNothing);
  refuse(response, why->status, why->code, why->message);
  return false;
}

void Rig::answer(const httplib::Request& request, httplib::Response& response) {
  if (request.path == "/") return show_page(request, response);
  response.set_header("Content-Security-Policy", kNothing);
  bool known = false;
  for (const Route& route : routes()) {
    const auto names = matched(route.path, request.path);
    if (!names) continue;
    known = true;
    if (request.method != route.method && !(request.method == "HEAD" && *route.method == 'G'))
      continue;
    Call call{request, response, *names};
    return run(route, call);
  }
  refuse(response, known ? 405 : 404, known ? "method" : "not-found",
         "there is no such thing; /api/v1/openapi.json lists what there is");
}

void Rig::show_page(const httplib::Request& request, httplib::Response& response) const {
  if (request.has_param("token")) {  // which must not stay in the address
    response.set_header(
        "Set-Cookie", fmt::format("{}={}; HttpOnly; SameSite=Lax; Path=/{}", token_cookie(request),
                                  access_.token, access_.tls ? "; Secure" : ""));
    response.set_redirect("/", 303);
    return;
  }
  response.set_header("Content-Security-Policy", page_.policy);
  if (page_.html.empty())
    response.set_content(
        "This turnscan was built without its page (scripts/setup page); the "
        "interface is at /api/v1/openapi.json.\n",
        "text/plain");
  else
    response.set_content(page_.html, "text/html; charset=utf-8");
}

void Rig::run(const Route& route, Call& call) {
  if (route.of_operator && !lease_.holds(call.request.get_header_value(kOperatorHeader)))
    return refuse(call.response, 403, "operator",
                  "only the operator may do that; become it (POST /api/v1/operator) and send its "
                  "key as Turnscan-Operator");
  if (*route.body != '\0') {
    // No body nests; a deep one would be copied until the stack ends.
    bool nests = false;
    const auto flat = [&](int depth, Json::parse_event_t, const Json&) {
      nests |= depth > kMaxDepth;
      return depth <= kMaxDepth;
    };
    call.body = Json::parse(call.request.body, flat, false);
    if (nests || !call.body.is_object())
      return refuse(call.response, 400, "invalid-option", "the body has to be a flat JSON object");
  }
  call.response.status = route.status;
  Result<Json> result = (this->*route.run)(call);
  if (!result)
    refuse(call.response, status_of(result.error().code), name_of(result.error().code),
           result.error().message);
  else if (!result->is_null())
    call.response.set_content(text_of(*result), kJsonType);
}

Json Rig::state_now() const { return {{"job", jobs_.state()}, {"operator", lease_.taken()}}; }

Result<Json> Rig::describe_interface(Call&) { return openapi(); }

Result<Json> Rig::state(Call&) { return state_now(); }

// A viewer gets the newest state and no history, so that nothing piles up for one that stalls.
Result<Json> Rig::events(Call& call) {
  if (++watchers_ > kMaxWatchers) {
    --watchers_;
    return fail(ErrorCode::kResourceLimit, "too many pages watch; close one");
  }
  struct Watcher {
    std::atomic<int>& count;
    std::string last{};
    std::uint64_t version = 0;
    std::chrono::steady_clock::time_point sent{};
    explicit Watcher(std::atomic<int>& c) : count(c) {}
    Watcher(const Watcher&) = delete;
    Watcher& operator=(const Watcher&) = delete;
    ~Watcher() { --count; }
  };
  const auto watcher = std::make_shared<Watcher>(watchers_);
  const auto send = [this, watcher](std::size_t, httplib::DataSink& sink) {
    if (stopping_ || !sink.is_writable()) return false;
    std::string text = text_of(state_now());
    const auto now = std::chrono::steady_clock::now();
    std::string event;
    if (text != watcher->last) {
      event = "event: state\ndata: " + text + "\n\n";
      watcher->last = std::move(text);
    } else if (now - watcher->sent > kSignOfLife) {
      event = ": here\n\n";
    }
    if (!event.empty()) {
      watcher->sent = now;
      if (!sink.write(event.data(), event.size())) return false;
      std::this_thread::sleep_for(kBetweenEvents);
    }
    jobs_.wait_for_change(watcher->version, kEventWait);
    return true;
  };
  call.response.set_chunked_content_provider("text/event-stream", send);
  return Json();
}

Result<Json> Rig::picture(Call& call) {
  const auto frame = jobs_.live_frame();
  if (!frame) return fail(ErrorCode::kMissingData, "no sensor has recorded yet");
  TURNSCAN_ASSIGN(const std::string jpeg, live_picture(*frame));
  call.response.set_content(jpeg, "image/jpeg");
  return Json();
}

Result<Json> Rig::surface(Call& call) {
  const auto newest = jobs_.surface().newest();
  const bool known =
      newest->number == 0 || call.request.get_param_value("have") == std::to_string(newest->number);
  call.response.set_content(fmt::format(R"({{"number":{},"frames":{},"model":{}}})", newest->number,
                                        newest->frames, known ? "null" : newest->model),
                            kJsonType);
  return Json();
}

Json Rig::found_devices() {
  Json out = Json::array();
  for (const std::string& uri : given_devices_)
    out.push_back({{"uri", uri}, {"model", uri}, {"kind", "given"}});
  for (const DriverState& driver : list_drivers())
    for (const FoundDevice& device : driver.devices)
      out.push_back({{"uri", device.uri}, {"model", device.model}, {"kind", "sensor"}});
  for (const std::string& object : builtin_object_names())
    out.push_back({{"uri", "virtual:" + object}, {"model", object}, {"kind", "virtual"}});
  return out;
}

Result<Json> Rig::devices(Call&) {
  const std::lock_guard lock(devices_mutex_);
  // A driver that looks for devices may disturb one that records.
  if (jobs_.running_id().empty() || devices_.is_null()) devices_ = found_devices();
  return Json{{"devices", devices_}};
}

Result<Json> Rig::become_operator(Call& call) {
  const auto key = lease_.take(call.request.get_header_value(kOperatorHeader));
  if (!key) return fail(ErrorCode::kDeviceBusy, "somebody else operates the rig");
  return Json{{"key", *key}, {"seconds", OperatorLease::kKept.count()}};
}

Result<Json> Rig::leave(Call& call) {
  lease_.give_up(call.request.get_header_value(kOperatorHeader));
  return Json::object();
}

Result<Json> Rig::scans(Call&) {
  Json all = store_.list();
  const std::string running_id = jobs_.running_id();
  for (Json& one : all) mark_running(one, running_id);
  return Json{{"scans", all}};
}

Result<> Rig::check_device(Call& call, const Json& device) {
  TURNSCAN_ASSIGN(const Json known, devices(call));
  for (const Json& one : known["devices"])
    if (device.is_string() && one["uri"] == device) return {};
  return fail(ErrorCode::kInvalidOption, "device: has to be one of /api/v1/devices");
}

Result<Json> Rig::start_scan(Call& call) {
  const Json device = call.body.value("device", Json()), passes = call.body.value("passes", Json()),
             record_only = call.body.value("record_only", Json(false));
  TURNSCAN_TRY(check_device(call, device));
  if (!record_only.is_boolean() || (record_only == true && !passes.is_null()))
    return fail(ErrorCode::kInvalidOption,
                "record_only: has to be true, without passes, or false, or left out");
  std::optional<int> count;
  if (!passes.is_null()) {
    if (!passes.is_number_integer() || passes < 1 || passes > 100)
      return fail(ErrorCode::kInvalidOption,
                  "passes: has to be a number from 1 to 100, or left out");
    count = passes.get<int>();
  }
  const std::vector<std::string> devices{device.get<std::string>()};
  TURNSCAN_ASSIGN(const std::string id, record_only == true ? jobs_.start_recording(devices)
                                                            : jobs_.start_scan(devices, count));
  return Json{{"id", id}};
}

Result<Json> Rig::scan(Call& call) {
  TURNSCAN_ASSIGN(Json out, store_.describe(call.names[0]));
  mark_running(out, jobs_.running_id());
  return out;
}

Result<Json> Rig::verdict(Call& call) { return store_.verdict(call.names[0]); }

Result<Json> Rig::file(Call& call) {
  const std::string& name = call.names[1];
  TURNSCAN_ASSIGN(const auto file, store_.file(call.names[0], name));
  if (name.ends_with(".html")) {
    call.response.headers.erase("Content-Security-Policy");
    call.response.set_header("Content-Security-Policy", kApart);
  } else {
    call.response.set_header("Content-Disposition",
                             fmt::format("attachment; filename=\"{}-{}\"", call.names[0], name));
  }
  give(call, file, media_type(name));
  return Json();
}

Result<Json> Rig::recording(Call& call) {
  if (jobs_.running_id() == call.names[0])
    return fail(ErrorCode::kDeviceBusy, "the rig is at work on this scan");
  return store_.recording(call.names[0]);
}

Result<Json> Rig::recorded(Call& call) {
  const auto& names = call.names;
  TURNSCAN_ASSIGN(const auto file,
                  store_.recorded(names[0], names.size() > 2 ? names[1] : "", names.back()));
  give(call, file, "application/octet-stream");
  return Json();
}

void Rig::give(Call& call, const std::shared_ptr<const ResultFile>& file, const std::string& type) {
  const auto send = [file](std::size_t from, std::size_t left, httplib::DataSink& sink) {
    const std::string piece = file->read(from, std::min(left, kPiece));
    return !piece.empty() && sink.write(piece.data(), piece.size());
  };
  if (file->bytes() == 0)
    call.response.set_content("", type);
  else
    call.response.set_content_provider(file->bytes(), type, send);
}

Result<Json> Rig::reconstruct(Call& call) {
  TURNSCAN_TRY(jobs_.start_reconstruction(call.names[0]));
  return Json{{"id", call.names[0]}};
}

Result<Json> Rig::resume(Call& call) {
  TURNSCAN_ASSIGN(const Json scan, store_.describe(call.names[0]));
  if (scan["state"] != "unfinished")
    return fail(ErrorCode::kMissingData, "this scan was finished; there is nothing to go on with");
  TURNSCAN_TRY(check_device(call, scan["device"]));
  TURNSCAN_TRY(jobs_.resume_scan(call.names[0], {scan["device"].get<std::string>()}));
  return Json{{"id", call.names[0]}};
}

Result<Json> Rig::remove(Call& call) {
  TURNSCAN_TRY(jobs_.remove(call.names[0]));
  return Json::object();
}

Result<Json> Rig::answer_question(Call& call) {
  const Json more = call.body.value("another_side", Json());
  if (!more.is_boolean())
    return fail(ErrorCode::kInvalidOption, "another_side: has to be true or false");
  TURNSCAN_TRY(jobs_.answer(more.get<bool>()));
  return Json::object();
}

Result<Json> Rig::cancel(Call&) {
  TURNSCAN_TRY(jobs_.cancel());
  return Json::object();
}

}  // namespace turnscan::serve
