# Kernels: inner loops that are compiled once per instruction set, and chosen among at run time.

# turnscan_kernels(TARGET NAME [OPTIONS option...])
# Compiles the body NAME.inl with the options once for each instruction set that the processor may
# have, in sources made from kernel.cpp.in. For the body they define
#   TURNSCAN_INSTRUCTION_SET  turnscan::InstructionSet::kPortable, kAvx2 or kAvx512
#   TURNSCAN_NATIVE_LANES     floats in a vector of it: 4, 8 or 16
#   TURNSCAN_INLINE           inline, however large
# A body ends with its turnscan::built_kernel (core/simd/kernel_choice.hpp); NAME.cpp chooses.
function(turnscan_kernels target name)
  cmake_parse_arguments(KERNEL "" "" "OPTIONS" ${ARGN})
  set(sets portable)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    list(APPEND sets avx2 avx512)
  endif()
  set(name_portable kPortable)
  set(name_avx2 kAvx2)
  set(name_avx512 kAvx512)
  set(lanes_portable 4)
  set(lanes_avx2 8)
  set(lanes_avx512 16)
  set(flags_portable)
  set(flags_avx2 -mavx2)
  set(flags_avx512 -mavx512f -mavx512dq -mavx512bw -mavx512vl -mprefer-vector-width=512)
  # GCC 12 warns about its own _mm512_undefined_ps (GCC bug 105593).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    list(APPEND flags_avx512 -Wno-maybe-uninitialized -Wno-uninitialized)
  endif()
  file(RELATIVE_PATH body "${PROJECT_SOURCE_DIR}/src" "${CMAKE_CURRENT_SOURCE_DIR}/${name}.inl")
  foreach(set IN LISTS sets)
    set(set_name ${name_${set}})
    set(set_lanes ${lanes_${set}})
    set(source "${CMAKE_CURRENT_BINARY_DIR}/${name}_${set}.cpp")
    configure_file("${CMAKE_CURRENT_FUNCTION_LIST_DIR}/kernel.cpp.in" "${source}" @ONLY)
    target_sources(${target} PRIVATE "${source}")
    turnscan_source_options("${source}" OPTIONS ${KERNEL_OPTIONS} ${flags_${set}})
  endforeach()
endfunction()
