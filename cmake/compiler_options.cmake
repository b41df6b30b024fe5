# Our own code compiles without a warning, and scripts/ hold it to that. Other compilers than the tested ones may find
# some, which stop no user's build.
option(WARNINGS_AS_ERRORS "Stop at a compiler warning in this package's own code" OFF)
set(strict_warnings -Wall -Wextra -Wpedantic -Wshadow $<$<BOOL:${WARNINGS_AS_ERRORS}>:-Werror>)

# CMake's own choice, -O3, takes the compiler longer and makes nothing here faster (scripts/benchmark).
if(CMAKE_CXX_FLAGS_RELEASE STREQUAL "-O3 -DNDEBUG")
  set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
endif()
