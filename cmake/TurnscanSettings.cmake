# Compile settings of our own code.

set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
find_program(TURNSCAN_CCACHE ccache)
if(TURNSCAN_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # What ccache asks for to work with precompiled headers: it hashes them, and sources name no time.
  # Paths below the project are hashed relative to it, so that another check-out finds the same.
  set(CMAKE_CXX_COMPILER_LAUNCHER
      "${CMAKE_COMMAND};-E;env;CCACHE_SLOPPINESS=pch_defines,time_macros"
      "CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}" "${TURNSCAN_CCACHE}")
  set(CMAKE_C_COMPILER_LAUNCHER "${TURNSCAN_CCACHE}")
endif()

add_library(turnscan_settings INTERFACE)
target_compile_features(turnscan_settings INTERFACE cxx_std_20)
# -ffp-contract=off: the same bytes with and without FMA units.
target_compile_options(turnscan_settings INTERFACE -ffp-contract=off)
# Eigen would call them by name on arm64, where every processor has them. GCC 12 notes there how older
# ones passed pairs.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  target_compile_options(turnscan_settings INTERFACE -U__ARM_FEATURE_FMA
                                                     "$<$<CXX_COMPILER_ID:GNU>:-Wno-psabi>")
endif()
add_library(turnscan_warnings INTERFACE)
target_compile_options(turnscan_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow
                                                   -Wnon-virtual-dtor -Woverloaded-virtual)
# GCC 12 sees uninitialised values in every std::optional<double> that it inlines, and
# overlapping copies in assignments of literals to std::string (GCC bug 105651).
target_compile_options(turnscan_warnings
                       INTERFACE "$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized;-Wno-restrict>")
if(TURNSCAN_WERROR)
  target_compile_options(turnscan_warnings INTERFACE -Werror)
endif()
# VTK's CMake targets name more libraries than one calls: programs load only those that they call.
add_link_options(-Wl,--as-needed)
if(TURNSCAN_SANITIZE)
  add_compile_options(-fsanitize=${TURNSCAN_SANITIZE} -fno-omit-frame-pointer
                      -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${TURNSCAN_SANITIZE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    # Half of the time of the build, for little: what other projects' headers do (Eigen checks its
    # indices itself), and accesses that the address sanitizer sees, too.
    add_compile_options("-fsanitize-ignorelist=${CMAKE_CURRENT_LIST_DIR}/sanitize_ignore.txt")
    if(TURNSCAN_SANITIZE MATCHES "undefined")
      add_compile_options(-fno-sanitize=null,object-size,vptr,nonnull-attribute,returns-nonnull-attribute)
    endif()
  endif()
  if(TURNSCAN_SANITIZE STREQUAL "thread")
    add_compile_definitions(TURNSCAN_PLAIN_THREADS)
  endif()
endif()
