#!/usr/bin/env python3
"""What ends while ~diagnose searches ends the search, and nothing else."""
import unittest

import rospy
import rostest
from live_drive import DRIVE, SETTINGS, load_monitor, two_searches
from ros_session import PACKAGE, Collector, load_nodelet, start_node, wait_until
from suspension_health_monitor.msg import ModelComparison, ParameterEstimate


class SearchEndTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.beside = Collector("/beside/la", ParameterEstimate)
        cls.programs = [load_monitor("beside"), load_nodelet("SimulatorNodelet", "drive", DRIVE)]
        cls.beside.wait_for(lambda message: True, "an estimate")

    @classmethod
    def tearDownClass(cls):
        for program in reversed(cls.programs):
            program.stop()

    @classmethod
    def search(cls, monitor):
        """Lets it see enough to search in; a call that searches, after another one has been refused."""
        comparisons = Collector(f"/{monitor}/comparison", ModelComparison)
        first = comparisons.wait_for(lambda message: True, "a comparison")
        comparisons.wait_for(lambda message: (message.header.stamp - first.header.stamp).to_sec() > 40.0,
                             "enough to search in")
        comparisons.stop()

        def one_searches():
            calls = two_searches(monitor)
            wait_until(lambda: any(call.ended() for call in calls), "a refusal of the second call")
            return next((call for call in calls if not call.ended()), None)
        return wait_until(one_searches, "a search that goes on")

    def test_end_of_the_node_ends_a_search(self):
        with start_node("monitor_node", "node", SETTINGS) as node:
            self.search("node")
            node.stop()
            self.assertEqual(node.wait_for_end(), 0, node.output())

    def test_unloading_ends_a_search(self):
        with load_monitor("short_lived") as monitor:
            search = self.search("short_lived")
            monitor.stop()
            wait_until(search.ended, "an answer of the service")
        self.assertIsNotNone(search.error)
        stamp = self.beside.messages[-1].header.stamp
        self.beside.wait_for(lambda message: message.header.stamp > stamp, "the other nodelets of the manager")


if __name__ == "__main__":
    rospy.init_node("search_end_test")
    rostest.rosrun(PACKAGE, "search_end", SearchEndTest)
