"""catkin_lint, strict: package.xml, CMakeLists.txt and launch files say the same."""
import shutil
import subprocess

import pytest

from imu_bag import REPOSITORY


def test_catkin_lint_strict():
    if shutil.which("catkin_lint") is None:
        pytest.skip("catkin_lint is not installed (Debian: catkin-lint)")
    # The folder of a checkout may have any name. Without rosdep's cache unknown keys are not judged: offline.
    result = subprocess.run(["catkin_lint", "--strict", "-W2", "--offline", "--ignore", "package_path_name",
                             str(REPOSITORY)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=600)
    assert result.returncode == 0, result.stdout
    assert "checked 1 packages and found 0 problems" in result.stdout
