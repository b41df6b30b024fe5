"""A simulated drive with a hidden effect, ten times as fast as real, and monitors of it that can be asked."""
import threading

import rospy
from ros_session import PATIENCE, load_nodelet, wait_until
from std_srvs.srv import Trigger
from suspension_health_monitor.srv import Diagnose, SetEffects

START = 1000.0  # [s] stamp of the first sample
# The wheel of the vehicle "ugv" on its road, b1 = 4 1/s, b0 = 40 1/s^2, and what the strut hides.
EFFECT, COEFFICIENT, STIFFNESS_TO_MASS = "quadratic_damping", 1.6, 40.0
DRIVE = {"scenario": "iso_road", "vehicle": "ugv", "rate": 100.0, "noise": 0.03, "start_time": START,
         "duration": 3600.0, "real_time_factor": 10.0, "effects": {EFFECT: {"coefficient": COEFFICIENT}}}
SETTINGS = {"diagnose": {"window": 60.0}}
KEPT = 60.0  # [s]


def proxy(monitor, service, service_type):
    rospy.wait_for_service(f"/{monitor}/{service}", PATIENCE)
    return rospy.ServiceProxy(f"/{monitor}/{service}", service_type)


class Services:
    def __init__(self, monitor):
        self.diagnose = proxy(monitor, "diagnose", Diagnose)
        self.set_effects = proxy(monitor, "set_effects", SetEffects)
        self.save_model = proxy(monitor, "save_model", Trigger)


def load_monitor(name, **parameters):
    return load_nodelet("MonitorNodelet", name, {**SETTINGS, **parameters})


class Call(threading.Thread):
    """A service call that goes on beside the test."""

    def __init__(self, service, *arguments):
        super().__init__(daemon=True)
        self._call = lambda: service(*arguments)
        self.response = self.error = None
        self.start()

    def run(self):
        try:
            self.response = self._call()
        except rospy.ServiceException as error:
            self.error = error

    def ended(self):
        return not self.is_alive()


def refused_beside_a_search(monitor):
    """(the call that searches, the one that was refused as it came meanwhile). Two calls at the same time, again where
    the first had ended before the second came."""
    def one_searches():
        calls = [Call(proxy(monitor, "diagnose", Diagnose), 0.0) for _ in range(2)]
        wait_until(lambda: any(call.ended() for call in calls), "an answer to one of two calls")
        refused = next(call for call in calls if call.ended())
        search = next(call for call in calls if call is not refused)
        if not refused.response.success:
            return search, refused
        wait_until(search.ended, "the end of the other search")
        return None
    return wait_until(one_searches, "a call refused beside a search")
