# Debian packages: `cpack` in the build folder makes turnscan, libturnscan-dev, and turnscan-studio and
# python3-turnscan where those parts are built. scripts/test-packages tries them.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME turnscan)
set(CPACK_PACKAGE_VENDOR turnscan)
set(CPACK_PACKAGE_CONTACT "turnscan <turnscan@example.com>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
# The programs are built for the prefix of the build folder, and find their files beside themselves.
set(CPACK_COMPONENTS_ALL programs development)
if(TARGET turnscan-studio)
  list(APPEND CPACK_COMPONENTS_ALL studio)
endif()
if(TARGET turnscan_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# What the programs link; the libraries of the drivers are looked for when they are used.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)

# turnscan_package(COMPONENT NAME SECTION SUMMARY DESCRIPTION [DEPENDS])
macro(turnscan_package component name section summary description)
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${upper}_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${summary}\n${description}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${ARGN}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_SHLIBDEPS ON)
  # Every package says its copyright and history under its own name (Debian policy 12.5, 12.7).
  foreach(file IN ITEMS copyright changelog.gz)
    install(FILES "${PROJECT_BINARY_DIR}/debian/${file}" DESTINATION "share/doc/${name}"
            COMPONENT ${component})
  endforeach()
endmacro()

file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/debian")
configure_file("${CMAKE_CURRENT_LIST_DIR}/copyright.in" "${PROJECT_BINARY_DIR}/debian/copyright"
               @ONLY)
string(TIMESTAMP TURNSCAN_PACKAGED "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file("${CMAKE_CURRENT_LIST_DIR}/changelog.in" "${PROJECT_BINARY_DIR}/debian/changelog"
               @ONLY)
execute_process(COMMAND gzip -9nc "${PROJECT_BINARY_DIR}/debian/changelog"
                OUTPUT_FILE "${PROJECT_BINARY_DIR}/debian/changelog.gz")

turnscan_package(programs turnscan graphics
  "make watertight meshes of objects on a turntable"
  "A depth sensor looks at a turntable; turnscan finds the table, records what\nstands on it while it turns, and reconstructs a closed mesh of each object.\nVirtual scanners do the same, so that a rig can be judged before it is built.")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SUGGESTS
    "libopenni2-0, libfreenect0.5, slurm-client, turnscan-studio, python3-turnscan")
turnscan_package(studio turnscan-studio graphics
  "desktop program of turnscan, a turntable scanner"
  "Shows what a depth sensor sees, records and reconstructs what stands on a\nturntable, compares and edits meshes, and simulates scanners."
  "turnscan (= ${PROJECT_VERSION})")
if(TARGET turnscan_python)
  # The module is for the Python that it was built with.
  get_directory_property(minor DIRECTORY "${PROJECT_SOURCE_DIR}/python"
                         DEFINITION Python_VERSION_MINOR)
  math(EXPR next_minor "${minor} + 1")
  turnscan_package(python python3-turnscan python
    "turntable scanning and reconstruction for Python 3"
    "Recordings, simulation, calibration, reconstruction and evaluation of turnscan\nas a Python module, with numpy's arrays."
    "turnscan (= ${PROJECT_VERSION}), python3 (>= 3.${minor}), python3 (<< 3.${next_minor}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
      "${CMAKE_CURRENT_LIST_DIR}/python3-turnscan/postinst;${CMAKE_CURRENT_LIST_DIR}/python3-turnscan/prerm")
endif()
turnscan_package(development libturnscan-dev libdevel
  "turntable scanning and reconstruction (development files)"
  "Headers, static libraries and the CMake package of turnscan."
  "libeigen3-dev, libfmt-dev, libtbb-dev, libexpected-dev, libpng-dev, libjpeg-dev, libdeflate-dev, liblz4-dev, libbz2-dev, libzstd-dev, libsqlite3-dev, libtiff-dev, libopenexr-dev, lib3mf-dev, libmeshoptimizer-dev, libgeos-dev, libembree-dev, libtomlplusplus-dev, libserialport-dev")
include(CPack)
