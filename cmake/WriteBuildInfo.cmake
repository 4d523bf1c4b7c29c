# Script of swell_build_info: takes GIT, SOURCE_DIR, COMPILER, VERSION and HEADER; writes HEADER if it changes.
set(revision unknown)
if(GIT)
  # A checkout without .git may lie inside another repository, whose revision is not ours.
  execute_process(COMMAND ${GIT} -C ${SOURCE_DIR} rev-parse --show-prefix
    OUTPUT_VARIABLE prefix RESULT_VARIABLE failed OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(failed EQUAL 0 AND prefix STREQUAL "")
    execute_process(COMMAND ${GIT} -C ${SOURCE_DIR} describe --always --dirty --abbrev=12 --exclude=*
      OUTPUT_VARIABLE described RESULT_VARIABLE failed OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(failed EQUAL 0)
      set(revision ${described})
    endif()
  endif()
endif()

set(text "// The revision and the compiler that this build was made of; written by the build.
#ifndef SWELL_GENERATED_BUILD_INFO_H_
#define SWELL_GENERATED_BUILD_INFO_H_

#define SWELL_GIT_REVISION \"${revision}\"
#define SWELL_COMPILER \"${COMPILER}\"
#define SWELL_VERSION \"${VERSION}\"

#endif  // SWELL_GENERATED_BUILD_INFO_H_
")
set(old "")
if(EXISTS ${HEADER})
  file(READ ${HEADER} old)
endif()
if(NOT old STREQUAL text)
  file(WRITE ${HEADER} "${text}")
endif()
