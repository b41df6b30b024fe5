"""What the tests of the Python module share: the module, unless it was not to be built."""
import os

import pytest

if os.environ.get("PYTHON_MODULE", "ON") == "OFF":
    pytest.skip("built without the Python module", allow_module_level=True)

import suspension_health_monitor as shm  # noqa: E402  after the reason to skip

ROUGH = {"scenario": "iso_road", "vehicle": "ugv", "rate": 100}
HIDDEN = "quadratic_damping=1.6"

__all__ = ["HIDDEN", "ROUGH", "shm"]
