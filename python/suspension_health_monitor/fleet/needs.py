"""What the fleet needs and a robot does not: Python modules, with the packages of Debian and Ubuntu that have them."""
import importlib.util

PACKAGES = {"distributed": "python3-distributed", "plotly": "python3-plotly", "scipy": "python3-scipy",
            "sqlalchemy": "python3-sqlalchemy"}
PACKAGES_OF_SOME = {"psycopg2": "python3-psycopg2"}  # of those with PostgreSQL


def missing(error):
    """:returns: what to install, in words: all that the fleet misses, not only the module of a ModuleNotFoundError."""
    name = error.name.partition(".")[0]
    packages = {package for module, package in PACKAGES.items() if importlib.util.find_spec(module) is None}
    if name in PACKAGES_OF_SOME:
        packages.add(PACKAGES_OF_SOME[name])
    if not packages:
        return f"the Python module {name} is not installed"
    return f"Python modules are not installed: apt-get install {' '.join(sorted(packages))}"
