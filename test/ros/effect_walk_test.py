#!/usr/bin/env python3
"""The walk with the live services: compared, searched, extended while a bag plays; as good as offline."""
import json
import math
import os
import tempfile
import unittest

import rospy
import rostest
from ros_session import PACKAGE, Collector, pause_replay, replayed, run_tool, settings_file
from std_srvs.srv import Trigger
from suspension_health_monitor.msg import ModelComparison
from suspension_health_monitor.srv import Diagnose, SetEffects

EFFECT, COEFFICIENT = "bump_stop", "47,g=0.013"
DRIVE = ["--scenario", "iso_road", "--vehicle", "ugv", "--rate", "100", "--set", "noise=0.03", "--seed", "5",
         "--duration", "230", "--effect", f"{EFFECT}={COEFFICIENT}"]
RATE = 8  # bag seconds per wall second
SEARCH_AT = 80.0  # [s] of the bag
# A memory of 10 s at 100 Hz, so that the estimates add little to the error, and a window that scatters by
# 1 / sqrt(2 * 20 s * 100 Hz) = 1.6 %.
SETTINGS = {"forgetting_factor": 0.999, "comparison_window": 20.0}
SETTLED = 120.0  # [s] after the effect is in: six windows, the square of what was before has decayed to 0.2 %


def read_json(path):
    with open(path, encoding="utf-8") as stream:
        return json.load(stream)


def call(service, service_type, *arguments):
    rospy.wait_for_service(f"/monitor/{service}")
    return rospy.ServiceProxy(f"/monitor/{service}", service_type)(*arguments)


class EffectWalkTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            cls.work_offline(lambda name: os.path.join(folder, name))
            cls.work_live(lambda name: os.path.join(folder, name))

    @classmethod
    def work_offline(cls, path):
        run_tool("simulate", *DRIVE, "-o", path("drive.bag"))
        run_tool("compare", path("drive.bag"), "--json", path("compare.json"))
        run_tool("diagnose", path("drive.bag"), "-o", path("offline.yaml"), "--json", path("diagnose.json"))
        cls.compared, cls.offline = read_json(path("compare.json")), read_json(path("diagnose.json"))

    @classmethod
    def work_live(cls, path):
        comparison = Collector("/monitor/comparison", ModelComparison)
        config = settings_file(path(""), "monitor.yaml", **SETTINGS)
        with replayed([comparison], bag=path("drive.bag"), rate=RATE, config=config,
                      model_file=path("live.yaml")) as player:
            first = comparison.wait_for(lambda message: True, "a comparison").header.stamp
            comparison.wait_for(lambda message: message.header.stamp >= first + rospy.Duration(SEARCH_AT),
                                "enough to search in")
            pause_replay(True)  # a search takes as long as it takes
            cls.found = call("diagnose", Diagnose, 0.0)
            cls.answer = call("set_effects", SetEffects, cls.found.selected, [], [])
            cls.extended_from = comparison.messages[-1].header.stamp
            pause_replay(False)
            settled = cls.extended_from + rospy.Duration(SETTLED)
            comparison.wait_for(lambda message: message.header.stamp >= settled, "the settled error")
            cls.saved = call("save_model", Trigger)
            player.wait_for_end()
        cls.comparison = list(comparison.messages)
        run_tool("compare", path("drive.bag"), "--model", path("live.yaml"), "--json", path("live.json"))
        cls.live_compared = read_json(path("live.json"))

    def test_live_finds_what_offline_finds(self):
        self.assertEqual(self.offline["selected"], [EFFECT])
        self.assertTrue(self.found.success, self.found.message)
        self.assertEqual(self.found.selected, [EFFECT])
        shape = self.offline["extended"]["shapes"][f"{EFFECT}/g"]
        self.assertEqual(self.found.shape_names, [f"{EFFECT}/g"])
        self.assertAlmostEqual(self.found.shapes[0], shape, delta=0.3 * shape)

    def test_error_falls_to_what_offline_promises(self):
        self.assertTrue(self.answer.success, self.answer.message)
        end = self.comparison[-1]
        promised = self.offline["extended"]["held_out_rmse"]
        self.assertLess(abs(end.rmse / promised - 1.0), 0.1, f"live {end.rmse}, offline {promised} m/s^2")
        self.assertLess(end.rmse, 0.7 * end.base_rmse)

    def test_error_falls_and_the_base_stays(self):
        before = [message for message in self.comparison if message.header.stamp <= self.extended_from][-1]
        end = self.comparison[-1]
        self.assertEqual(before.rmse, before.base_rmse)
        self.assertLess(end.rmse, 0.7 * before.rmse)
        self.assertLess(abs(math.log(end.base_rmse / before.base_rmse)), math.log(1.5))

    def test_saved_model_is_better_than_the_linear_one(self):
        self.assertTrue(self.saved.success, self.saved.message)
        self.assertLess(self.live_compared["free_run"]["rmse"], 0.7 * self.compared["free_run"]["rmse"])


if __name__ == "__main__":
    rospy.init_node("effect_walk_test")
    rostest.rosrun(PACKAGE, "effect_walk", EffectWalkTest)
