"""Bags with messages of former versions are migrated by rosbag's own tool."""
import math
import re
import sys
from pathlib import Path

import genpy.dynamic
import pytest
import rosbag
import rosbag.migration
import rospy
from suspension_health_monitor.msg import CouplingInUse, ParameterEstimate

RULES = Path(__file__).parents[2] / "migration"
ESTIMATE = {"estimator": "la", "damping_to_mass": 3.0, "stiffness_to_mass": 13.8, "effect_names": ["hysteresis"],
            "effect_coefficients": [0.5], "effect_stddevs": [0.1], "valid": True}
COUPLING = {"known": True, "names": ["front", "rear"], "ratios": [1.0, -0.2, -0.3, 1.0], "stddevs": [0.0, 0.1, 0.1, 0.0],
            "condition": 1.2, "mass_to_pitch_inertia": 0.7, "centre_of_gravity": [0.1, 0.0]}


def text_of(message, name):
    rule = (RULES / f"{message.__name__}.bmr").read_text()
    return re.search(name + r' = """\n(.*?)"""', rule, re.DOTALL).group(1)


def former_bag(folder, message, fields):
    """A bag as a node of the former version recorded it."""
    former = genpy.dynamic.generate_dynamic(message._type, text_of(message, "old_full_text"))[message._type]()
    former.header.stamp = rospy.Time(12, 500)
    for name, value in fields.items():
        setattr(former, name, value)
    path = folder / "former.bag"
    with rosbag.Bag(str(path), "w") as bag:
        bag.write("/topic", former, rospy.Time(12))
    return path


@pytest.mark.parametrize("message", [ParameterEstimate, CouplingInUse])
def test_the_rule_ends_in_the_message_as_it_is(message):
    now = genpy.dynamic.generate_dynamic(message._type, text_of(message, "new_full_text"))[message._type]
    assert now._md5sum == message._md5sum


@pytest.mark.skipif(sys.version_info >= (3, 13), reason="rosbag migrates nothing there: it looks for what exec() made in "
                                                        "locals(), which Python 3.13 no longer gives")
@pytest.mark.parametrize("message, fields, unknown", [(ParameterEstimate, ESTIMATE, ["explained", "age"]),
                                                      (CouplingInUse, COUPLING, ["model_error"])])
def test_a_former_bag_is_migrated_and_keeps_its_numbers(message, fields, unknown, tmp_path):
    former = former_bag(tmp_path, message, fields)
    migrator = rosbag.migration.MessageMigrator([str(RULES / f"{message.__name__}.bmr")], plugins=False)
    migrated = tmp_path / "migrated.bag"
    (_, unresolved), = rosbag.migration.checkbag(migrator, str(former))
    assert not unresolved
    assert rosbag.migration.fixbag(migrator, str(former), str(migrated))
    with rosbag.Bag(str(migrated)) as bag:
        (_, found, _), = bag.read_messages()
    assert found._md5sum == message._md5sum
    assert found.header.stamp == rospy.Time(12, 500)
    for name, value in fields.items():
        read = getattr(found, name)
        assert (list(read) if isinstance(value, list) else read) == value, name
    assert all(math.isnan(getattr(found, name)) for name in unknown)
