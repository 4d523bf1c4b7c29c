# swell_add_test(NAME LABELS label... SOURCES file... [LIBS target...] [TIMEOUT seconds])
#   builds a doctest executable and runs it as one test of ctest.
# swell_add_python_test(NAME SCRIPT file LABELS label... [ARGS argument...] [TIMEOUT seconds])
#   runs a Python file as one test of ctest.
find_package(doctest REQUIRED)
find_package(Python3 REQUIRED COMPONENTS Interpreter)

# doctest itself is compiled once.
add_library(swell_test_main OBJECT ${CMAKE_SOURCE_DIR}/tests/support/test_main.cc)
target_link_libraries(swell_test_main PRIVATE swell_options doctest::doctest)

set(SWELL_TEST_ENVIRONMENT "LC_ALL=C.UTF-8")
if(SWELL_SANITIZE)
  list(APPEND SWELL_TEST_ENVIRONMENT
    "ASAN_OPTIONS=strict_string_checks=1:detect_stack_use_after_return=1:allocator_may_return_null=1"
    "UBSAN_OPTIONS=print_stacktrace=1"
    "TSAN_OPTIONS=second_deadlock_stack=1:suppressions=${CMAKE_SOURCE_DIR}/tests/support/tsan.supp")
endif()

function(swell_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "TIMEOUT" "LABELS;SOURCES;LIBS")
  if(arg_UNPARSED_ARGUMENTS OR NOT arg_LABELS OR NOT arg_SOURCES)
    message(FATAL_ERROR "swell_add_test(${name}): needs LABELS and SOURCES; unknown: ${arg_UNPARSED_ARGUMENTS}")
  endif()
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE swell_options swell_test_main doctest::doctest ${arg_LIBS})
  add_test(NAME ${name} COMMAND ${name} WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
  set_tests_properties(${name} PROPERTIES
    LABELS "${arg_LABELS}"
    TIMEOUT ${arg_TIMEOUT}
    ENVIRONMENT "${SWELL_TEST_ENVIRONMENT}"
    # An executable whose sources were left out would otherwise pass.
    FAIL_REGULAR_EXPRESSION "test cases: +0 ")
endfunction()

function(swell_add_python_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "SCRIPT;TIMEOUT" "LABELS;ARGS")
  if(arg_UNPARSED_ARGUMENTS OR NOT arg_LABELS OR NOT arg_SCRIPT)
    message(FATAL_ERROR "swell_add_python_test(${name}): needs LABELS and SCRIPT; unknown: ${arg_UNPARSED_ARGUMENTS}")
  endif()
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 120)
  endif()
  add_test(NAME ${name}
    COMMAND Python3::Interpreter -B ${CMAKE_SOURCE_DIR}/${arg_SCRIPT} ${arg_ARGS}
    WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
  set_tests_properties(${name} PROPERTIES LABELS "${arg_LABELS}" TIMEOUT ${arg_TIMEOUT})
endfunction()
