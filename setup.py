"""The Python module, built in two ways. catkin_python_setup() takes its files, and catkin's CMake adds the compiled parts.
`pip install .` needs no ROS: it has src/core compile the part for arrays, and leaves out the fleet, which is of bags."""
import os
import pathlib
import shutil
import subprocess
import sys
from xml.etree import ElementTree

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HERE = pathlib.Path(__file__).resolve().parent
MANIFEST = ElementTree.parse(HERE / "package.xml").getroot()
NAME = MANIFEST.findtext("name")
BY_CATKIN = "CATKIN_BINARY_DIR" in os.environ  # set while catkin installs


class PartForArrays(build_ext):
    """Compiles _core and the library in it."""

    def build_extension(self, ext):
        build, part = pathlib.Path(self.build_temp).absolute(), pathlib.Path(self.get_ext_fullpath(ext.name))
        os.environ.setdefault("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count()))
        subprocess.run(["cmake", "-S", HERE / "src/core", "-B", build, "-DBUILD_TESTING=OFF",
                        f"-DPYTHON_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", build, "--target", f"{NAME}_python_core"], check=True)
        part.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(build / "python" / NAME / part.name, part)


setup(
    name=NAME,
    version=MANIFEST.findtext("version"),
    description=" ".join(MANIFEST.findtext("description").split()),
    license=MANIFEST.findtext("license"),
    python_requires=">=3.8",
    install_requires=["numpy"],
    packages=[NAME] + ([f"{NAME}.fleet"] if BY_CATKIN else []),
    package_dir={"": "python"},
    package_data={NAME: ["py.typed", "*.pyi"], f"{NAME}.fleet": ["report_page/*"]},
    ext_modules=[] if BY_CATKIN else [Extension(f"{NAME}._core", sources=[])],
    cmdclass={"build_ext": PartForArrays},
)
