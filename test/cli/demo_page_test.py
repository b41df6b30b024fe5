"""What scripts/demo does once all is built: the drives through the nodelets, and their page in a browser."""
import os
import subprocess
import sys

import pytest

import browser
import imu_bag
from conftest import HANGS

FOLD = 900  # [px] height of what is seen without scrolling


@pytest.fixture(scope="module")
def demo(tmp_path_factory):
    """The folder that scripts/demo --quick --output writes."""
    folder = tmp_path_factory.mktemp("demo")
    command = [sys.executable, imu_bag.REPOSITORY / "scripts/demo_report.py", "--quick", "--output", folder, "--work",
               folder / "work"]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=HANGS,
                          env={**os.environ, "ROS_HOSTNAME": "localhost"})
    assert done.returncode == 0, done.stdout
    return folder


def test_page_says_how_it_ended_and_leads_to_the_effect(demo):
    page = browser.shown(demo / "report.html", demo / "profile")
    verdict = page.one("section", id="verdict")
    assert verdict.attributes["data-level"] == "ERROR"
    assert "The failing damper is told in every drive" in verdict.one("h1").text
    assert "Missing from the model: coulomb_friction." in verdict.text
    link = verdict.one("a").attributes["href"]
    assert browser.shown(demo / link, demo / "profile").one("html").attributes["data-ready"] == "yes"
    assert "/monitor/health" in page.one(id="origin").text and "demo_report.py --quick" in page.one(id="origin").text


def test_page_leads_to_the_fleet(demo):
    page = browser.shown(demo / "report.html", demo / "profile")
    section = next(each for each in page.all("section") if "Weeks of a fleet" in each.text)
    assert "24 bags: " in section.text and "damping falls" in section.text
    assert (demo / section.one("a").attributes["href"]).stat().st_size > 10000
    assert (demo / "fleet/plotly.min.js").exists() and not list((demo / "work").rglob("*.bag")), "bags are deleted again"


@pytest.mark.parametrize("name", ["report.html", "effect_report/report.html"])
@pytest.mark.parametrize("width, dark", [(1400, False), (390, True)])  # colours move nothing
def test_nothing_is_cut_off_and_the_verdict_is_above_the_fold(demo, name, width, dark):
    root = browser.measured(demo / name, demo / "measured", width, dark).one("html").attributes
    assert (root["data-width"], root["data-dark"]) == (str(width), str(dark).lower())
    assert (root["data-cut"], root["data-scrolls"], root["data-broken"]) == ("", "0", "")
    assert 0 < float(root["data-verdict-ends"]) <= FOLD
