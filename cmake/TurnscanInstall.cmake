# CMake package: find_package(turnscan) gives turnscan::core, turnscan::reconstruction, ...
include(CMakePackageConfigHelpers)

get_property(floors GLOBAL PROPERTY TURNSCAN_FLOORS)
install(TARGETS ${floors} EXPORT turnscanTargets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(EXPORT turnscanTargets NAMESPACE turnscan::
        DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/turnscan")
configure_package_config_file(
  "${CMAKE_CURRENT_LIST_DIR}/turnscanConfig.cmake.in"
  "${CMAKE_BINARY_DIR}/turnscanConfig.cmake"
  INSTALL_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/turnscan")
write_basic_package_version_file("${CMAKE_BINARY_DIR}/turnscanConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_BINARY_DIR}/turnscanConfig.cmake"
              "${CMAKE_BINARY_DIR}/turnscanConfigVersion.cmake"
              "${CMAKE_CURRENT_LIST_DIR}/TurnscanPcl.cmake"
        DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/turnscan")
# In the build tree programs find the presets where they do after installation.
file(MAKE_DIRECTORY "${CMAKE_BINARY_DIR}/share")
file(CREATE_LINK "${CMAKE_SOURCE_DIR}/data" "${CMAKE_BINARY_DIR}/share/turnscan" SYMBOLIC)
install(DIRECTORY "${CMAKE_SOURCE_DIR}/data/scanners"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/turnscan")
install(FILES "${CMAKE_SOURCE_DIR}/LICENSE" "${CMAKE_SOURCE_DIR}/README.md"
        DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(DIRECTORY "${CMAKE_SOURCE_DIR}/docs" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
