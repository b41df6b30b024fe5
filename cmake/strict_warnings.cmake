# Our own code compiles without a warning. A compiler newer than the ones we test may find new ones: then turn the option off.
option(WARNINGS_AS_ERRORS "Stop at a compiler warning in this package's own code" ON)
set(strict_warnings -Wall -Wextra -Wpedantic -Wshadow $<$<BOOL:${WARNINGS_AS_ERRORS}>:-Werror>)
