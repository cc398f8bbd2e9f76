#include "remote/remote_rig.hpp"

#include <httplib.h>

#include <cstdlib>
#include <turnscan/io/file/atomic_file.hpp>

namespace turnscan::remote {

namespace {

constexpr const char* kBase = "/api/v1/";
constexpr const char* kOperatorHeader = "Turnscan-Operator";
constexpr time_t kAnswersWithin_s = 30;
constexpr std::size_t kMaxAnswerBytes = std::size_t(64) << 20;  // of what is not a file

/// "http://rig:8470", without what a pasted address has after it.
bool is_address(const std::string& text) {
  for (const std::string scheme : {"http://", "https://"})
    if (text.starts_with(scheme) && text.size() > scheme.size())
      return text.find_first_of("/?#@", scheme.size()) == std::string::npos;
  return false;
}

}  // namespace

ErrorCode code_named(const std::string& name) {
  for (int code = 0; code <= int(ErrorCode::kNoPermission); ++code)
    if (name_of(ErrorCode(code)) == name) return ErrorCode(code);
  return ErrorCode::kNoPermission;
}

Result<RemoteRig> RemoteRig::open(const std::string& address, const RunContext& context) {
  std::string base = address;
  while (base.ends_with('/')) base.pop_back();
  if (!is_address(base))
    return fail(ErrorCode::kInvalidOption,
                "--server {}: the address of a rig looks like http://rig:8470; its token belongs "
                "into the environment variable {}",
                address.substr(0, address.find('?')), kTokenVariable);
  RemoteRig rig(std::move(base), context);
  if (!rig.client_->is_valid())
    return fail(ErrorCode::kInvalidOption,
                "--server {}: cannot be used; the address of a rig looks like http://rig:8470",
                address);
  return rig;
}

RemoteRig::RemoteRig(std::string address, const RunContext& context)
    : address_(std::move(address)),
      context_(context),
      client_(std::make_unique<httplib::Client>(address_)) {
  client_->set_read_timeout(kAnswersWithin_s);
  if (const char* token = std::getenv(kTokenVariable))
    client_->set_default_headers({{"Authorization", std::string("Bearer ") + token}});
}

RemoteRig::RemoteRig(RemoteRig&&) noexcept = default;
RemoteRig& RemoteRig::operator=(RemoteRig&&) noexcept = default;
RemoteRig::~RemoteRig() {
  if (client_ && !key_.empty())
    (void)client_->Delete(std::string(kBase) + "operator",
                          httplib::Headers{{kOperatorHeader, key_}});
}

Error RemoteRig::not_understood() const {
  return {ErrorCode::kFormat,
          address_ + ": answers with something else; is it a turnscan serve of this version?", ""};
}

Error RemoteRig::silent(const std::string& why) const {
  return {ErrorCode::kIo,
          fmt::format("{}: does not answer ({}); check the address, and that turnscan serve runs "
                      "there",
                      address_, why),
          ""};
}

Error RemoteRig::refused(int status, const std::string& body) const {
  const Json answer = Json::parse(body, nullptr, false);
  if (answer.is_object() && answer.contains("error") && answer["error"].is_object()) {
    const Json code = answer["error"].value("code", Json()),
               message = answer["error"].value("message", Json());
    if (code == "token")
      return {ErrorCode::kNoPermission,
              fmt::format("{}: the token is missing or wrong; set the environment variable {}",
                          address_, kTokenVariable),
              ""};
    if (code.is_string() && message.is_string())
      return {code_named(code.get<std::string>()),
              fmt::format("{}: {}", address_, message.get<std::string>()), ""};
  }
  return status == 0 ? silent("no status") : not_understood();
}

Result<> RemoteRig::receive(const std::string& path, const Take& take) {
  std::string refusal;
  int status = 0;
  const auto result = client_->Get(
      kBase + path, httplib::Headers{},
      [&](const httplib::Response& response) {
        status = response.status;
        return true;
      },
      [&](const char* data, std::size_t size) {
        if (status == 200) return take(std::string_view(data, size));
        refusal.append(data, size);
        return refusal.size() <= kMaxAnswerBytes;
      });
  if (!result) return tl::unexpected<Error>(silent(httplib::to_string(result.error())));
  if (status != 200) return tl::unexpected<Error>(refused(status, refusal));
  return {};
}

Result<Json> RemoteRig::get(const std::string& path) {
  std::string body;
  TURNSCAN_TRY(receive(path, [&](std::string_view piece) {
    body.append(piece);
    return body.size() <= kMaxAnswerBytes;
  }));
  Json answer = Json::parse(body, nullptr, false);
  if (answer.is_discarded()) return tl::unexpected<Error>(not_understood());
  return answer;
}

Result<Json> RemoteRig::post(const std::string& path, const Json& body) {
  const auto result =
      client_->Post(kBase + path, httplib::Headers{{kOperatorHeader, key_}},
                    body.is_null() ? std::string() : body.dump(), "application/json");
  if (!result) return tl::unexpected<Error>(silent(httplib::to_string(result.error())));
  if (result->status / 100 != 2)
    return tl::unexpected<Error>(refused(result->status, result->body));
  return Json::parse(result->body, nullptr, false);
}

Result<Json> RemoteRig::operate(const std::string& path, const Json& body) {
  // The key lapses after a while without use.
  TURNSCAN_ASSIGN(const Json own, post("operator", {}));
  if (!own.is_object() || !own.value("key", Json()).is_string())
    return tl::unexpected<Error>(not_understood());
  key_ = own["key"].get<std::string>();
  return post(path, body);
}

Result<> RemoteRig::download(const std::string& path, const std::string& file) {
  const auto body = [&](FileSink& sink) -> Result<> {
    Result<> written;
    const auto received = receive(path, [&](std::string_view piece) {
      written = sink.write(piece);
      return written && !context_.cancelled();
    });
    TURNSCAN_TRY(context_.check());
    TURNSCAN_TRY(written);
    return received;
  };
  return write_file_atomically(file, body, Durability::kNamed);
}

}  // namespace turnscan::remote
