# The preset "sanitize" (doc/testing.md): Clang's address and undefined-behaviour
# sanitizers in everything that is ours, and counters of coverage by which
# libFuzzer finds its way. In deal.II, which remains as Debian built it, the
# assertions of the Debug flavour watch instead.

if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  message(FATAL_ERROR "CREVASSE_SANITIZE is for Clang, to which libFuzzer "
                      "belongs; see the preset \"sanitize\".")
endif()
if(NOT CMAKE_BUILD_TYPE STREQUAL "Debug")
  message(FATAL_ERROR "CREVASSE_SANITIZE is for CMAKE_BUILD_TYPE=Debug.")
endif()

# Lines of the source are enough for messages.
string(REPLACE "-ggdb" "-g1" DEAL_II_CXX_FLAGS_DEBUG "${DEAL_II_CXX_FLAGS_DEBUG}")
# Fortified functions of the C library are not those that are watched.
string(REPLACE "-D_FORTIFY_SOURCE=2" "-D_GLIBCXX_ASSERTIONS"
  DEAL_II_CXX_FLAGS "${DEAL_II_CXX_FLAGS}")

# gold warns of symbols of the sanitizers that it cannot export.
string(REPLACE "-fuse-ld=gold" "" DEAL_II_LINKER_FLAGS "${DEAL_II_LINKER_FLAGS}")

set(ignored ${CMAKE_CURRENT_LIST_DIR}/ignored.txt)
set(sanitizers -fsanitize=address,undefined,fuzzer-no-link
  -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
add_compile_options(${sanitizers} -fsanitize-ignorelist=${ignored}
  -fsanitize-coverage-ignorelist=${ignored})
add_link_options(${sanitizers})
