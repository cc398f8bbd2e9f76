# CMake package: find_package(turnscan) gives turnscan::turnscan. The libraries of the floors come along
# as its parts.
include(CMakePackageConfigHelpers)

get_property(floors GLOBAL PROPERTY TURNSCAN_FLOORS)
install(TARGETS ${floors} EXPORT turnscanTargets
        ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development
        FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT development)
install(EXPORT turnscanTargets NAMESPACE turnscan::
        DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/turnscan" COMPONENT development)
configure_package_config_file(
  "${CMAKE_CURRENT_LIST_DIR}/turnscanConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/turnscanConfig.cmake"
  INSTALL_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/turnscan")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/turnscanConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/turnscanConfig.cmake"
              "${PROJECT_BINARY_DIR}/turnscanConfigVersion.cmake"
        DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/turnscan" COMPONENT development)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/data/scanners"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/turnscan")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" "${PROJECT_SOURCE_DIR}/README.md"
              "${PROJECT_SOURCE_DIR}/CHANGELOG.md" "${PROJECT_SOURCE_DIR}/CONTRIBUTING.md"
        DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs" DESTINATION "${CMAKE_INSTALL_DOCDIR}")

# The manual as a site that can be searched: what makes packages builds this target before. An
# installation without it has the pages alone.
find_program(TURNSCAN_MKDOCS mkdocs)
mark_as_advanced(TURNSCAN_MKDOCS)
if(TURNSCAN_MKDOCS)
  add_custom_target(turnscan_site
    COMMAND "${PROJECT_SOURCE_DIR}/scripts/docs" "${PROJECT_BINARY_DIR}/site" VERBATIM)
endif()
install(DIRECTORY "${PROJECT_BINARY_DIR}/site/" DESTINATION "${CMAKE_INSTALL_DOCDIR}/html" OPTIONAL)
