#pragma once
// The interface /api/v1 as one table: what the server answers, and what its OpenAPI description
// says.

#include <httplib.h>

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <turnscan/workflow/scan/scan.hpp>
#include <vector>

#include "serve/access.hpp"
#include "serve/jobs.hpp"
#include "serve/operator_lease.hpp"
#include "serve/page.hpp"
#include "serve/scan_store.hpp"

namespace turnscan::serve {

/// Pages that watch at once.
inline constexpr int kMaxWatchers = 16;
inline constexpr int kMaxDepth = 4;  ///< of a body

/// One request on its way to an answer.
struct Call {
  const httplib::Request& request;
  httplib::Response& response;
  std::vector<std::string> names;  ///< what stands for {id}, {name}
  Json body = Json::object();
};

class Rig;

struct Route {
  const char* method;
  const char* path;  ///< "{...}" is one component
  const char* operation;
  const char* summary;
  bool of_operator;    ///< needs the operator's key
  const char* body;    ///< name of a schema; "" if there is none
  const char* answer;  ///< name of a schema, or a media type; "" if there is nothing to say
  int status;          ///< when it succeeds
  Result<Json> (Rig::*run)(Call&);
  const char* query = "";  ///< name of an optional parameter; "" if there is none
};

/// All of the interface.
const std::vector<Route>& routes();
/// The OpenAPI 3.1 description of routes().
Json openapi();

/// Answers requests, given what there is to serve.
class Rig {
 public:
  /// settings: of each scan; its devices can be chosen besides those that are found.
  Rig(ScanStore store, const ScanRequest& settings, Access access);

  bool admit(const httplib::Request& request, httplib::Response& response) const;
  void answer(const httplib::Request& request, httplib::Response& response);

  Jobs& jobs() { return jobs_; }
  /// Ends the streams of events.
  void stop() { stopping_ = true; }

  Result<Json> describe_interface(Call& call);
  Result<Json> state(Call& call);
  Result<Json> events(Call& call);
  Result<Json> picture(Call& call);
  Result<Json> surface(Call& call);
  Result<Json> devices(Call& call);
  Result<Json> become_operator(Call& call);
  Result<Json> leave(Call& call);
  Result<Json> scans(Call& call);
  Result<Json> start_scan(Call& call);
  Result<Json> scan(Call& call);
  Result<Json> verdict(Call& call);
  Result<Json> file(Call& call);
  Result<Json> recording(Call& call);
  Result<Json> recorded(Call& call);
  Result<Json> reconstruct(Call& call);
  Result<Json> resume(Call& call);
  Result<Json> remove(Call& call);
  Result<Json> answer_question(Call& call);
  Result<Json> cancel(Call& call);

 private:
  void show_page(const httplib::Request& request, httplib::Response& response) const;
  void run(const Route& route, Call& call);
  static void give(Call& call, const std::shared_ptr<const ResultFile>& file,
                   const std::string& type);
  Json state_now() const;
  Json found_devices();
  /// Fails with kInvalidOption for what is none of /api/v1/devices.
  Result<> check_device(Call& call, const Json& device);

  ScanStore store_;
  std::vector<std::string> given_devices_;
  Access access_;
  Page page_;
  OperatorLease lease_;
  std::atomic<int> watchers_ = 0;
  std::atomic<bool> stopping_ = false;
  std::mutex devices_mutex_;
  Json devices_;
  Jobs jobs_;
};

}  // namespace turnscan::serve
