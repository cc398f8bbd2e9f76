#pragma once
// Taking frames from sources, for tests.

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <turnscan/capture/source/frame_source.hpp>
#include <vector>

namespace turnscan::testing {

inline std::unique_ptr<FrameSource> opened(const std::string& uri) {
  auto source = open_source(uri, {});
  EXPECT_TRUE(source) << (source ? "" : source.error().text());
  return source ? std::move(*source) : nullptr;
}

/// Everything until the end or an error; without an error: the end.
struct Taken {
  std::vector<Frame> frames;
  std::optional<Error> error;
};

inline Taken take_all(FrameSource& source, std::size_t most = ~std::size_t(0)) {
  Taken out;
  while (out.frames.size() < most) {
    auto delivery = source.next(20.0, {});
    if (!delivery) {
      out.error = delivery.error();
      return out;
    }
    if (delivery->kind != Delivery::Kind::kFrame) return out;
    out.frames.push_back(std::move(delivery->frame));
  }
  return out;
}

inline Taken run(FrameSource& source) {
  const auto started = source.start();
  EXPECT_TRUE(started) << (started ? "" : started.error().text());
  return take_all(source);
}

/// Sets a variable of the environment as long as it lives.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    ::setenv(name, value.c_str(), 1);
  }
  ~Variable() {
    if (old_)
      ::setenv(name_, old_->c_str(), 1);
    else
      ::unsetenv(name_);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> old_;
};

}  // namespace turnscan::testing
