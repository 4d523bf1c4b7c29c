# swell_add_kernels(TARGET SOURCE...): compiles each kernel source twice into TARGET, with all lanes of
# every SIMD target and with one lane of the same arithmetic (--engine megakernel).
#
# Targets: AVX-512, AVX2, SSE4, NEON and scalar. SVE and RVV are off because bundles of lanes (Vec3) need
# sized vectors; SSSE3 and AVX3_DL are off for build time. The one-lane build needs AVX2 for its fused
# multiply-add and scalar as the fallback.
set(SWELL_DISABLED_TARGETS
  "(HWY_SSSE3|HWY_AVX3_DL|HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128|HWY_RVV|HWY_WASM|HWY_WASM_EMU256|HWY_PPC8)")

function(swell_add_kernels target)
  if(NOT ARGN)
    return()
  endif()
  foreach(width wide one_lane)
    add_library(${target}_${width} OBJECT ${ARGN})
    target_link_libraries(${target}_${width} PRIVATE swell_options PkgConfig::HWY)
    target_compile_definitions(${target}_${width} PRIVATE HWY_BROKEN_EMU128=1)
    # Kernels are measured code: a debug build of the host keeps them optimised.
    target_compile_options(${target}_${width} PRIVATE -O3 -fno-math-errno -fno-trapping-math)
    # Highway's tables are local constants, which GCC would copy to the stack at each use: a kilobyte for
    # each Compress on AVX2. No code asks whether two constants have one address.
    target_compile_options(${target}_${width} PRIVATE -fmerge-all-constants)
    if(SWELL_SANITIZE)
      # Tracking variables through sanitized lanes takes the compiler tens of minutes.
      target_compile_options(${target}_${width} PRIVATE -O1 -g1 -fno-var-tracking)
    endif()
    if(SWELL_NATIVE)
      target_compile_options(${target}_${width} PRIVATE -march=native)
      target_compile_definitions(${target}_${width} PRIVATE HWY_COMPILE_ONLY_STATIC)
    endif()
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${target}_${width}>)
  endforeach()
  target_compile_definitions(${target}_wide PRIVATE "HWY_DISABLED_TARGETS=${SWELL_DISABLED_TARGETS}")
  target_compile_definitions(${target}_one_lane PRIVATE SWELL_ONE_LANE
    "HWY_DISABLED_TARGETS=(${SWELL_DISABLED_TARGETS}|HWY_AVX3|HWY_SSE4)")
endfunction()
