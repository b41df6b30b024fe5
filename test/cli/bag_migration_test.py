"""Bags with the ParameterEstimate of former versions are migrated by rosbag's own tool."""
import math
import re
from pathlib import Path

import genpy.dynamic
import pytest
import rosbag
import rosbag.migration
import rospy
from suspension_health_monitor.msg import ParameterEstimate

RULES = Path(__file__).parents[2] / "migration" / "ParameterEstimate.bmr"
TYPE = "suspension_health_monitor/ParameterEstimate"


def text_of(name):
    return re.search(name + r' = """\n(.*?)"""', RULES.read_text(), re.DOTALL).group(1)


@pytest.fixture
def former_bag(tmp_path):
    """A bag as a node of the former version recorded it."""
    former = genpy.dynamic.generate_dynamic(TYPE, text_of("old_full_text"))[TYPE]
    message = former()
    message.header.stamp = rospy.Time(12, 500)
    message.estimator = "la"
    message.damping_to_mass, message.stiffness_to_mass = 3.0, 13.8
    message.effect_names, message.effect_coefficients, message.effect_stddevs = ["hysteresis"], [0.5], [0.1]
    message.valid = True
    path = tmp_path / "former.bag"
    with rosbag.Bag(str(path), "w") as bag:
        bag.write("/monitor/la", message, rospy.Time(12))
    return path


def test_the_rule_ends_in_the_message_as_it_is():
    now = genpy.dynamic.generate_dynamic(TYPE, text_of("new_full_text"))[TYPE]
    assert now._md5sum == ParameterEstimate._md5sum


def test_a_former_bag_is_migrated_and_keeps_its_numbers(former_bag, tmp_path):
    migrator = rosbag.migration.MessageMigrator([str(RULES)], plugins=False)
    migrated = tmp_path / "migrated.bag"
    (_, unresolved), = rosbag.migration.checkbag(migrator, str(former_bag))
    assert not unresolved
    assert rosbag.migration.fixbag(migrator, str(former_bag), str(migrated))
    with rosbag.Bag(str(migrated)) as bag:
        (_, message, _), = bag.read_messages()
    assert message._md5sum == ParameterEstimate._md5sum
    assert message.header.stamp == rospy.Time(12, 500)
    assert (message.estimator, message.damping_to_mass, message.stiffness_to_mass) == ("la", 3.0, 13.8)
    assert (message.effect_names, list(message.effect_coefficients)) == (["hysteresis"], [0.5])
    assert message.valid and message.reason == ""
    assert math.isnan(message.explained) and math.isnan(message.age)
