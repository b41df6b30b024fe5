#!/usr/bin/env python3
"""roswtf on the running graph: no error and no warning."""
import subprocess
import sys
import tempfile
import unittest

import rospy
import rostest
from ros_session import PACKAGE, PATIENCE, Collector
from suspension_health_monitor.msg import ParameterEstimate

# Its static checks are about the machine (rosdep's cache; ROS_ROOT, which Debian does not set): only what it says of the
# graph counts. Started inside of a package it would end there, for want of ROS_ROOT.
GRAPH = "Online checks summary:"
# A bare machine may not know its own name, at which roswtf ends; the graph is on localhost anyway.
ROSWTF = "import socket; socket.gethostname = lambda: 'localhost'; import roswtf; roswtf.roswtf_main()"


class RoswtfTest(unittest.TestCase):
    def test_nothing_is_wrong_with_the_graph(self):
        collectors = [Collector(f"/{monitor}/la", ParameterEstimate) for monitor in ("monitor", "second_monitor")]
        for collector in collectors:
            collector.wait_for(lambda estimate: True, "an estimate")
        with tempfile.TemporaryDirectory() as folder:
            output = subprocess.run([sys.executable, "-c", ROSWTF], cwd=folder, text=True, timeout=PATIENCE,
                                    stdout=subprocess.PIPE, stderr=subprocess.STDOUT).stdout
        self.assertIn(GRAPH, output, "it has looked at the graph")
        graph = output[output.index(GRAPH):]
        self.assertIn("No errors or warnings", graph)


if __name__ == "__main__":
    rospy.init_node("roswtf_test")
    rostest.rosrun(PACKAGE, "roswtf", RoswtfTest)
