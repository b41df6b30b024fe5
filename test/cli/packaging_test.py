"""The package as others build, install and release it: rosdep, bloom, rosdoc, continuous integration, Docker."""
import fnmatch
import os
import pathlib
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import pytest
import rospkg
import yaml

from conftest import HANGS
from imu_bag import REPOSITORY
from suspension_health_monitor.fleet import needs

MANIFEST = ElementTree.parse(REPOSITORY / "package.xml").getroot()
SYSTEMS = ["ubuntu:focal", "ubuntu:jammy", "ubuntu:noble", "debian:bookworm"]
CACHE_OF_ROSDEP = pathlib.Path.home() / ".ros/rosdep/sources.cache/index"
LISTS = ("base.yaml", "python.yaml")


def keys_of_no_ros_package():
    keys = {element.text for element in MANIFEST if element.tag.endswith("depend")}
    return sorted(keys - set(rospkg.RosPack().list()))


def run(command, environment):
    done = subprocess.run(command, env={**os.environ, **environment}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, timeout=HANGS)
    return done.returncode, done.stdout


@pytest.fixture(scope="module")
def rosdep(tmp_path_factory):
    """The environment in which rosdep knows rosdistro's lists: those of the folder ROSDEP_LISTS, or those that
    `rosdep update` has fetched."""
    if shutil.which("rosdep") is None:
        pytest.skip("rosdep is not installed (Debian: python3-rosdep2)")
    folder = os.environ.get("ROSDEP_LISTS")
    if folder is None:
        if not CACHE_OF_ROSDEP.exists():
            pytest.skip("rosdep has no lists: run `rosdep update`, or name a folder that has rosdistro's "
                        f"{' and '.join(LISTS)} in ROSDEP_LISTS")
        return {"ROS_HOME": str(CACHE_OF_ROSDEP.parents[2])}
    home, sources = (tmp_path_factory.mktemp(name) for name in ("home", "sources"))
    lines = [f"yaml {(pathlib.Path(folder).resolve() / name).as_uri()}\n" for name in LISTS]
    (sources / "10-lists.list").write_text("".join(lines))
    environment = {"ROS_HOME": str(home), "ROSDEP_SOURCE_PATH": str(sources),
                   "ROSDISTRO_INDEX_URL": (REPOSITORY / "rosdep/index-v4.yaml").as_uri()}
    status, told = run(["rosdep", "update"], environment)
    assert status == 0, told
    return environment


@pytest.mark.parametrize("system", SYSTEMS)
def test_rosdep_knows_every_key_that_is_no_ros_package(rosdep, system):
    keys = keys_of_no_ros_package()
    assert "eigen" in keys
    status, told = run(["rosdep", "resolve", f"--os={system}", *keys], rosdep)
    assert status == 0, told
    assert sorted(re.findall(r"^#ROSDEP\[(.+)\]$", told, re.MULTILINE)) == keys


def test_a_key_that_rosdep_does_not_know_is_told(rosdep):
    status, told = run(["rosdep", "resolve", f"--os={SYSTEMS[-1]}", "no-such-key"], rosdep)
    assert status != 0 and "no rosdep rule for 'no-such-key'" in told


def test_package_xml_can_be_released():
    assert re.fullmatch(r"\d+\.\d+\.\d+", MANIFEST.findtext("version"))
    assert {url.get("type") for url in MANIFEST.findall("url")} == {"website", "repository", "bugtracker"}
    assert re.fullmatch(r"\S+@\S+", MANIFEST.find("maintainer").get("email"))
    package_version = pytest.importorskip("catkin_pkg.package_version")
    changelog = pytest.importorskip("catkin_pkg.changelog").get_changelog_from_path(str(REPOSITORY))
    assert package_version.get_forthcoming_label(changelog.rst) == "Forthcoming"


def test_rosdoc_documents_the_public_headers_the_example_and_the_pages():
    (doxygen,) = yaml.safe_load((REPOSITORY / MANIFEST.find("export/rosdoc").get("config")).read_text())
    assert doxygen["builder"] == "doxygen"
    in_workspace = pathlib.Path("/ws/src") / MANIFEST.findtext("name")
    files = [path.relative_to(REPOSITORY) for pattern in doxygen["file_patterns"].split()
             for path in REPOSITORY.rglob(pattern)]
    documented = [path for path in files if not any(fnmatch.fnmatch(str(in_workspace / path), pattern)
                                                    for pattern in doxygen["exclude_patterns"].split())]
    assert {path.parts[0] for path in documented if len(path.parts) > 1} == {"doc", "example", "include"}
    assert not any("internal" in path.parts for path in documented)


def make_ros(folder, name, *packages):
    """A folder of ROS as Ubuntu has it."""
    (folder / name).mkdir(parents=True)
    (folder / name / "setup.bash").write_text(f"export ROS_DISTRO={name}\n")
    for package in packages:
        (folder / name / "share" / package).mkdir(parents=True)


@pytest.mark.parametrize("installed, found", [
    ({"noetic": "roscpp"}, "noetic"), ({"one": "roscpp"}, "one"), ({"jazzy": "rclcpp", "one": "roscpp"}, "one"),
    ({"jazzy": "rclcpp"}, ""), ({}, "")])
def test_scripts_find_ros_1_of_any_name(tmp_path, installed, found):
    for name, package in installed.items():
        make_ros(tmp_path, name, package)
    script = f"source {REPOSITORY}/scripts/common.sh; ros_folder={tmp_path}; sourceSystemRos; echo \"${{ROS_DISTRO:-}}\""
    status, told = run(["bash", "-c", script], {"ROS_DISTRO": ""})
    assert (status, told) == (0, found + "\n")


@pytest.mark.parametrize("name", ["demo_report.py", "draw_page_picture", "draw_readme_picture", "update_tables"])
def test_a_script_says_in_one_sentence_what_to_source(name):
    status, told = run([sys.executable, "-S", REPOSITORY / "scripts" / name], {"PYTHONPATH": ""})  # -S: nor a .deb
    assert status == 1 and told.count("\n") == 1 and told.endswith("source its devel/setup.bash\n")


def test_the_image_runs_the_demo_on_debian():
    lines = (REPOSITORY / "Dockerfile").read_text().splitlines()
    assert "FROM debian:bookworm" in lines
    scripts = re.findall(r"scripts/[\w.]+", "\n".join(lines))
    assert "scripts/install_dependencies" in scripts and scripts[-1] == "scripts/demo"
    for script in scripts:
        assert (REPOSITORY / script).is_file(), script
    assert lines[-1].startswith('CMD ["scripts/demo", "--quick", "--no-install"')


def test_continuous_integration_builds_where_ros_1_lives():
    jobs = yaml.safe_load((REPOSITORY / ".github/workflows/industrial_ci.yml").read_text())["jobs"]
    steps = [step for job in jobs.values() for step in job["steps"]]
    industrial = [step for step in steps if "industrial_ci" in step.get("uses", "")]
    assert [step["env"]["ROS_DISTRO"] for step in industrial] == ["noetic"]
    commands = [step["run"] for step in steps if "run" in step]
    assert "scripts/test" in commands


def debian_paragraphs():
    """@return the fields of every paragraph of debian/control."""
    texts = (REPOSITORY / "debian/control").read_text().strip().split("\n\n")
    return [dict(re.findall(r"^(\S+):((?:.*)(?:\n[ \t].*)*)", text, re.MULTILINE)) for text in texts]


def debian_names(fields, *relations):
    """@return the packages that these fields name, without what debhelper puts in and our own."""
    listed = ",".join(fields.get(relation, "") for relation in relations).split(",")
    return {name.split()[0] for name in listed if name.strip() and "suspension" not in name and "${" not in name}


def debian_packages(*tags):
    """@return for every key of package.xml in an element of these tags: Debian's packages."""
    own_list = pathlib.Path("/usr/share/python3-rosdep2/debian.yaml")
    if not own_list.exists():
        pytest.skip("Debian's own list of rosdep is not there (Debian: python3-rosdep2)")
    known = {**yaml.safe_load(own_list.read_text()), **yaml.safe_load((REPOSITORY / "rosdep/local.yaml").read_text())}
    return {element.text: set(known[element.text]["debian"]) for element in MANIFEST if element.tag in tags}


def test_debian_builds_with_what_package_xml_names():
    named = debian_names(debian_paragraphs()[0], "Build-Depends")
    wanted = debian_packages("depend", "build_depend", "buildtool_depend", "build_export_depend")
    assert {key for key, packages in wanted.items() if not packages & named} == set()
    assert named - set().union(*wanted.values()) == {"debhelper-compat", "dh-python", "cmake"}


def test_debian_runs_with_what_package_xml_names():
    paragraphs = debian_paragraphs()[1:]
    named = set().union(*(debian_names(fields, "Depends", "Recommends", "Suggests") for fields in paragraphs))
    wanted = debian_packages("exec_depend")
    assert {key for key, packages in wanted.items() if not packages & named} == set()
    optional = {*needs.PACKAGES.values(), *needs.PACKAGES_OF_SOME.values()}
    known = set().union(optional, *debian_packages("exec_depend", "depend", "test_depend").values())
    assert named <= known


def test_debian_needs_nothing_of_the_fleet():
    robot, python = debian_paragraphs()[1:]
    optional = {*needs.PACKAGES.values(), *needs.PACKAGES_OF_SOME.values()}
    assert not optional & (debian_names(robot, "Depends", "Recommends") | debian_names(python, "Depends"))
    assert optional <= debian_names(python, "Recommends", "Suggests")


def test_debian_has_the_version_and_maintainer_of_package_xml():
    newest = (REPOSITORY / "debian/changelog").read_text().splitlines()
    assert newest[0].startswith(f"suspension-health-monitor ({MANIFEST.findtext('version')}) ")
    maintainer = MANIFEST.find("maintainer")
    person = f"{maintainer.text} <{maintainer.get('email')}>"
    assert debian_paragraphs()[0]["Maintainer"].strip() == person
    assert [line for line in newest if line.startswith(" -- ")][0].startswith(f" -- {person}  ")


def installed_files():
    """@return where the install rules of CMakeLists.txt, catkin's own and setup.py put things, with the prefix /usr."""
    name, rules = MANIFEST.findtext("name"), (REPOSITORY / "CMakeLists.txt").read_text()
    nodes = [f"{nodelet.lower()}_node" for nodelet in re.search(r"foreach\(nodelet (.*)\)", rules).group(1).split()]
    programs = [program for program in re.findall(r"APPEND installed_programs (.*)\)", rules) if "$" not in program]
    scripts = [pathlib.Path(path).name for path in re.findall(r"catkin_install_python\(PROGRAMS (\S+)", rules)]
    parts = [f"_{part}.cpython-311-x86_64-linux-gnu.so" for part in re.findall(r"add_python_part\((\w+)", rules)]
    python, library = f"usr/lib/python3/dist-packages/{name}", "usr/lib/x86_64-linux-gnu"
    return [
        f"usr/include/{name}/strut_monitor.h", f"usr/share/{name}/package.xml",
        f"usr/share/{name}/launch/monitor.launch",
        *(f"usr/lib/{name}/{program}" for program in nodes + programs + scripts),
        f"{library}/lib{name}_core.so", f"{library}/lib{name}_nodelets.so",
        f"{library}/cmake/{name}/{name}Config.cmake", f"{library}/pkgconfig/{name}.pc",
        *(f"{python}/{path.relative_to(REPOSITORY / 'python' / name)}"
          for path in (REPOSITORY / "python" / name).rglob("*.*") if path.suffix != ".pyc"),
        *(f"{python}/{part}" for part in parts), f"{python}/msg/_ModelInUse.py", f"{python}/srv/_Diagnose.py",
        f"{python}-{MANIFEST.findtext('version')}.egg-info/PKG-INFO"]


def is_of(pattern, path):
    return any(place.match(pattern) for place in (path, *path.parents) if len(place.parts) == len(pattern.split("/")))


def test_debian_puts_every_installed_file_into_one_package():
    patterns = [line for path in (REPOSITORY / "debian").glob("*.install") for line in path.read_text().split()]
    paths = [pathlib.PurePosixPath(path) for path in installed_files()]
    assert {path: of for path in paths if len(of := [each for each in patterns if is_of(each, path)]) != 1} == {}
    assert [pattern for pattern in patterns if not any(is_of(pattern, path) for path in paths)] == []


def test_debian_links_programs_into_the_path():
    links = [path.read_text().split() for path in (REPOSITORY / "debian").glob("*.links")]
    assert sorted(link for _, link in links) == ["usr/bin/suspension_bag", "usr/bin/suspension_fleet"]
    assert {program for program, _ in links} <= set(installed_files())


def test_nodelets_are_found_in_any_folder_of_libraries():
    """pluginlib joins the path to a prefix; on Debian the library is in a folder of its architecture, which only the
    dynamic linker knows."""
    plugins = ElementTree.parse(REPOSITORY / "nodelet_plugins.xml").getroot()
    assert plugins.get("path") == f"lib{MANIFEST.findtext('name')}_nodelets"
