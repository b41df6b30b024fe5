"""The demo's report from a synthetic recording whose errors are known in closed form."""
import html.parser
import pathlib
import re
import sys
import types

import numpy
import pytest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "scripts"))

from report import accuracy, drawing, fleet, hidden_effect, page, recording, sections, table  # noqa: E402
from report.experiments import EXPERIMENTS, Claim, read_settings  # noqa: E402

PERIOD = 0.02
TIME = PERIOD * numpy.arange(6001)
B1 = numpy.interp(TIME, [40, 100], [3, 2])
B0 = numpy.full(TIME.shape, 13.8)
LS_ERROR = (0.4, -2.0)  # constant: rms and largest are its size
LA_ERROR = (0.03, 0.06)
LEVEL_TIMES = (70.0, 90.0)  # OK, WARN, ERROR


def rows(**values):
    return numpy.rec.fromarrays([TIME, *(numpy.broadcast_to(value, TIME.shape) for value in values.values())],
                                names=["time", *values])


def estimates(error):
    return rows(damping_to_mass=B1 + error[0], stiffness_to_mass=B0 + error[1], valid=True)


def synthetic(bump):
    measured = 9.81 + numpy.sin(TIME)
    return recording.Recording(
        ls=estimates(LS_ERROR), la=estimates(LA_ERROR),
        comparison=rows(measured=measured, predicted=measured - 0.5, residual=0.5, rmse=0.5, fit_percent=29.0),
        health=rows(level=numpy.searchsorted(LEVEL_TIMES, TIME, side="right"), reason="damping & more",
                    damping_change=B1 / 3 - 1, nominal_damping_to_mass=3.0),
        truth=rows(damping_to_mass=B1, stiffness_to_mass=B0, road=0.1 + bump * numpy.exp(-22.2 * (TIME - 85)**2)))


@pytest.fixture(scope="module")
def results():
    recordings = {experiment.scenario: synthetic(0.15 if experiment.scenario == "paper_saturation" else 0.0)
                  for experiment in EXPERIMENTS}
    return sections.Results(read_settings(REPOSITORY / "config"), EXPERIMENTS, recordings, {}, seed=7, seeds=20)


@pytest.fixture(scope="module")
def text(results):
    return page.page("A title", sections.report_sections(results))


class Reader(html.parser.HTMLParser):
    """Notes what the page refers to, its ids, and whether each tag is closed."""
    VOID = {"meta", "br", "path", "use", "rect"}

    def __init__(self, text):
        super().__init__()
        self.open, self.ids, self.targets, self.rows, self.cell = [], [], [], [], False
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        if tag not in self.VOID:
            self.open.append(tag)
        for name, value in attributes:
            if name == "id":
                self.ids.append(value)
            if name in ("href", "src", "xlink:href", "srcset", "data"):
                self.targets.append(value)
        if tag == "tr":
            self.rows.append([])
        if tag == "td":
            self.rows[-1].append("")
            self.cell = True

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        if tag not in self.VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        if tag in self.VOID:
            return
        assert self.open.pop() == tag
        self.cell = self.cell and tag != "td"

    def handle_data(self, data):
        if self.cell:
            self.rows[-1][-1] += data


def test_page_has_every_figure_with_its_panels(text):
    captions = re.findall(r"<figcaption><b>(.*?)</b>", text)
    assert {"Fig. 3", "Fig. 4", "Fig. 5", "Fig. 6", "Fig. 7"} <= set(captions)
    assert text.count("<svg") == len(captions) == 9
    assert text.count("time [s]") == 9
    for unit in ("damping/mass [1/s]", "stiffness/mass [1/s²]", "height [cm]", "nominal [%]", "body [m/s²]"):
        assert unit in text


def test_levels_over_time_come_first_with_the_way_to_the_effect(results, text):
    first = text[text.index("<section"):text.index("</section>")]
    assert first.startswith('<section id="verdict" class="verdict" data-level="ERROR">')
    assert first.index("<h1>") < first.index("<svg") < first.index("<p>")
    assert "The first WARN or ERROR comes at 70 s (no fault), 70 s (data loss), 70 s (end stops)" in first
    results.search = search_result()
    try:
        assert 'href="effect_report/report.html"' in sections.verdict(results).to_html()
    finally:
        results.search = None


def test_page_tells_what_it_was_made_from():
    text = page.page("A title", [], (("command", "demo --output <x>"),))
    assert "<dt>command</dt><dd>demo --output &lt;x&gt;</dd>" in text


def test_page_refers_to_nothing_outside_itself(text):
    reader = Reader(text)
    assert reader.open == []
    assert len(reader.ids) == len(set(reader.ids))
    inside = {f"#{name}" for name in reader.ids}
    assert set(reader.targets) <= inside
    assert {f"#{name}" for name in re.findall(r"url\(#([^)]*)\)", text)} <= inside
    assert not re.search(r"https?:|@import|<script|url\((?!#)|xmlns", text)


def test_curves_take_their_colours_from_the_page(text):
    assert not re.search("|".join(drawing.COLOURS.values()), text)
    style = "".join(path.read_text() for path in page.STYLES)
    for name in drawing.COLOURS:
        follows = re.search(rf"--{name}: var\(--([\w-]+)\)", style)
        assert style.count(f"--{follows[1] if follows else name}:") == 2, "one for a light, one for a dark background"
    assert set(re.findall(r"var\(--(\w+)\)", text)) - {"colour"} <= set(re.findall(r"--([\w-]+):", style))


def test_table_tells_the_known_errors(text):
    drive = [row for row in Reader(text).rows if row[:1] == ["data loss"]]
    assert drive[0][:6] == ["data loss", "LS", "0.400", "0.400", "2.000", "2.000"]
    assert drive[1][:6] == ["data loss", "LA", "0.030", "0.030", "0.060", "0.060"]
    assert drive[0][7] == "NOT HELD"  # LS is good at b1 here: 0.40 < 0.45
    assert drive[1][7] == "held"


def test_text_counts_the_claims(results, text):
    held = {(experiment.scenario, estimator): held for experiment, estimator, _, held in results.claims()}
    assert held == {("paper_clean", "ls"): False, ("paper_clean", "la"): True,
                    ("paper_outliers", "ls"): False, ("paper_outliers", "la"): True,
                    ("paper_saturation", "ls"): False, ("paper_saturation", "la"): True}  # b0: 2 < 6
    assert "3 of 6 claims held" in text


def test_claim_needs_both_parameters():
    assert Claim(True, (0.1, 0.2)).holds((0.1, 0.2)) and not Claim(True, (0.1, 0.2)).holds((0.05, 0.21))
    assert Claim(False, (0.1, 0.2)).holds((0.1, 0.2)) and not Claim(False, (0.1, 0.2)).holds((0.09, 9.0))
    assert not Claim(True, (0.1, 0.2)).holds((float("nan"), 0.0))


def test_accuracy_counts_only_what_is_settled():
    error = numpy.where(TIME <= 10.0, 100.0, numpy.where(TIME > 65.0, 3.0, 4.0))
    found = accuracy.accuracy(TIME, [B1 + error, B0], [B1, B0])
    assert found.largest == pytest.approx((4.0, 0.0))
    assert found.rms[0] == pytest.approx(12.5**0.5, rel=1e-6)  # half of the time 4, half 3


def test_lag_is_the_delay_of_the_estimate(results):
    late = synthetic(0.0)
    late.la.damping_to_mass = numpy.interp(TIME - 2.5, [40, 100], [3, 2])
    assert accuracy.ramp_lag(late, "la") == pytest.approx(2.5, rel=0.05)


def test_median_is_taken_of_each_figure_by_itself():
    parts = [accuracy.Accuracy((value, 10 * value), (1.0, -value)) for value in (3.0, 1.0, 2.0)]
    assert accuracy.median(parts) == accuracy.Accuracy((2.0, 20.0), (1.0, -2.0))


def test_health_tells_when_the_level_changed_and_escapes_the_reason(results, text):
    assert [row[:3] for row in sections.health_changes(results).rows[:3]] == [
        ("no fault", "0.0", ("OK", "ok")), ("no fault", "70.0", ("WARN", "warn")),
        ("no fault", "90.0", ("ERROR", "error"))]
    assert "damping &amp; more" in text


def test_fit_and_rmse_are_those_of_the_excerpt(results):
    rows_in, rmse, fit = sections.figures.excerpt(results.recordings["paper_clean"].comparison, 80.0, 86.0)
    assert (rows_in.time[0], rows_in.time[-1]) == pytest.approx((80.0, 86.0))
    assert rmse == pytest.approx(0.5)
    assert fit == pytest.approx(100 * (1 - 0.5 / numpy.std(rows_in.measured)))


def test_peaks_beyond_the_panel_are_named():
    values = numpy.where(abs(TIME - 25) < 1, 30.0, 13.8) - numpy.where(abs(TIME - 65) < 1, 20.0, 0.0)
    peaks = sections.figures.excursions(rows(stiffness_to_mass=values), "stiffness_to_mass", (7.5, 20.5))
    assert [round(value, 1) for _, value in peaks] == [30.0, -6.2]


def cut(whole, field, keep):
    parts = dict(vars(whole))
    parts[field] = parts[field][keep]
    return recording.Recording(**parts)


@pytest.mark.parametrize("field, topic", [(field, topic) for field, (topic, _) in recording.FIELDS.items()])
def test_missing_row_is_named(field, topic):
    gap = cut(synthetic(0.0), field, abs(TIME - 50.0) > 0.5 * PERIOD)
    due = 5941 - (recording.COMPARISON_DELAY if field == "comparison" else 0)
    with pytest.raises(recording.IncompleteRecording, match=f"drive: {topic} lacks 1 of {due} .* first at 50.00 s"):
        recording.require_complete(gap, "drive", 1.2, 120.0, PERIOD)


def test_missing_end_and_empty_topic_are_seen():
    with pytest.raises(recording.IncompleteRecording, match="lacks 50 of 5941"):
        recording.require_complete(cut(synthetic(0.0), "la", TIME < 119.01), "drive", 1.2, 120.0, PERIOD)
    with pytest.raises(recording.IncompleteRecording, match="lacks 5941 of 5941"):
        recording.require_complete(cut(synthetic(0.0), "la", TIME < -1), "drive", 1.2, 120.0, PERIOD)


def test_rows_before_the_filter_is_full_are_not_needed():
    recording.require_complete(cut(synthetic(0.0), "ls", TIME > 1.19), "drive", 1.2, 120.0, PERIOD)


def test_estimate_that_is_no_number_is_seen():
    bad = synthetic(0.0)
    bad.la.stiffness_to_mass[3000] = numpy.nan
    with pytest.raises(recording.IncompleteRecording, match="/monitor/la has 1 estimates.* 60.00 s"):
        recording.require_complete(bad, "drive", 1.2, 120.0, PERIOD)


def test_columns_hold_the_stamps_and_the_fields():
    def message(seconds, level):
        return types.SimpleNamespace(header=types.SimpleNamespace(stamp=types.SimpleNamespace(to_sec=lambda: seconds)),
                                     level=level)
    read = recording.columns([message(1.5, 0), message(2.5, 2)], ("level",))
    assert read.time.tolist() == [1.5, 2.5] and read.level.tolist() == [0, 2]
    assert len(recording.columns([], ("level",))) == 0


def test_settings_are_those_of_the_launch_file():
    settings = read_settings(REPOSITORY / "config")
    assert (settings.period, settings.first_row) == pytest.approx((0.02, 1.2))


def test_terminal_table_is_aligned(results):
    lines = table.Table("Title", [table.Column("a", css="text"), table.Column("b", "m")],
                        [("long name", "1.0"), (("x", "ok"), "20.0")]).to_text().splitlines()
    assert lines == ["Title", "a             b", "            [m]", "---------------",
                     "long name   1.0", "x          20.0"]
    assert sections.tables(results)[0].to_text().count("NOT HELD") == 3


def test_file_is_written_whole_or_not_at_all(tmp_path):
    path = tmp_path / "report.html"
    page.write_whole(path, "old")
    with pytest.raises(UnicodeEncodeError):
        page.write_whole(path, "new" * 100000 + "\ud800")
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_the_fleet_names_what_wears_and_leads_to_its_page():
    struts = [{"vehicle": "robot_1", "strut": name, "outlook": f"{name} <outlook>"} for name in ("left", "right")]
    section = fleet.section(fleet.Fleet("2 bags: 1 ok & 1 bad", struts, {("robot_1", "left"): 0.1, ("robot_1", "right"): 0.0}))
    text = section.to_html()
    assert "left &lt;outlook&gt;" in text and "right &lt;outlook&gt;" not in text, "only those that wear"
    assert "2 bags: 1 ok &amp; 1 bad" in text and 'href="fleet/index.html"' in text and "1 of their dampers" in text


def search_result(**extended):
    result = {"selected": ["coulomb_friction"] if extended else [], "noise_floor": 0.0264,
              "base": {"held_out_rmse": 0.2021}}
    return hidden_effect.Search({**result, **extended}, "Missing <or> not.")


def test_hidden_effect_has_its_ladder_and_a_way_to_its_page():
    found = search_result(extended={"held_out_rmse": 0.028, "coefficients": {"coulomb_friction": 0.3512},
                                    "stddevs": {"coulomb_friction": 0.0012}})
    assert hidden_effect.ladder(found).rows == [("model as it is", "0.2021"), ("with coulomb_friction", "0.0280"),
                                                ("noise floor, about", "0.0264")]
    text = hidden_effect.section(found).to_html()
    assert Reader(text).targets == ["effect_report/report.html"]
    assert "hidden 0.35 m/s², found 0.351 ± 0.001 m/s²" in text
    assert "Missing &lt;or&gt; not." in text


def test_hidden_effect_that_is_not_found_is_no_error():
    found = search_result()
    assert hidden_effect.ladder(found).rows == [("model as it is", "0.2021"), ("noise floor, about", "0.0264")]
    assert "hidden 0.35" not in hidden_effect.section(found).to_html()
