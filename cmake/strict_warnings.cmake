# Our own code compiles without a warning. A newer compiler than the tested ones may find some: then turn this off.
option(WARNINGS_AS_ERRORS "Stop at a compiler warning in this package's own code" ON)
set(strict_warnings -Wall -Wextra -Wpedantic -Wshadow $<$<BOOL:${WARNINGS_AS_ERRORS}>:-Werror>)
