# Writes a C++ file that defines what the programs are built from, if it would change, or with -D CHECK=1 fails if it
# would. The build runs it each time, because git and the deletion of a file change nothing that ninja looks at.
#
# cmake -D SOURCE=<the project's folder> -D FACTS=<build_info.h> -D OUT=<file> [-D CHECK=1] -P write_build.cmake
cmake_minimum_required(VERSION 3.22)
file(GLOB_RECURSE files RELATIVE ${SOURCE} ${SOURCE}/algorithms/* ${SOURCE}/harness/*)
list(FILTER files INCLUDE REGEX "\\.(h|inl|cpp|c|in|map|txt|cmake)$")
list(APPEND files CMakeLists.txt CMakePresets.json)
list(SORT files)
set(all "")
foreach(file IN LISTS files)
  file(SHA256 ${SOURCE}/${file} hash)
  string(APPEND all "${hash} ${file}\n")
endforeach()
string(SHA256 sources "${all}")
string(SUBSTRING ${sources} 0 16 sources)
file(SHA256 ${FACTS} facts)
string(SHA256 id "${sources} ${facts}")
string(SUBSTRING ${id} 0 16 id)

# git(<variable> <arguments...>) sets the variable to git's output, or to "unknown".
function(git variable)
  execute_process(COMMAND git -C ${SOURCE} ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_QUIET
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT status STREQUAL 0)
    set(text unknown)
  endif()
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

# The sources of an archive may lie in the repository of something else.
set(commit unknown)
set(tree unknown)
git(top rev-parse --show-toplevel)
file(REAL_PATH ${SOURCE} source)
if(top STREQUAL source)
  git(commit rev-parse HEAD)
endif()
if(NOT commit STREQUAL unknown)
  git(changes status --porcelain -- algorithms harness CMakeLists.txt CMakePresets.json ":(exclude)*.md")
  if(changes STREQUAL "")
    set(tree clean)
  elseif(NOT changes STREQUAL unknown)
    set(tree changed)
  endif()
endif()

set(text "// Written by harness/record/write_build.cmake.
#include \"harness/record/build.h\"

namespace touchstone::commands {
extern const record::Build this_build;
const record::Build this_build{\"${commit}\", \"${tree}\", \"${sources}\", \"${id}\"};
}  // namespace touchstone::commands
")
set(before "")
if(EXISTS ${OUT})
  file(READ ${OUT} before)
endif()
if(CHECK)
  if(NOT before MATCHES "\"${id}\"")
    message(FATAL_ERROR "the sources changed while they were compiled: build again")
  endif()
elseif(NOT before STREQUAL text)
  file(WRITE ${OUT} "${text}")
endif()
