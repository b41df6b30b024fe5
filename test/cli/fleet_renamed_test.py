"""A vehicle whose folder has got another name keeps its history, if its struts say that it is the same one."""
import dataclasses

import numpy as np
import pytest

from suspension_health_monitor.fleet import renamed, wording
from suspension_health_monitor.fleet.errors import UsageError
from suspension_health_monitor.fleet.history import YEAR, Event, StrutHistory

BEGIN = 1.6e9
NAMES = ("front_left", "front_right", "rear_left", "rear_right")


def vehicle(name, parts, begin, drives=20, seed=0, names=NAMES):
    """Of a month or two; parts: b1 and b0 of every strut, which loads of 20 % lower from drive to drive."""
    random = np.random.default_rng([seed, *name.encode()])
    time = BEGIN + YEAR * (begin + 0.01 * np.arange(drives))
    load = np.exp(0.2 * random.random(drives))
    found = []
    for strut, (b1, b0) in zip(names, parts):
        damping, stiffness = (each / load * np.exp(0.01 * random.standard_normal(drives)) for each in (b1, b0))
        found.append(StrutHistory(name, strut, time, damping, 0.01 * damping, stiffness, 0.01 * stiffness, drives * [name]))
    return found


def make(seed):
    """Parts of a vehicle: those of others differ by 5 %."""
    shares = np.exp(0.05 * np.random.default_rng([seed, 9]).standard_normal((len(NAMES), 2)))
    return shares * [4.0, 60.0]


def names_of(histories):
    return sorted({each.vehicle for each in histories})


def test_a_renamed_vehicle_keeps_its_history_and_names_both():
    fleet = vehicle("stays", make(1), 0.0, 60) + vehicle("old", make(2), 0.0) + vehicle("new", make(2), 0.25)
    fleet[4] = dataclasses.replace(fleet[4], events=[Event(BEGIN, "WARN", "low", "a.bag")])
    found = renamed.joined(fleet)
    assert names_of(found) == ["new", "stays"]
    front = next(each for each in found if (each.vehicle, each.strut) == ("new", "front_left"))
    assert len(front.time) == 40 and np.all(np.diff(front.time) > 0) and front.path == 20 * ["old"] + 20 * ["new"]
    assert [event.message for event in front.events] == ["low"]
    assert wording.of_strut(front, None).endswith(f"the vehicle was called old until {wording.day(fleet[4].time[-1])}")


def test_renamed_twice():
    fleet = [each for k, name in enumerate("abc") for each in vehicle(name, make(2), 0.25 * k)]
    found = renamed.joined(fleet)
    assert names_of(found) == ["c"]
    assert [name for name, _ in found[0].formerly] == ["a", "b"] and len(found[0].time) == 60


@pytest.mark.parametrize("other", [
    vehicle("new", make(3), 0.25),                                  # of other struts
    vehicle("new", make(2), 0.1),                                   # drives while the other still does
    vehicle("new", make(2), 0.25, names=("front", "rear")),
    vehicle("new", make(2) * [1.0, 1.2], 0.25)])                     # stiffer
def test_another_vehicle_is_another_one(other):
    found = renamed.joined(vehicle("old", make(2), 0.0) + other)
    assert names_of(found) == ["new", "old"]
    assert not any(each.formerly or each.perhaps for each in found)


def test_vehicles_are_seldom_taken_for_one_another():
    """40 pairs whose new parts differ by 5 %, and 40 renamed vehicles, of which one in 100 may differ by chance."""
    taken = [len(names_of(renamed.joined(vehicle("old", make(k), 0.0, seed=k) + vehicle("new", make(k + more), 0.25, seed=k))))
             for more in (100, 0) for k in range(40)]
    assert taken[:40].count(1) <= 2 and taken[40:].count(1) >= 36


def test_where_two_fit_it_is_asked():
    """Also two that have vanished, or one that has come twice."""
    pair = vehicle("one", make(2), 0.0) + vehicle("two", make(2), 0.0, seed=1)
    fleet = pair + vehicle("new", make(2), 0.25)
    found = renamed.joined(fleet)
    assert names_of(found) == ["new", "one", "two"]
    asked = next(each for each in found if each.vehicle == "new")
    assert asked.perhaps == ("one", "two")
    assert "perhaps the vehicle was called one or two: --renamed new=one says" in wording.of_strut(asked, None)
    twice = renamed.joined(vehicle("one", make(2), 0.0) + vehicle("new", make(2), 0.25) + vehicle("newer", make(2), 0.26))
    assert names_of(twice) == ["new", "newer", "one"]
    assert {each.vehicle: each.perhaps for each in twice} == {"one": (), "new": ("one",), "newer": ("one",)}
    assert names_of(renamed.joined(fleet, ["new=two"])) == ["new", "one"]
    apart = renamed.joined(fleet, ["new="])
    assert names_of(apart) == ["new", "one", "two"] and not any(each.perhaps for each in apart)


@pytest.mark.parametrize("told", ["new", "new=nobody", "nobody=old", "old=new"])
def test_what_cannot_be_is_refused(told):
    with pytest.raises(UsageError, match=f"--renamed {told}"):
        renamed.joined(vehicle("old", make(2), 0.0) + vehicle("new", make(2), 0.25), [told])
