#include <malloc.h>
#include <unistd.h>

#include <cstdio>
#include <thread>
#include <turnscan/core/process/host_name.hpp>

#include "cli/command_line.hpp"
#include "cli/commands.hpp"
#include "commands/capture_arguments.hpp"
#include "commands/stage_arguments.hpp"
#include "serve/http_server.hpp"
#include "serve/qr_code.hpp"
#include "serve/routes.hpp"

namespace turnscan::cli {

namespace {

constexpr const char* kLoopback = "127.0.0.1";
constexpr std::chrono::milliseconds kTick{20};
// Of a job that was cancelled; whoever ends the server waits no longer than half a second.
constexpr std::chrono::milliseconds kLastMoment{200};

OptionTable describe(int& port) {
  OptionTable table;
  table.number("port", port, {0, 65535}, "Port to listen at; 0: any that is free");
  return table;
}

class ServeCommand : public Command {
 public:
  void declare(CommandLine& line) override {
    line.optional_positional("FOLDER", folder_,
                             "Folder of the scans, created if there is none; default: "
                             "./turnscan-scans");
    line.option("--listen", "ADDRESS", listen_,
                "Address to listen at, e.g. 0.0.0.0 for the whole network. Others than this "
                "machine's own (127.0.0.1, the default) need --token or --tls-cert");
    line.option("--token", "FILE|auto", token_,
                "What a request has to bring: the first line of a file that nobody else may read, "
                "or auto: a new one, which is printed with the address");
    line.option("--tls-cert", "FILE.pem", tls_certificate_,
                "Serve by HTTPS, with this certificate and those that vouch for it");
    line.option("--tls-key", "FILE.pem", tls_key_,
                "The key of --tls-cert, without a password, which nobody else may read");
    line.flag("--openapi", print_openapi_, "Print the description of the interface, and end");
    line.repeatable("--device", "URI", request_.setup.devices,
                    "Sensor to offer besides those that are found, e.g. "
                    "'virtual:doll?sensor=kinect-v2'; may be given several times");
    declare_scan(line, request_, no_wait_);
    line.group("server", "Server", describe(port_));
    line.group("limits", "End of the recording", turnscan::describe(request_.setup.options.limits));
    line.group("mesh-file", "Mesh file", turnscan::describe(request_.mesh_options));
    declare_stages(line, request_.reconstruct);
    line.common({"port", "listen", "token", "tls-cert", "device", "motor", "turntable", "speed",
                 "turns", "voxel-size", "texture", "openapi"});
  }

  FileRoles files() const override {
    std::vector<std::string> inputs =
        with_replayed(request_.setup.devices, request_.setup.turntable_file);
    inputs.insert(inputs.end(), {tls_certificate_, tls_key_});
    return {inputs, {}};
  }

  Result<> run(Session& session) override {
    if (print_openapi_) {
      session.print("{}\n", serve::openapi().dump(2));
      return {};
    }
    if (request_.setup.options.limits.until_stopped)
      return fail(ErrorCode::kInvalidOption,
                  "--until-stopped: nobody is at the terminal to stop a scan; use --turns, "
                  "--seconds or --frames");
    TURNSCAN_ASSIGN(serve::Access access, find_access());
    // Each heap keeps the most that a job has needed of it, and without this there are eight of
    // them for each processor.
    mallopt(M_ARENA_MAX, int(std::thread::hardware_concurrency()));
    std::optional<serve::TlsContext> tls;
    if (access.tls) {
      TURNSCAN_ASSIGN(tls, serve::TlsContext::open(tls_certificate_, tls_key_));
    }
    TURNSCAN_ASSIGN(serve::ScanStore store, serve::ScanStore::open(folder_, session.context()));
    request_.wait = !no_wait_;
    const std::string folder = store.root().string();
    serve::Rig rig(std::move(store), request_, access);
    serve::HttpServer server(
        [&](const auto& request, auto& response) { return rig.admit(request, response); },
        [&](const auto& request, auto& response) { rig.answer(request, response); }, tls);
    TURNSCAN_ASSIGN(const int port, server.bind(listen_, port_));
    std::thread serving([&] { server.run(); });
    say_where(folder, access, port);
    while (!session.context().cancelled()) std::this_thread::sleep_for(kTick);
    rig.stop();
    server.stop();
    // A recording can be ended at any moment, and what is computed from it can be computed again:
    // no thread is waited for, neither of the job nor one that asks a driver for its devices.
    (void)rig.jobs().end(kLastMoment);
    _exit(0);
  }

 private:
  Result<serve::Access> find_access() const {
    serve::Access access;
    access.loopback = serve::Access::is_loopback(listen_);
    access.tls = !tls_certificate_.empty();
    if (access.tls == tls_key_.empty())
      return fail(ErrorCode::kInvalidOption,
                  "--tls-cert and --tls-key belong together; give both, or neither");
    if (token_ == "auto") {
      access.token = serve::random_key();
    } else if (!token_.empty()) {
      TURNSCAN_ASSIGN(access.token, serve::Access::read_token(token_));
    }
    if (!access.loopback && access.token.empty() && !access.tls)
      return fail(ErrorCode::kInvalidOption,
                  "--listen {}: everybody in that network could turn the table; give --token auto, "
                  "or --token FILE",
                  listen_);
    return access;
  }

  static std::string bracketed(const std::string& host) {
    return host.find(':') == std::string::npos ? host : fmt::format("[{}]", host);
  }

  /// At once, for people and for scripts that wait for it.
  void say_where(const std::string& folder, const serve::Access& access, int port) const {
    std::string host = listen_;
    if (listen_ == "0.0.0.0" || listen_ == "::") host = process::host_name();
    if (host.empty()) host = "localhost";
    const std::string page = token_ == "auto" ? fmt::format(":{}/?token={}", port, access.token)
                                              : fmt::format(":{}/", port);
    std::string text = fmt::format("Scans are in {}\nOpen {}{}{}\n", folder, access.scheme(),
                                   bracketed(host), page);
    // Phones often do not find a machine by its name.
    const std::string address =
        listen_ == "0.0.0.0" || listen_ == "::" ? serve::network_address() : listen_;
    if (!access.loopback && isatty(STDOUT_FILENO) == 1 && !address.empty())
      text += serve::qr_code(fmt::format("{}{}{}", access.scheme(), bracketed(address), page));
    text += "Ctrl-C ends the server\n";
    std::fputs(text.c_str(), stdout);
    std::fflush(stdout);
  }

  std::string folder_ = "turnscan-scans";
  std::string listen_ = kLoopback;
  std::string token_, tls_certificate_, tls_key_;
  int port_ = 8470;
  bool print_openapi_ = false, no_wait_ = false;
  ScanRequest request_;
};

}  // namespace

std::unique_ptr<Command> make_serve_command() { return std::make_unique<ServeCommand>(); }

}  // namespace turnscan::cli
