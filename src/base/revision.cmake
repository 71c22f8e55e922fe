# cmake -DSOURCE=... -DOUT=... -DVERSION=... -P revision.cmake: write revision.h, and touch it only when it changes.
cmake_minimum_required(VERSION 3.25)
set(revision "unknown")
find_program(GIT git)
if(GIT)
  execute_process(COMMAND ${GIT} -C ${SOURCE} rev-parse --short=10 HEAD OUTPUT_VARIABLE head RESULT_VARIABLE failed
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(failed EQUAL 0)
    set(revision ${head})
    execute_process(COMMAND ${GIT} -C ${SOURCE} diff --quiet HEAD -- src include CMakeLists.txt
                    RESULT_VARIABLE changed ERROR_QUIET OUTPUT_QUIET)
    if(NOT changed EQUAL 0)
      string(APPEND revision "-changed")
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT ${OUT} @ONLY CONTENT "#define FW_VERSION \"@VERSION@\"\n#define FW_REVISION \"@revision@\"\n")
