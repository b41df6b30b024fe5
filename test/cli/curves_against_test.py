"""suspension_bag identify --against: by how much, and where on the curves, a strut differs from another drive."""
import json
import re

import pytest

import browser

DRIVE = ["--scenario", "iso_road", "--vehicle", "ugv", "--rate", "100", "--set", "noise=0.03", "--duration", "60"]
B1, LOST = 4.0, 0.25  # of the ugv [1/s]; share of it that the worn damper has lost, in rebound alone
# b1 v + c |v| with v < 0: b1 - c; so b1 = 4 - 0.5 and c = 0.5 leave compression as it was and take a quarter of rebound.
WORN = ["--set", f"damping_to_mass={B1 - LOST * B1 / 2}", "--effect", f"asymmetric_damping={LOST * B1 / 2}"]


SIZE = r"\d+(?:\.\d+)?"


def simulate(program, folder, name, *options):
    path = folder / f"{name}.bag"
    program.succeed("simulate", *DRIVE, "-o", path, *options)
    return path


@pytest.fixture(scope="module")
def march(program, tmp_path_factory):
    """A healthy drive. Not to be written to."""
    return simulate(program, tmp_path_factory.mktemp("against"), "march", "--seed", "1")


def against(program, bag, other, folder, *options):
    """@return the last line that is said, and `against` of --json."""
    path = folder / "result.json"
    told = program.succeed("identify", bag, "--against", other, "--json", path, *options)
    found = json.loads(path.read_text())["against"]
    assert found["change"] in told.splitlines()
    return found


def test_a_damper_worn_in_rebound_is_said_in_rebound_alone(program, tmp_path, march):
    worn = simulate(program, tmp_path, "worn", "--seed", "2", *WORN)
    found = against(program, worn, march, tmp_path)
    assert re.fullmatch(rf"damping {SIZE} % below march.bag \(90 %: {SIZE} to {SIZE} %\), softer in rebound above "
                        rf"{SIZE} m/s; stiffness within [+-]{SIZE} to [+-]{SIZE} %", found["change"])
    low, high = found["damping"]["interval"]
    assert low < found["damping"]["change"] < high < 0.0
    assert low - 0.02 < -LOST / 2 < high + 0.02  # least squares weigh both directions alike, nearly
    (part,) = found["damper_differences"]
    assert part["softer"] and part["to"] < part["from"] < 0.0
    assert found["spring_differences"] == []
    assert found["bag"] == "march.bag" and len(found["damper_curve"]["velocity"]) > 10
    reverse = against(program, march, worn, tmp_path)
    assert "stiffer in rebound" in reverse["change"] and "compression" not in reverse["change"]


@pytest.mark.parametrize("seed", [3, 4])
def test_the_same_strut_on_another_drive_has_not_changed(program, tmp_path, march, seed):
    found = against(program, simulate(program, tmp_path, "today", "--seed", seed), march, tmp_path)
    assert re.fullmatch(rf"no certain change against march.bag: damping within [+-]{SIZE} to [+-]{SIZE} %; "
                        rf"stiffness within [+-]{SIZE} to [+-]{SIZE} %", found["change"])
    assert found["damper_differences"] == found["spring_differences"] == []


def test_too_little_of_the_other_drive_is_said(program, tmp_path, march):
    """Nothing at all of half a second; of the strut of three."""
    program.succeed("simulate", *DRIVE[:-1], "0.5", "-o", tmp_path / "shortest.bag")
    shortest = program("identify", march, "--against", tmp_path / "shortest.bag")
    assert shortest.returncode == 4 and "--against shortest.bag: " in shortest.stderr
    program.succeed("simulate", *DRIVE[:-1], "3", "-o", tmp_path / "short.bag")
    found = against(program, march, tmp_path / "short.bag", tmp_path)
    assert found["change"] == "cannot be compared with short.bag: no valid estimate of that drive"
    assert found["damper_curve"]["force"] == [] and "damping" not in found


def test_wrong_other_drives_are_refused_by_name(program, tmp_path, march):
    missing = program("identify", march, "--against", tmp_path / "none.bag")
    assert missing.returncode == 3 and "none.bag" in missing.stderr
    same = program("identify", march, "--against", march, "--json", march)
    assert same.returncode == 2 and "--json" in same.stderr


def test_page_has_both_curves(program, tmp_path, march):
    worn = simulate(program, tmp_path, "worn", "--seed", "2", *WORN)
    found = against(program, worn, march, tmp_path, "--report", tmp_path / "page")
    page = browser.shown(tmp_path / "page" / "report.html", tmp_path / "profile")
    assert page.one(id="script-errors").text == ""
    assert page.one("html").attributes["data-ready"] == "yes"
    assert "softer in rebound" in page.one(id="curves").text and "march.bag" in page.one(id="verdict").text
    canvases = list(page.one(id="curves").all("canvas"))
    assert len(canvases) == 2
    for canvas in canvases:  # axes, two bands, two lines
        assert int(canvas.attributes["data-colours"]) > 4
    assert found["change"]


def test_page_of_one_drive_has_its_curves(program, tmp_path, march):
    program.succeed("identify", march, "--report", tmp_path / "page")
    page = browser.shown(tmp_path / "page" / "report.html", tmp_path / "profile")
    assert page.one(id="script-errors").text == ""
    assert len(list(page.one(id="curves").all("canvas"))) == 2


def test_every_strut_of_a_vehicle_is_compared(program, tmp_path):
    bags = {}
    for seed, (name, options) in enumerate({"march": [], "today": ["--effect", "front/quadratic_damping=4"]}.items(), 1):
        bags[name], vehicle = tmp_path / f"{name}.bag", tmp_path / f"{name}.yaml"
        program.succeed("simulate", "--vehicle-model", "half_sedan", "--duration", "60", "--rate", "100", "--seed", seed,
                        "-o", bags[name], "--vehicle-file", vehicle, *options)
    result = tmp_path / "result.json"
    program.succeed("identify", bags["today"], "--against", bags["march"], "--vehicle", vehicle, "--json", result,
                    "--report", tmp_path / "page")
    found = {name: strut["against"] for name, strut in json.loads(result.read_text())["struts"].items()}
    assert "stiffer in" in found["front"]["change"] and found["front"]["damper_differences"]
    assert found["rear"]["change"].startswith("no certain change against march.bag")
    page = browser.shown(tmp_path / "page" / "report.html", tmp_path / "profile")
    assert page.one(id="script-errors").text == ""
    for name in found:
        assert "march.bag" in page.one(id=f"curves-{name}").text
