"""To be imported first: ends a script with a sentence where no setup file that knows the built package is sourced."""
import importlib.util
import sys

if importlib.util.find_spec("suspension_health_monitor") is None:
    sys.exit(f"{sys.argv[0]}: the package is not found: build it, and source its devel/setup.bash")
