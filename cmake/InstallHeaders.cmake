# Installs the public headers (run by `cmake --install`). Each of them checks the compiler and its flags before all else.
# Needs `python`, `repository`, `folder` (of the headers, below the prefix), `work` and `checks` (the folder of
# kinegraph/build_check.h).
execute_process(COMMAND "${python}" "${repository}/tools/public_headers.py" "${repository}/src"
                OUTPUT_VARIABLE public OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE "\n" ";" public "${public}")
foreach(header IN LISTS public)
  get_filename_component(room "${header}" DIRECTORY)
  if(header STREQUAL "kinegraph/common/compiler_check.h")
    set(checked "${repository}/src/${header}")
  else()
    set(checked "${work}/${header}")
    file(READ "${repository}/src/${header}" text)
    string(REPLACE "#pragma once\n" "#pragma once\n#include \"kinegraph/common/compiler_check.h\"\n" guarded "${text}")
    if(guarded STREQUAL text)
      message(FATAL_ERROR "${header} does not begin with '#pragma once'")
    endif()
    file(CONFIGURE OUTPUT "${checked}" CONTENT "${guarded}" @ONLY)
  endif()
  file(INSTALL DESTINATION "${CMAKE_INSTALL_PREFIX}/${folder}/${room}" TYPE FILE FILES "${checked}")
endforeach()
file(INSTALL DESTINATION "${CMAKE_INSTALL_PREFIX}/${folder}/kinegraph" TYPE FILE FILES "${checks}/kinegraph/build_check.h")
