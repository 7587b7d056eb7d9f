# What every translation unit of ours is compiled with.
#   rawtexel_flags     language level and floating-point rules: part of the ABI of our headers, so it is exported
#   rawtexel_warnings  for our own code only
add_library(rawtexel_flags INTERFACE)
set_target_properties(rawtexel_flags PROPERTIES EXPORT_NAME flags)
target_compile_features(rawtexel_flags INTERFACE cxx_std_20)
# A product and a sum are fused only where the source says so: the same bits on every instruction set.
target_compile_options(rawtexel_flags INTERFACE -ffp-contract=off -fno-fast-math)
# Scalar, SSE4, AVX2 and AVX3 are what we build and test; the targets between them would only lengthen the build.
target_compile_definitions(rawtexel_flags INTERFACE
  "HWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_AVX3_DL)")

add_library(rawtexel_warnings INTERFACE)
target_compile_options(rawtexel_warnings INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion
  $<$<BOOL:${RAWTEXEL_WERROR}>:-Werror>
  # g++ 12 reports the deliberately undefined vectors of its own AVX-512 header, and sums of its own strings (PR 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-uninitialized -Wno-maybe-uninitialized -Wno-restrict>)

# rawtexel_optimise(TARGET LEVEL) for what computes little by itself: it takes longer to compile than it ever runs.
function(rawtexel_optimise target level)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${level}>)
endfunction()

# rawtexel_precompile(TARGET HEADER...) parses foreign headers once for a whole target of tests, half of what compiling one takes. A source
# still includes whatever it uses. Optimised code is better off without: g++ 12 then takes system headers for ours and warns about them.
function(rawtexel_precompile target)
  target_precompile_headers(${target} PRIVATE ${ARGN})
  # Lets ccache see what the precompiled header was made of.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endfunction()

set(RAWTEXEL_SANITIZE "" CACHE STRING "Sanitizers to build with: address, undefined, thread or a comma-separated list")
if(RAWTEXEL_SANITIZE)
  add_compile_options(-fsanitize=${RAWTEXEL_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${RAWTEXEL_SANITIZE})
endif()
