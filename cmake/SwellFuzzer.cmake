# Ten seconds of each fuzzer as tests, if SWELL_FUZZ_CXX can link libFuzzer and the sanitizers; they
# are built by the first of these tests, so that other builds need not wait for them.
set(source ${CMAKE_BINARY_DIR}/has_fuzzer.cc)
file(WRITE ${source} "extern \"C\" int LLVMFuzzerTestOneInput(const char*, decltype(sizeof 1)) { return 0; }\n")
if(NOT DEFINED SWELL_HAS_FUZZER)
  execute_process(
    COMMAND ${SWELL_FUZZ_CXX} -fsanitize=fuzzer,address,undefined ${source} -o ${source}.out
    RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
  if(failed EQUAL 0)
    set(SWELL_HAS_FUZZER ON CACHE INTERNAL "clang has libFuzzer")
  else()
    set(SWELL_HAS_FUZZER OFF CACHE INTERNAL "clang has libFuzzer")
    message(STATUS "No libFuzzer for ${SWELL_FUZZ_CXX}: the tests fuzz.* are left out")
  endif()
endif()
if(SWELL_HAS_FUZZER)
  set(fuzz ${CMAKE_SOURCE_DIR}/scripts/fuzz --build ${CMAKE_BINARY_DIR}/fuzz)
  add_test(NAME fuzz.build COMMAND ${fuzz} --build-only)
  set_tests_properties(fuzz.build PROPERTIES
    LABELS "fuzz;slow" TIMEOUT 1800 FIXTURES_SETUP fuzzers PROCESSORS 2
    ENVIRONMENT "SWELL_FUZZ_CXX=${SWELL_FUZZ_CXX}")
  foreach(target gltf image obj pbrt ply)
    add_test(NAME fuzz.${target} COMMAND ${fuzz} --no-build --seconds 10 ${target})
    set_tests_properties(fuzz.${target} PROPERTIES
      LABELS "fuzz;slow" TIMEOUT 120 FIXTURES_REQUIRED fuzzers)
  endforeach()
endif()
