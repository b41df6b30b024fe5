#!/usr/bin/env python3
"""What ends while ~diagnose searches ends the search, and nothing else."""
import unittest

import rospy
import rostest
from live_drive import DRIVE, SETTINGS, load_monitor, refused_beside_a_search
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
        """Lets it see enough to search in; a call that searches."""
        comparisons = Collector(f"/{monitor}/comparison", ModelComparison)
        first = comparisons.wait_for(lambda message: True, "a comparison")
        comparisons.wait_for(lambda message: (message.header.stamp - first.header.stamp).to_sec() > 40.0,
                             "enough to search in")
        comparisons.stop()
        search, _ = refused_beside_a_search(monitor)
        return search

    def test_end_of_the_node_ends_a_search(self):
        with start_node("monitor_node", "node", SETTINGS) as node:
            self.search("node")
            node.stop()
            self.assertEqual(node.wait_for_end(), 0, node.output())

    def test_unloading_ends_a_search(self):
        """Once more where the search was over before the unloading began."""
        def unloaded_in_a_search():
            with load_monitor("short_lived") as monitor:
                search = self.search("short_lived")
                monitor.stop()
                wait_until(search.ended, "an answer of the service")
            return search.error
        wait_until(unloaded_in_a_search, "a search that unloading ends")
        stamp = self.beside.messages[-1].header.stamp
        self.beside.wait_for(lambda message: message.header.stamp > stamp, "the other nodelets of the manager")


if __name__ == "__main__":
    rospy.init_node("search_end_test")
    rostest.rosrun(PACKAGE, "search_end", SearchEndTest)
