"""suspension_fleet show and report: what is said of a fleet, in a terminal, in JSON and in a browser."""
import base64
import dataclasses
import errno
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import types

import numpy as np
import pytest

import browser
import conftest
import imu_bag
from fleet import session

for module in ("plotly", "scipy", "sqlalchemy"):
    pytest.importorskip(module)
from plotly.offline import get_plotlyjs  # noqa: E402
from suspension_health_monitor.fleet import database, outlook, prognosis, report, report_data, show  # noqa: E402
from suspension_health_monitor.fleet.command import main  # noqa: E402  after the reason to skip
from suspension_health_monitor.fleet.drive import OK, Drive  # noqa: E402
from suspension_health_monitor.fleet.history import YEAR, Event, series  # noqa: E402

BEGIN, DRIVES = 1.6e9, 60
HOSTILE = 'robot <b>&"\' 1'
MOST_BYTES = 3_000_000


def write_fleet(engine, folder):
    """Three vehicles: left worn by 12 % a year, right renewed after a year, and one that has only just come."""
    random = np.random.default_rng(1)
    for vehicle, drives in ((HOSTILE, DRIVES), ("robot_2", DRIVES), ("new", 2)):
        for k in range(drives):
            time = 2 * k / DRIVES
            wears = time if vehicle == HOSTILE else 0.0
            shares = {"left": 1 - 0.12 * wears, "right": 1 - 0.2 * wears if time < 1 else 1.0}
            load = random.uniform(1, 1.3)
            struts = [dict(
                strut=name, estimator="estimate", damping_to_mass=4 * share * np.exp(0.01 * random.normal()) / load,
                damping_to_mass_stddev=0.04, stiffness_to_mass=60 / load, stiffness_to_mass_stddev=0.6, offset=0.0,
                temperature=None, valid=True, reason=None) for name, share in shares.items()]
            last = k == drives - 1 and vehicle == HOSTILE
            start = BEGIN + YEAR * time
            event = dict(strut="left", time=start + 5, level="WARN", message="damping <i>21 %</i> low")
            finding = dict(strut="left", verdict="effect_found", effects="bump_stop coulomb_friction",
                           page=str(folder / "pages" / "a:<b>&" / "report.html"))
            bag = database.Bag(f"{vehicle} {k}", f"{vehicle}/{k}.bag", vehicle)
            database.write(engine, bag, Drive(OK, start=start, duration=60.0, struts=struts,
                                                       events=last * [event], findings=last * [finding]))


@pytest.fixture(scope="module")
def fleet(tmp_path_factory):
    folder = tmp_path_factory.mktemp("fleet")
    url = f"sqlite:///{folder / 'fleet.db'}"
    write_fleet(database.connect(url, create=True), folder)
    assert main(["show", "--db", url, "--json", str(folder / "fleet.json")]) == 0
    assert main(["report", "--db", url, "-o", str(folder / "page")]) == 0
    return types.SimpleNamespace(folder=folder, url=url, page=folder / "page" / "index.html",
                                 told=json.loads((folder / "fleet.json").read_text()),
                                 histories=database.histories(database.connect(url)))


def shown(fleet, address=""):
    """The page with a strut open: by the address after #, which a file's URL is given as a frame here."""
    copy = fleet.folder / f"shown{address[1:]}"
    if not copy.exists():
        shutil.copytree(str(fleet.page.parent), str(copy))
        begin = "<script>\n(() => {"
        text = fleet.page.read_text().replace(begin, begin.replace("(", f"location.hash = '{address}';\n(", 1), 1)
        (copy / "index.html").write_text(text)
    return copy / "index.html"


def page_of(fleet, address=""):
    return browser.shown(shown(fleet, address), fleet.folder / "profile")


# Terminal and JSON -------------------------------------------------------------------------------------------------

def test_most_urgent_comes_first(fleet):
    names = [(each["vehicle"], each["strut"]) for each in fleet.told]
    assert names[0] == (HOSTILE, "left") and len(names) == 6
    assert [each["dated"] for each in fleet.told] == ["damping"] + 5 * [None]


def test_json_tells_times_shares_and_rates(fleet):
    worn = fleet.told[0]
    early, middle, late = worn["wear"]["damping"]["date"]
    assert early < middle < late and early <= BEGIN + YEAR * 0.3 / 0.12 <= late
    assert worn["wear"]["damping"]["rate"] == pytest.approx(0.01, rel=0.15)
    assert worn["wear"]["damping"]["loss"][1] == pytest.approx(0.24, abs=0.03)
    assert worn["last_event"]["level"] == "WARN" and worn["drives"] == DRIVES
    assert [each["name"] for each in worn["effects"]] == ["bump_stop", "coulomb_friction"]
    renewed = next(each for each in fleet.told if (each["vehicle"], each["strut"]) == (HOSTILE, "right"))
    (change,) = renewed["changes"]
    assert change["time"] == BEGIN + YEAR and change["part"] == "damping"
    assert change["step"] == pytest.approx(-np.log(0.8), abs=0.04)


def test_table_fits_the_terminal_and_cuts_nothing_off(fleet, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "140")
    assert main(["show", "--db", fleet.url]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= 140
    assert lines[0].split() == "vehicle strut drives damping stiffness outlook last event effects".split()
    assert lines[1].startswith(f"{HOSTILE}  left") and "WARN on " in lines[1]
    words = " ".join(" ".join(lines).split())
    for word in fleet.told[0]["outlook"].split():
        assert word in words


def test_wrong_clocks_change_nothing_but_are_named(fleet, tmp_path):
    """A drive of 1970 would be a trend of its own."""
    copy = tmp_path / "fleet.db"
    shutil.copy(fleet.url[len("sqlite:///"):], str(copy))
    engine = database.connect(f"sqlite:///{copy}")
    for start in (3.0, 4e6):
        struts = [dict(strut="left", estimator="estimate", damping_to_mass=9.0, damping_to_mass_stddev=0.04, stiffness_to_mass=60.0,
                       stiffness_to_mass_stddev=0.6, offset=0.0, temperature=None, valid=True, reason=None)]
        database.write(engine, database.Bag(str(start), f"{start}.bag", HOSTILE),
                       Drive(OK, start=start, duration=60.0, struts=struts))
    assert main(["show", "--db", f"sqlite:///{copy}", "--json", str(tmp_path / "x.json")]) == 0
    told = json.loads((tmp_path / "x.json").read_text())
    said = "; 2 drives have a wrong clock"
    assert told[0]["wrong_clocks"] == 2 and told[0]["outlook"].endswith(said)
    assert [{**told[0], "wrong_clocks": 0, "outlook": told[0]["outlook"][:-len(said)]}, *told[1:]] == fleet.told


def test_a_renamed_folder_is_named_in_the_table(fleet, tmp_path, capsys):
    """One more drive of the same struts, from a folder of another name."""
    copy = tmp_path / "fleet.db"
    shutil.copy(fleet.url[len("sqlite:///"):], str(copy))
    engine = database.connect(f"sqlite:///{copy}")
    struts = [dict(strut=name, estimator="estimate", damping_to_mass=4.0 * share, damping_to_mass_stddev=0.04,
                   stiffness_to_mass=60.0, stiffness_to_mass_stddev=0.6, offset=0.0, temperature=None, valid=True, reason=None)
              for name, share in (("left", 0.76), ("right", 1.0))]
    database.write(engine, database.Bag("again", "unit_7/0.bag", "unit_7"),
                   Drive(OK, start=BEGIN + 2.1 * YEAR, duration=60.0, struts=struts))
    for told in ([], ["--renamed", f"unit_7={HOSTILE}"], ["--renamed", "unit_7="]):
        assert main(["show", "--db", f"sqlite:///{copy}", "--json", "-", *told]) == 0
        found = [each for each in json.loads(capsys.readouterr().out) if each["vehicle"] == "unit_7"]
        assert len(found) == 2
        if told != ["--renamed", "unit_7="]:
            assert all(each["formerly"] == [HOSTILE] and each["drives"] == DRIVES + 1 for each in found)
            assert all(f"the vehicle was called {HOSTILE} until " in each["outlook"] for each in found)
        else:
            assert all(each["formerly"] == [] and each["drives"] == 1 for each in found)


def test_json_goes_to_standard_output(fleet, capsys):
    assert main(["show", "--db", fleet.url, "--json", "-"]) == 0
    assert json.loads(capsys.readouterr().out) == fleet.told


@pytest.mark.parametrize("command, words", [
    (["show", "--threshold", "2"], ["--threshold 2", "[0.01, 0.9]"]),
    (["show", "--renamed", "robot_9=new"], ["--renamed robot_9=new", "NEW=OLD"]),
    (["report", "-o", "page", "--level", "nan"], ["--level nan", "[0.5, 0.99]"])])
def test_wrong_options_are_refused(fleet, capsys, tmp_path, monkeypatch, command, words):
    monkeypatch.chdir(tmp_path)
    assert main([*command, "--db", fleet.url]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and all(word in said for word in words)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("option, command", [
    ("-o/--output", ["report", "-o", ""]), ("--db", ["show", "--db="]), ("--json", ["show", "--json", ""]),
    ("-o/--output", ["simulate", "-o", ""]), ("--db", ["scan", "bags", "--db", ""]), ("PATH", ["scan", ""]),
    ("--pages", ["scan", "bags", "--diagnose", "--pages", ""])])
def test_what_is_empty_is_refused(capsys, tmp_path, monkeypatch, option, command):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit) as ended:
        main(command)
    assert ended.value.code == 2
    assert capsys.readouterr().err.endswith(f"argument {option}: '', must not be empty\n")
    assert list(tmp_path.iterdir()) == []


def test_what_cannot_be_written_is_refused(fleet, capsys, tmp_path):
    (tmp_path / "file").write_text("here first")
    for folder in (tmp_path / "file", tmp_path / "no" / "folder"):
        assert main(["report", "--db", fleet.url, "-o", str(folder)]) == 3
        assert f"{folder}: cannot be made" in capsys.readouterr().err
    assert main(["show", "--db", fleet.url, "--json", str(tmp_path / "no" / "x.json")]) == 3


@pytest.mark.parametrize("command", [["show"], ["report", "-o", "page"]])
@pytest.mark.parametrize("database_is", ["missing", "half-made", "of another kind"])
def test_without_a_whole_database_nothing_is_made(fleet, capsys, tmp_path, monkeypatch, command, database_is):
    monkeypatch.chdir(tmp_path)
    if database_is == "half-made":
        engine = database.connect("sqlite:///fleet.db", create=True)
        with engine.begin() as connection:
            connection.execute(database.text("DROP TABLE struts"))
    elif database_is == "of another kind":
        write_fleet(database.connect("sqlite:///fleet.db", create=True), tmp_path)
        with database.connect("sqlite:///fleet.db").begin() as connection:
            connection.execute(database.text("UPDATE struts SET damping_to_mass = 'stiff' WHERE id = 3"))
    assert main([*command, "--db", "sqlite:///fleet.db"]) == 3
    said = capsys.readouterr()
    assert said.out == "" and said.err.count("\n") == 1
    assert said.err.startswith(f"suspension_fleet {command[0]}: ") and "fleet.db" in said.err
    assert not (tmp_path / "page").exists()


def test_a_page_appears_whole_or_not_at_all(fleet, tmp_path, monkeypatch, capsys):
    """On a disk that is full: a page that is there stays."""
    page = tmp_path / "page"
    page.mkdir()
    (page / "index.html").write_text("here first")

    def full(*_):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
    monkeypatch.setattr(os, "replace", full)
    assert main(["report", "--db", fleet.url, "-o", str(page)]) == 3
    assert capsys.readouterr().err == f"suspension_fleet report: {page}/plotly.min.js: No space left on device\n"
    assert [path.name for path in page.iterdir()] == ["index.html"]
    assert (page / "index.html").read_text() == "here first"


@pytest.mark.parametrize("ended_at", ["in_order", "write"])
@pytest.mark.parametrize("is_new", [True, False])
def test_a_report_that_is_interrupted_leaves_what_was_there(fleet, tmp_path, monkeypatch, ended_at, is_new):
    def interrupted(*_):
        raise KeyboardInterrupt
    page = tmp_path / "page"
    if not is_new:
        page.mkdir()
        (page / "notes.txt").write_text("here first")
    place = outlook if ended_at == "in_order" else report
    monkeypatch.setattr(place, ended_at, interrupted)
    with pytest.raises(KeyboardInterrupt):
        report.run(types.SimpleNamespace(db=fleet.url, output=str(page), workers=1, renamed=[],
                                         **vars(outlook.Options())))
    assert sorted(tmp_path.rglob("*")) == ([] if is_new else [page, page / "notes.txt"])


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_report_that_is_ended_says_so_and_leaves_nothing(fleet, tmp_path, number):
    program = imu_bag.REPOSITORY / "python/suspension_fleet"
    process = subprocess.Popen([sys.executable, str(program), "report", "--db", fleet.url, "-o", "page"], cwd=tmp_path,
                               stderr=subprocess.PIPE, stdout=subprocess.PIPE, start_new_session=True, text=True)
    conftest.wait_until((tmp_path / "page").exists)
    os.killpg(process.pid, number)
    assert process.communicate(timeout=conftest.HANGS) == ("", f"suspension_fleet report: ended by {number.name}\n")
    assert process.returncode == -number and list(tmp_path.iterdir()) == []


def test_no_process_outlives_a_show_that_is_killed(fleet):
    process = show_as_a_process(fleet, start_new_session=True, stdout=subprocess.DEVNULL)
    conftest.wait_until(lambda: len(session(process.pid)) >= 3)  # with the tracker of resources, and one that works
    process.kill()
    process.communicate(timeout=conftest.HANGS)
    conftest.wait_until(lambda: not session(process.pid))


def end_this_process(*_, **__):
    os.kill(os.getpid(), signal.SIGKILL)


def test_a_process_that_is_ended_is_said_in_words(fleet, monkeypatch, capsys):
    monkeypatch.setattr(prognosis, "prognosis", end_this_process)
    assert main(["show", "--db", fleet.url, "--workers", "1"]) == 3
    assert capsys.readouterr().err == (
        "suspension_fleet show: one of 1 processes has ended, as for want of memory: fewer --workers need less\n")


def show_as_a_process(fleet, **keywords):
    program = imu_bag.REPOSITORY / "python/suspension_fleet"
    return subprocess.Popen([sys.executable, str(program), "show", "--db", fleet.url], stderr=subprocess.PIPE, **keywords)


def test_a_terminal_without_our_characters_is_served(fleet):
    process = show_as_a_process(fleet, stdout=subprocess.PIPE, env=dict(os.environ, PYTHONIOENCODING="ascii"))
    output, error = process.communicate(timeout=conftest.HANGS)
    assert (process.returncode, error) == (0, b"") and rb"\xb1" in output


def test_standard_output_that_takes_no_more(fleet):
    with open("/dev/full", "w") as full:
        process = show_as_a_process(fleet, stdout=full)
        _, error = process.communicate(timeout=conftest.HANGS)
    assert (process.returncode, error) == (3, b"suspension_fleet show: standard output: No space left on device\n")
    process = show_as_a_process(fleet, stdout=subprocess.PIPE)
    process.stdout.close()
    assert (process.wait(timeout=conftest.HANGS), process.stderr.read()) == (-signal.SIGPIPE, b"")


def test_names_do_not_reach_the_terminal_as_controls(fleet):
    history = dataclasses.replace(fleet.histories[0], vehicle="ro\x1b[31mbot\n", strut="\u202eleft",
                                  events=[Event(BEGIN, "WARN", "low\x07", "a.bag")])
    lines = show.table([(history, None)], 160).splitlines()
    assert len(lines) == 2 and lines[1].startswith(r"ro\x1b[31mbot\n  \u202eleft  ")
    (strut,) = report_data.page_data([(history, None)], fleet.folder)["struts"]
    assert (strut["vehicle"], strut["strut"]) == (r"ro\x1b[31mbot\n", r"\u202eleft")
    assert strut["events"][0][2] == r"low\x07"


def test_a_strut_that_is_worn_without_a_date_is_due(fleet):
    history, result = next(pair for pair in outlook.in_order(fleet.histories, outlook.Options(), 1) if pair[1].dated)
    broken = {part: dataclasses.replace(wear, loss=(0.4, 0.5, 0.6)) for part, wear in result.wear.items()}
    for more, due in (({}, True), (dict(dated=None), False), (dict(dated=None, wear=broken), True)):
        (strut,) = report_data.page_data([(history, dataclasses.replace(result, **more))], fleet.folder)["struts"]
        assert strut["due"] == due


def test_struts_without_a_valid_drive_are_listed(fleet):
    empty = dataclasses.replace(fleet.histories[0], time=np.zeros(0), damping_to_mass=np.zeros(0),
                                damping_to_mass_stddev=np.zeros(0), stiffness_to_mass=np.zeros(0),
                                stiffness_to_mass_stddev=np.zeros(0), path=[])
    pair = (empty, None)
    assert "no drive whose estimates are valid" in show.table([pair], 120)
    assert show.as_dict(*pair)["drives"] == 0
    assert outlook.urgency(pair)[0] == float("inf")
    assert "drives" not in report_data.page_data([pair], fleet.folder)["struts"][0]


# Page --------------------------------------------------------------------------------------------------------------

def test_scripts_run_without_an_error(fleet):
    for address in ("", "#1", "#6"):
        page = page_of(fleet, address)
        assert page.one(id="script-errors").text == ""
        assert page.one("html").attributes["data-ready"] == "yes"


def test_page_loads_plotly_from_beside_it_and_nothing_else(fleet):
    assert sorted(path.name for path in fleet.page.parent.iterdir()) == ["index.html", "plotly.min.js"]
    text = re.sub("http://www.w3.org/2000/svg", "", fleet.page.read_text())
    assert re.findall(r"(?:src|href)=\"([^\"]*)\"", text) == ["plotly.min.js"]
    assert not re.search(r"@import|url\(|fetch\(|XMLHttpRequest|https?://", text)


def test_a_large_fleet_is_small_enough(fleet):
    """500 struts of 365 drives, by what one of these takes and by what a drive of it takes."""
    history, result = next(pair for pair in outlook.in_order(fleet.histories, outlook.Options(), 1) if pair[1].dated)
    sizes = []
    for copies in (1, 6):
        more = dataclasses.replace(history, path=copies * history.path, **{
            name: np.tile(getattr(history, name), copies) for name in (
                "time", "damping_to_mass", "damping_to_mass_stddev", "stiffness_to_mass", "stiffness_to_mass_stddev")})
        sizes.append(len(json.dumps(report_data.page_data([(more, result)], fleet.folder), separators=(",", ":"))))
    of_drive = (sizes[1] - sizes[0]) / (5 * DRIVES)
    assert of_drive < 11
    assert 500 * (sizes[0] + (365 - DRIVES) * of_drive) < MOST_BYTES


def test_a_fleet_in_which_nothing_is_due_says_no_more_than_that(fleet, tmp_path):
    pairs = [pair for pair in outlook.in_order(fleet.histories, outlook.Options(), 1) if not pair[1].dated]
    report.write(pairs, get_plotlyjs(), tmp_path)
    page = browser.shown(tmp_path / "index.html", tmp_path / "profile")
    assert page.one("h1").text == "No strut is known to be due at the workshop"


def test_map_and_list_have_every_strut(fleet):
    page = page_of(fleet)
    assert page.one("h1").text == "One strut is due at the workshop, now or by a date"
    rows = [row for row in page.one(id="list").all("tr") if "data-strut" in row.attributes]
    names = [f"{each['vehicle']} {each['strut']}" for each in fleet.told]
    assert [row.attributes["data-strut"] for row in rows] == names
    assert [list(row.all("td"))[2].text for row in rows] == [each["outlook"] for each in fleet.told]
    labels = {text.text for text in page.one(id="map").all("text")}
    assert {HOSTILE, "robot_2", "new", "left", "right"} <= labels
    assert page.one(id="strut").text == ""


def test_strut_is_opened_with_its_history(fleet):
    page = page_of(fleet, "#1")
    section = page.one(id="strut")
    assert section.one("h2").text == f"{HOSTILE} left"
    assert section.one("p", class_="answer").text == fleet.told[0]["outlook"]
    assert "damping <i>21 %</i> low" in section.text and "bump stop coulomb friction" in section.text
    (link,) = section.all("a", href="../pages/a%3A%3Cb%3E%26/report.html")
    drawn = [path for path in section.all("path", class_="point")]
    assert len(drawn) == 3 * DRIVES
    assert len([path for path in section.all("path") if "errorbar" in path.attributes.get("class", "")
                or "yerror" in path.attributes.get("class", "")]) == 3 * DRIVES
    assert len(list(section.all("path", class_="js-fill"))) == 1


def test_changes_are_marked(fleet):
    marks = []
    for i, each in enumerate(fleet.told, start=1):
        if each["vehicle"] == HOSTILE:
            section = page_of(fleet, f"#{i}").one(id="strut")
            shapes = [path for path in section.all("path") if "data-index" in path.attributes]
            marks.append((each["strut"], len(shapes), [remark in section.text for remark in each["remarks"]]))
    assert sorted(marks) == [("left", 1, []), ("right", 2, [True])]  # one is the threshold


def test_packed_numbers_are_those_of_the_drives(fleet):
    """As the page unpacks them: a bar's length to 3 %, everything else to less than a pixel."""
    history = next(each for each in fleet.histories if (each.vehicle, each.strut) == (HOSTILE, "left"))
    packed = report_data.page_data([(history, None)], fleet.folder)
    drives = report_data._drives(history)
    raw = np.frombuffer(base64.b64decode(drives["drives"]), dtype="u1")
    count = drives["count"]
    time, b1, b0 = (raw[2 * k * count:2 * (k + 1) * count].view(kind).astype(float)
                    for k, kind in enumerate(("<u2", "<i2", "<i2")))
    spread = packed["stddev_least"] * np.exp(packed["stddev_step"] * raw[6 * count:].astype(float))
    _, damping, stiffness = series(history)
    assert drives["from"] + drives["span"] * time / 65535 == pytest.approx(history.time, abs=YEAR / 10000)
    assert drives["first"][0] + packed["logarithm_step"] * b1 == pytest.approx(damping.value, abs=1e-4)
    assert drives["first"][1] + packed["logarithm_step"] * b0 == pytest.approx(stiffness.value, abs=1e-4)
    assert spread == pytest.approx(np.concatenate([damping.stddev, stiffness.stddev]), rel=0.02)


@pytest.mark.parametrize("width, dark", [(1400, False), (390, True)])  # colours move nothing
def test_nothing_is_cut_off(fleet, width, dark):
    profile = fleet.folder / f"measured_{width}_{dark}"
    profile.mkdir()
    shutil.copy(str(fleet.page.parent / "plotly.min.js"), str(profile))
    root = browser.measured(shown(fleet, "#1"), profile, width, dark).one("html").attributes
    assert (root["data-width"], root["data-dark"]) == (str(width), str(dark).lower())
    assert root["data-cut"] == ""
