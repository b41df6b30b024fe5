"""What the report tells, section by section. A new section is one function here and one line in `report_sections`."""
import dataclasses

import numpy

from . import figures, fleet, hidden_effect
from .accuracy import ESTIMATORS, SETTLED, ramp_lag, recording_accuracy
from .experiments import DURATION, Settings
from .page import Figure, Section
from .table import Column, Table

EXCERPT = (80.0, 86.0)  # [s]
ERROR_COLUMNS = [Column("drive", css="text"), Column("estimator", css="text"),
                 Column("b1 rms", "1/s"), Column("b1 max", "1/s", css="minor"), Column("b0 rms", "1/s²"),
                 Column("b0 max", "1/s²", css="minor"), Column("claim: rms b1, b0", css="text minor"),
                 Column("", css="text")]


@dataclasses.dataclass
class Results:
    """All that the report is made of. recordings: {scenario: Recording}; medians: {} where seeds were not run."""
    settings: Settings
    experiments: tuple
    recordings: dict
    medians: dict
    seed: int
    seeds: int
    search: hidden_effect.Search = None  # of the drive with a hidden effect
    robots: fleet.Fleet = None

    def __post_init__(self):
        self.accuracies = {scenario: recording_accuracy(recording) for scenario, recording in self.recordings.items()}

    def claims(self):
        """[(experiment, estimator, claim, held)], judged by the medians where there are some."""
        judged = self.medians or self.accuracies
        return [(experiment, estimator, claim, claim.holds(judged[experiment.scenario][estimator].rms))
                for experiment in self.experiments for estimator, claim in experiment.claims.items()]

    def drive(self, scenario):
        """(recording, experiment, {estimator: Accuracy}) of a scenario."""
        experiment = next(each for each in self.experiments if each.scenario == scenario)
        return self.recordings[scenario], experiment, self.accuracies[scenario]


def error_table(title, results, accuracies):
    """LS against LA in every drive, the paper's claims beside them."""
    rows = []
    for experiment in results.experiments:
        for estimator, name in ESTIMATORS.items():
            found, claim = accuracies[experiment.scenario][estimator], experiment.claims[estimator]
            held = claim.holds(found.rms)
            rows.append((experiment.title, (name, estimator),
                         *(f"{value:.3f}" if value < 9.9995 else f"{value:.1f}"
                           for pair in zip(found.rms, found.largest) for value in pair),
                         str(claim), ("held", "ok") if held else ("NOT HELD", "error")))
    return Table(title, ERROR_COLUMNS, rows)


def tables(results):
    """The medians, where there are some, and the run's own errors."""
    span = f"error of the estimates, {SETTLED:g} s < t ≤ {DURATION:g} s"
    result = [error_table(f"Through the nodelets, seed {results.seed}: {span}", results, results.accuracies)]
    if results.medians:
        result.append(error_table(f"Medians over {results.seeds} noise seeds: {span}", results, results.medians))
    return result


def introduction(results):
    return Section("What you see here", (
        "One IMU sits on the body above a suspension strut, one on the wheel carrier below it. From these two "
        "accelerations alone the monitor estimates, with every sample, two numbers of the strut: "
        "<b>b₁ = damping/mass</b> [1/s], which falls when a damper loses oil, and <b>b₀ = stiffness/mass</b> [1/s²], "
        "which changes with a broken or sagging spring.",
        'It does so by two methods side by side. <span class="ls">Least squares (LS)</span> is the usual one. The '
        '<span class="la">least sum of absolute values (LA)</span> lets single wrong readings count less. In each '
        "drive below the damper slowly loses a third of its damping between 40 s and 100 s. The drives differ in what "
        "else goes wrong: nothing, a sensor cable that drops out, or bumps that drive the strut into its end stops. "
        "The question is who still tells the truth. The levels go by neither: the monitor judges by an estimate of its "
        "own, <code>/monitor/estimate</code>.",
        "All curves were recorded from <code>/monitor/ls</code>, <code>/monitor/la</code>, "
        "<code>/monitor/comparison</code>, <code>/monitor/health</code> and <code>/simulator/truth</code> while the "
        "nodelets ran on simulated time, faster than the wall clock, with the settings of the paper "
        "(<code>config/paper.yaml</code>) and noise on both sensors. Every sample is there: the run fails when one is "
        "missing. The recordings are beside this page."))


def errors(results):
    held = [claim for claim in results.claims() if claim[-1]]
    by = f"medians over {results.seeds} noise seeds" if results.medians else f"this run, seed {results.seed}"
    return Section("LS against LA", (
        f"<b>{len(held)} of {len(results.claims())} claims held</b> (by {by}). The paper says in words that LS is "
        "“very sensitive” to data loss and end stops and LA “almost insensitive”. The bounds beside the errors put "
        "numbers to that: LA must stay below its bound in every drive, and LS must be good without a fault and bad "
        "with one. In the no-fault drive LS may well follow the damper more closely.",),
        tables=tuple(reversed(tables(results))))


def track(results, scenario, fault_label, names, ls_text, la_text):
    """LS and LA of one drive side by side; the texts take the largest errors of b1 and b0."""
    recording, experiment, found = results.drive(scenario)
    return tuple(Figure(figures.tracking(recording, experiment, (estimator,), fault_label), name,
                        text.format(*found[estimator].largest))
                 for estimator, name, text in zip(ESTIMATORS, names, (ls_text, la_text)))


def data_loss(results):
    return Section("Data loss", (
        "Twice both accelerations read zero (gravity apart) for one second, at 25 s and 65 s, as with a bad "
        "connection.",),
        track(results, "paper_outliers", "data loss", ("Fig. 3", "Fig. 4"),
              "LS. Each loss throws b₁ off by up to {0:.1f} 1/s and b₀ by up to {1:.1f} 1/s², and it takes seconds "
              "to recover.",
              "LA. The same two losses, hardly to be seen: b₁ stays within {0:.2f} 1/s and b₀ within {1:.2f} 1/s² "
              "of the truth, while both follow the failing damper."))


def end_stops(results):
    return Section("End stops", (
        "Two bumps, at 85 s and 110 s, push the strut into its end stops. For a moment it is much stiffer than the "
        "model allows.",),
        track(results, "paper_saturation", "bump", ("Fig. 5", "Fig. 6"),
              "LS. After each bump b₀ is off by up to {1:.0f} 1/s², several times its value of 13.8, and b₁ by up to "
              "{0:.1f} 1/s. A monitor that trusts it would report a broken spring.",
              "LA. The bumps pass almost unnoticed: b₁ stays within {0:.2f} 1/s, b₀ within {1:.2f} 1/s²."))


def no_fault(results):
    recording, experiment, found = results.drive("paper_clean")
    clean, saturation = results.recordings["paper_clean"], results.recordings["paper_saturation"]
    return Section("No fault, and the road", figures=(
        Figure(figures.tracking(recording, experiment, ESTIMATORS), "LS and LA without a fault.",
               f"Both follow the failing damper: LS runs {ramp_lag(recording, 'ls'):.1f} s behind, LA "
               f"{ramp_lag(recording, 'la'):.1f} s, but LA is the calmer. The rms errors of b₁ are "
               f"{found['ls'].rms[0]:.3f} (LS) and {found['la'].rms[0]:.3f} 1/s (LA)."),
        Figure(figures.road(clean, saturation), "Fig. 7",
               "The road μ(t) under the wheel, the sum of four cosines of 1 to 4 cm, and the 15 cm bump δ(t) that is "
               "added to it at 85 s in the end-stop drive.")))


def health_changes(results):
    """When the level changed and the reason that /diagnostics showed."""
    rows = []
    for experiment in results.experiments:
        health = results.recordings[experiment.scenario].health
        for start, end, level in figures.level_spans(health):
            reason = health.reason[health.time.searchsorted(start)]
            rows.append((experiment.title, f"{start:.1f}", (level.upper(), level), reason))
    return Table("Changes of the level, with the reason as /diagnostics shows it",
                 [Column("drive", css="text"), Column("from", "s"), Column("level", css="text"),
                  Column("reason", css="text wide")], rows)


NEVER = "no time"


def first_alarm(health):
    """When the level first was WARN or ERROR, in words."""
    return next((f"{start:.0f} s" for start, _, level in figures.level_spans(health) if level in ("warn", "error")),
                NEVER)


def worst_level(recordings):
    levels = {level for recording in recordings for _, _, level in figures.level_spans(recording.health)}
    return next(level for level in ("error", "warn", "ok", "stale") if level in levels)


def verdict(results):
    """How it all ended, first of all: the levels over time, and where the search for an effect is."""
    recordings = [results.recordings[experiment.scenario] for experiment in results.experiments]
    titles = [experiment.title for experiment in results.experiments]
    alarms = [f"{first_alarm(recording.health)} ({title})" for recording, title in zip(recordings, titles)]
    truth = recordings[0].truth
    lost = truth.time[numpy.argmax(truth.damping_to_mass <= (1 - results.settings.warn) * truth.damping_to_mass[0])]
    found = (hidden_effect.pointer(results.search),) if results.search else ()
    return Section("The failing damper is told in every drive"
                   if all(first_alarm(recording.health) != NEVER for recording in recordings)
                   else "The failing damper is not told in every drive", (
        f"A damper loses a third of its damping from 40 s to 100 s, {100 * results.settings.warn:.0f} % of it by "
        f"{lost:.0f} s. The first WARN or ERROR comes at {', '.join(alarms)}. Where the readings make no sense the level "
        "is STALE (?), “cannot tell”, instead of a false alarm.", *found),
        (Figure(figures.health(recordings, titles), "Levels.", "What <code>/monitor/health</code> and "
                "<code>/diagnostics</code> say in the three drives, and the damping that the robust estimate sees: "
                f"WARN from {100 * results.settings.warn:.0f} %, ERROR from {100 * results.settings.error:.0f} % change."),),
        level=worst_level(recordings).upper())


def health(results):
    return Section("What the robot is told", (
        "Every change of the level over time above, with its reason.",), tables=(health_changes(results),))


def prediction(results):
    clean, clean_experiment, _ = results.drive("paper_clean")
    rmse = figures.excerpt(clean.comparison, *EXCERPT)[1]
    stops, stops_experiment, _ = results.drive("paper_saturation")
    return Section("Model against measurement", (
        "The model, driven by the measured wheel acceleration alone, predicts what the body IMU should read (a free "
        "run: it never sees that reading). What it cannot explain is the residual. Readings include gravity.",),
        (Figure(figures.prediction(clean, clean_experiment, *EXCERPT), "No fault.",
                f"Prediction and measurement lie on each other: the rmse is {rmse / results.settings.noise:.1f} times "
                f"the noise of one sensor, {results.settings.noise:g} m/s²."),
         Figure(figures.prediction(stops, stops_experiment, 82.0, 88.0), "End stops.",
                "At the bump the body is hit much harder than a strut without stops could: the residual shows when "
                "the model lacks an effect, and its size how much.")))


def report_sections(results):
    """All sections, in the order of the page."""
    sections = [section(results)
                for section in (verdict, introduction, errors, data_loss, end_stops, no_fault, health, prediction)]
    sections += [hidden_effect.section(results.search)] if results.search else []
    return sections + ([fleet.section(results.robots)] if results.robots else [])
