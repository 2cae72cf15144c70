# Compiler settings that every target shares: warnings (private to the project), the numerical contract, the instruction set.

find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE})
endif()

add_library(talus_warnings INTERFACE)
target_compile_options(talus_warnings INTERFACE
  $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-align>)

# The same bits on every run and with any number of threads, of one build: no contraction into fused operations, no reassociation. Another
# compiler, mathematical library or instruction set may round differently.
# -fno-math-errno only drops errno, which lets square roots vectorise.
add_library(talus_numerics INTERFACE)
target_compile_options(talus_numerics INTERFACE -ffp-contract=off -fno-math-errno)

if(TALUS_CPU)
  target_compile_options(talus_numerics INTERFACE -march=${TALUS_CPU})
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  include(CheckCXXSourceRuns)
  check_cxx_source_runs("int main() { return __builtin_cpu_supports(\"avx2\") && __builtin_cpu_supports(\"fma\")
                                             && __builtin_cpu_supports(\"bmi2\") ? 0 : 1; }" TALUS_HAS_X86_64_V3)
  if(TALUS_HAS_X86_64_V3)
    target_compile_options(talus_numerics INTERFACE -march=x86-64-v3)
  endif()
endif()

if(TALUS_SANITIZE)
  add_compile_options(-fsanitize=${TALUS_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${TALUS_SANITIZE})
endif()
