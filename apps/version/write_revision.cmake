# Writes OUT, a C++ source that names the tag and the revision of SOURCE, unless it says so already:
# "v0.1.0, 33e5837c", with "-dirty" where files differ from it; nothing where SOURCE is no check-out
# of its own, as in a release's archive.
cmake_minimum_required(VERSION 3.25)

function(git result)
  execute_process(COMMAND "${GIT}" -C "${SOURCE}" ${ARGN} OUTPUT_VARIABLE text ERROR_QUIET
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

set(name "")
if(GIT)
  git(top rev-parse --show-toplevel)
  file(REAL_PATH "${SOURCE}" source)
  if(top STREQUAL source)
    git(tag describe --tags --exact-match)
    git(revision describe --always --abbrev=8 --exclude=* --dirty)
    set(parts ${tag} ${revision})
    list(JOIN parts ", " name)
  endif()
endif()

set(text "#include <version/named_version.hpp>\n\nconst char* const turnscan::kRevision = \"${name}\";\n")
set(written "")
if(EXISTS "${OUT}")
  file(READ "${OUT}" written)
endif()
if(NOT written STREQUAL text)
  file(WRITE "${OUT}" "${text}")
endif()
