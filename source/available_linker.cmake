# deal.II hands on the linker that it was built with, which need not be here:
# Debian 13's names mold and does not depend on it.
if("${DEAL_II_LINKER_FLAGS}" MATCHES "-fuse-ld=([^ ;]+)")
  set(CREVASSE_LINKER_FLAG "${CMAKE_MATCH_0}")
  unset(CREVASSE_LINKER CACHE)
  find_program(CREVASSE_LINKER NAMES "ld.${CMAKE_MATCH_1}" "${CMAKE_MATCH_1}")
  if(NOT CREVASSE_LINKER)
    string(REPLACE "${CREVASSE_LINKER_FLAG}" "" DEAL_II_LINKER_FLAGS
      "${DEAL_II_LINKER_FLAGS}")
  endif()
endif()
