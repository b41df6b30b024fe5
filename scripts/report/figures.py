"""The figures of the report, each a function of recordings that gives an <svg> element."""
import numpy

from .accuracy import ESTIMATORS, SETTLED
from .drawing import COLOURS, finish, name_panel, new_figure
from .experiments import DURATION

LIMITS = {"damping_to_mass": (0.8, 5.2), "stiffness_to_mass": (7.5, 20.5)}  # the same in all, to compare by eye
LABELS = {"damping_to_mass": "b₁ = damping/mass [1/s]", "stiffness_to_mass": "b₀ = stiffness/mass [1/s²]"}
LEVELS = ("ok", "warn", "error", "stale")  # as in SuspensionHealth
SAME_EXCURSION = 5.0  # [s] peaks closer than this are one


def excursions(rows, parameter, limits):
    """[(time, value)] of the farthest point of each excursion out of the limits after settling."""
    value = rows[parameter]
    outside = numpy.flatnonzero((rows.time > SETTLED) & ((value < limits[0]) | (value > limits[1])))
    groups = numpy.split(outside, numpy.flatnonzero(numpy.diff(rows.time[outside]) > SAME_EXCURSION) + 1)
    middle = sum(limits) / 2
    peaks = [group[numpy.argmax(numpy.abs(value[group] - middle))] for group in groups if len(group)]
    return [(rows.time[peak], value[peak]) for peak in peaks]


def note_excursions(axis, rows, parameter, colour):
    """Tells in words how far a curve goes beyond the panel."""
    low, high = LIMITS[parameter]
    for time, value in excursions(rows, parameter, (low, high)):
        above = value > high
        late = time > 0.5 * DURATION
        axis.annotate(f"{'↑' if above else '↓'} to {value:.3g}", (time, high if above else low),
                      xytext=(-5 if late else 5, -3 if above else 3), textcoords="offset points", color=colour,
                      ha="right" if late else "left", va="top" if above else "bottom", fontsize=10)


def mark_faults(axis, faults, label):
    for number, (start, end) in enumerate(faults):
        axis.axvspan(start, end, color=COLOURS["fault"], alpha=0.3, linewidth=0)
        for edge in {start, end}:
            axis.axvline(edge, color=COLOURS["fault"], linewidth=1.1, linestyle=(0, (1.5, 1.5)),
                         label=label if number == 0 and edge == start else None)


def tracking(recording, experiment, estimators, fault_label=None):
    """Figs. 3 to 6: both parameters over time, estimated and true."""
    figure, axes = new_figure(2, 4.6)
    for axis, parameter in zip(axes, LABELS):
        mark_faults(axis, experiment.faults, fault_label)
        for estimator in estimators:
            rows = getattr(recording, estimator)
            axis.plot(rows.time, rows[parameter], color=COLOURS[estimator], label=ESTIMATORS[estimator])
            note_excursions(axis, rows, parameter, COLOURS[estimator])
        axis.plot(recording.truth.time, recording.truth[parameter], color=COLOURS["truth"], linestyle=(0, (5, 2)),
                  linewidth=1.3, label="truth")
        axis.set(ylim=LIMITS[parameter], xlim=(0, DURATION))
        name_panel(axis, LABELS[parameter])
    names = " and ".join(ESTIMATORS[estimator] for estimator in estimators)
    return finish(figure, axes, f"{names} estimates and truth of b1 and b0 over time, {experiment.title}", 4)


def road(without_bumps, with_bumps, start=80.0, end=86.0):
    """Fig. 7: the paper's road, and its bumps as the difference of two recordings."""
    figure, (axis,) = new_figure(1, 3.0)
    rows = without_bumps.truth
    height = 100 * rows.road
    bumps = 100 * numpy.interp(rows.time, with_bumps.truth.time, with_bumps.truth.road) - height
    axis.plot(rows.time, height, color=COLOURS["la"], label="road μ(t)")
    axis.plot(rows.time, bumps, color=COLOURS["ls"], linestyle=(0, (4, 1.5)), label="bump δ(t)")
    axis.set(xlim=(start, end), ylim=(-1, 21))
    name_panel(axis, "height [cm]")
    return finish(figure, [axis], "Road height and bump over time, 80 to 86 s")


def level_spans(health):
    """[(start, end, level)] of equal health [s]."""
    changes = numpy.flatnonzero(numpy.diff(health.level)) + 1
    starts = numpy.concatenate(([0], changes))
    ends = numpy.concatenate((changes, [len(health) - 1]))
    return [(health.time[start], health.time[end], LEVELS[health.level[start]]) for start, end in zip(starts, ends)]


def health(recordings, titles):
    """The loss of damping that the monitor sees, and the level that it reports, in each drive."""
    figure, axes = new_figure(1 + len(recordings), 2.2 + 0.45 * len(recordings),
                              gridspec_kw={"height_ratios": [0.9] * len(recordings) + [3.5]})
    first, course = recordings[0], axes[-1]
    course.plot(first.health.time, 100 * first.health.damping_change, color=COLOURS["la"])
    nominal = first.health.nominal_damping_to_mass[-1]
    course.plot(first.truth.time, 100 * (first.truth.damping_to_mass / nominal - 1), color=COLOURS["truth"],
                linestyle=(0, (5, 2)), linewidth=1.3)
    course.set(ylim=(-42, 12), xlim=(0, DURATION))
    name_panel(course, "damping against nominal [%], no fault; dashed: truth")
    for axis, recording, title in zip(axes, recordings, titles):
        axis.set(ylim=(0, 1), yticks=[])
        axis.grid(False)
        axis.set_ylabel(title.replace(" ", "\n"), rotation=0, ha="right", va="center")
        for start, end, level in level_spans(recording.health):
            axis.axvspan(start, end, color=COLOURS[level], linewidth=0)
            if end - start > 9:
                axis.text((start + end) / 2, 0.46, level.upper(), ha="center", va="center", color=COLOURS["ink"])
            elif level == "stale":
                axis.text((start + end) / 2, 0.46, "?", ha="center", va="center", color=COLOURS["ink"])
    return finish(figure, axes, "The health level in each drive over time, and the loss of damping")


def excerpt(rows, start, end):
    """(rows, rmse [m/s^2], fit [%]) of the comparison in start..end [s]."""
    rows = rows[(rows.time >= start) & (rows.time <= end)]
    residual = rows.measured - rows.predicted
    fit = 100 * (1 - numpy.linalg.norm(residual) / numpy.linalg.norm(rows.measured - numpy.mean(rows.measured)))
    return rows, float(numpy.sqrt(numpy.mean(residual**2))), float(fit)


def prediction(recording, experiment, start, end):
    """Measured body acceleration against the free run, and what is left."""
    figure, axes = new_figure(2, 4.0, gridspec_kw={"height_ratios": [2, 1]})
    rows, rmse, fit = excerpt(recording.comparison, start, end)
    axes[0].plot(rows.time, rows.measured, color=COLOURS["truth"], linewidth=1.1, label="measured")
    axes[0].plot(rows.time, rows.predicted, color=COLOURS["la"], linestyle=(0, (4, 1.5)), label="predicted")
    axes[0].set(xlim=(start, end))
    name_panel(axes[0], "acceleration of the body [m/s²]")
    axes[0].set_title(f"rmse {rmse:.3g} m/s², fit {fit:.0f} %", loc="right", fontsize=10.5)
    axes[1].plot(rows.time, rows.measured - rows.predicted, color=COLOURS["muted"], linewidth=1.1)
    name_panel(axes[1], "residual: measured − predicted [m/s²]")
    for axis in axes:
        mark_faults(axis, [fault for fault in experiment.faults if start <= fault[0] <= end], None)
    return finish(figure, axes, f"Measured and predicted acceleration, {experiment.title}, {start:g} to {end:g} s")
