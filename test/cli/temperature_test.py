"""The temperature of the damper in a bag: a baseline learns how damping goes with it."""
import pytest
import rosbag
import rospy
from sensor_msgs.msg import Temperature

from python_module import ROUGH, shm

TOPIC = "/damper/temperature"
USUAL = 0.005  # [1/K], what is known of it beforehand


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    """A healthy strut whose damper warms by a tenth of a degree a second, which changes nothing."""
    path = tmp_path_factory.mktemp("temperature") / "drive.bag"
    shm.simulate(path, duration=120, **ROUGH)
    with rosbag.Bag(str(path), "a") as drive:
        for second in range(120):
            stamp = rospy.Time.from_sec(drive.get_start_time() + second)
            reading = Temperature(temperature=20.0 + 0.1 * second)
            reading.header.stamp = stamp
            drive.write(TOPIC, reading, stamp)
    return path


def test_baseline_learns_what_the_temperature_does(bag):
    learned = shm.health(bag, temperature_topic=TOPIC).baseline.temperature
    assert 20.0 < learned.celsius < 32.0
    assert learned.per_kelvin_stddev < USUAL
    assert abs(learned.per_kelvin) < 3.0 * learned.per_kelvin_stddev


def test_without_a_thermometer_nothing_is_known_of_it(bag):
    assert shm.health(bag).baseline.temperature is None
    assert shm.health(bag, temperature_topic="/no/such/topic").baseline.temperature is None
