# Precompiled headers: half of the time of a cold build went into parsing the same few headers.
#
# A build without them tells when a file forgets an include: clang-tidy's
# (CMAKE_DISABLE_PRECOMPILE_HEADERS), and the target all_verify_interface_header_sets.
option(TURNSCAN_PRECOMPILE "Build the libraries and programs with precompiled headers" ON)

set(TURNSCAN_COMMON_HEADERS
    <algorithm> <array> <atomic> <chrono> <cmath> <cstdint> <cstring> <deque> <filesystem> <functional>
    <limits> <map> <memory> <mutex> <numbers> <numeric> <optional> <span> <string> <string_view>
    <thread> <variant> <vector> <Eigen/Dense> <fmt/format.h> <nlohmann/json.hpp>
    <oneapi/tbb/blocked_range.h> <oneapi/tbb/parallel_for.h> <tl/expected.hpp>)

# A source with flags of its own (an instruction set, say) cannot use them:
# turnscan_source_options(SOURCE... OPTIONS option...)
function(turnscan_source_options)
  cmake_parse_arguments(SOURCE "" "" "OPTIONS" ${ARGN})
  set_source_files_properties(${SOURCE_UNPARSED_ARGUMENTS} PROPERTIES
                              COMPILE_OPTIONS "${SOURCE_OPTIONS}"
                              SKIP_PRECOMPILE_HEADERS ON)
endfunction()

# turnscan_precompile(TARGET HEADERS...): what TARGET hands to those that REUSE_FROM it. Clang would
# note the headers' times, and refuse a file from ccache when they are those of another check-out.
function(turnscan_precompile target)
  target_precompile_headers(${target} PRIVATE ${ARGN})
  target_compile_options(${target} PRIVATE
                         "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
endfunction()

if(TURNSCAN_PRECOMPILE)
  add_library(turnscan_precompiled OBJECT "${CMAKE_CURRENT_LIST_DIR}/empty.cpp")
  target_link_libraries(turnscan_precompiled PRIVATE Eigen3::Eigen fmt::fmt tl::expected
                                                     nlohmann_json::nlohmann_json TBB::tbb
                                                     turnscan_settings turnscan_warnings)
  turnscan_precompile(turnscan_precompiled ${TURNSCAN_COMMON_HEADERS})
endif()

# turnscan_use_precompiled(TARGET): if the library is built with them.
function(turnscan_use_precompiled target)
  if(TURNSCAN_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM turnscan_precompiled)
    # GCC 12 forgets that precompiled headers are the system's, and sees overlong copies in their
    # strings and vectors (GCC bug 105329).
    target_compile_options(
      ${target} PRIVATE "$<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread>")
  endif()
endfunction()
