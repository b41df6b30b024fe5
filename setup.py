"""For catkin_python_setup(): the files of the Python module. Its compiled parts are built and installed by CMake."""
from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

setup(**generate_distutils_setup(
    packages=["suspension_health_monitor", "suspension_health_monitor.fleet"],
    package_dir={"": "python"},
    package_data={"suspension_health_monitor": ["py.typed", "*.pyi"],
                  "suspension_health_monitor.fleet": ["report_page/*"]},
))
