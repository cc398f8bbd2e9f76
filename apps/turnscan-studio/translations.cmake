# Translations become a part of the program where Qt's lrelease is found; without it the window is
# English. `scripts/translate` takes new texts over into i18n/*.ts.
find_program(TURNSCAN_LRELEASE NAMES lrelease lrelease-qt5 HINTS /usr/lib/qt5/bin)
if(NOT TURNSCAN_LRELEASE)
  message(STATUS "turnscan-studio is English only: lrelease is missing (scripts/setup)")
  return()
endif()
set(folder "${CMAKE_CURRENT_BINARY_DIR}/i18n")
set(files "")
set(entries "")
foreach(language es de fr)
  set(source "${CMAKE_CURRENT_SOURCE_DIR}/i18n/studio_${language}.ts")
  add_custom_command(OUTPUT "${folder}/studio_${language}.qm"
    COMMAND "${CMAKE_COMMAND}" -E make_directory "${folder}"
    COMMAND "${TURNSCAN_LRELEASE}" -silent "${source}" -qm "${folder}/studio_${language}.qm"
    DEPENDS "${source}" VERBATIM)
  list(APPEND files "${folder}/studio_${language}.qm")
  string(APPEND entries "<file>studio_${language}.qm</file>")
endforeach()
file(CONFIGURE OUTPUT "${folder}/translations.qrc"
     CONTENT "<RCC><qresource prefix=\"/studio/i18n\">${entries}</qresource></RCC>\n")
add_custom_command(OUTPUT "${folder}/qrc_translations.cpp"
  COMMAND Qt5::rcc --name translations --output "${folder}/qrc_translations.cpp" "${folder}/translations.qrc"
  DEPENDS ${files} "${folder}/translations.qrc" VERBATIM)
target_sources(turnscan_studio PRIVATE "${folder}/qrc_translations.cpp")
set_source_files_properties("${folder}/qrc_translations.cpp" PROPERTIES
  SKIP_AUTOGEN ON SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
target_compile_definitions(turnscan_studio PUBLIC TURNSCAN_STUDIO_TRANSLATED)
