"""python3 -m suspension_health_monitor.fleet.temperature BAG TOPIC...: {topic: mean of its sensor_msgs/Temperature [deg C]}
as JSON, of those topics that have any."""
import collections
import json
import math
import sys

import rosbag


def mean_temperatures(path, topics):
    totals, counts = collections.Counter(), collections.Counter()
    with rosbag.Bag(path) as bag:
        for topic, message, _ in bag.read_messages(topics=topics):
            if math.isfinite(message.temperature):
                totals[topic] += message.temperature
                counts[topic] += 1
    return {topic: totals[topic] / counts[topic] for topic in counts}


if __name__ == "__main__":
    print(json.dumps(mean_temperatures(sys.argv[1], sys.argv[2:])))
