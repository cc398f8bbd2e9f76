#pragma once
// TURNSCAN_FUZZ_TARGET(NAME) { ... } defines what is done with one input: the bytes data, of length
// size. With libFuzzer (TURNSCAN_FUZZER) each source is a program of its own; otherwise all are
// part of one program (replay.cpp) that finds them by their names.

#include <cstddef>
#include <cstdint>
#include <map>
#include <string_view>

namespace turnscan::fuzz {

using Target = int (*)(const std::uint8_t* data, std::size_t size);

/// The targets that are linked in, by name.
inline std::map<std::string_view, Target>& targets() {
  static std::map<std::string_view, Target> all;
  return all;
}

}  // namespace turnscan::fuzz

#ifdef TURNSCAN_FUZZER
#define TURNSCAN_FUZZ_TARGET(name) \
  extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
#else
#define TURNSCAN_FUZZ_TARGET(name)                                    \
  static int fuzz_##name(const std::uint8_t* data, std::size_t size); \
  static const bool fuzz_##name##_is_known =                          \
      turnscan::fuzz::targets().emplace(#name, fuzz_##name).second;   \
  static int fuzz_##name([[maybe_unused]] const std::uint8_t* data,   \
                         [[maybe_unused]] std::size_t size)
#endif
