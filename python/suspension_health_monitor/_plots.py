"""plot() of the results; matplotlib is loaded by the first call."""
from . import _core


def _axes(axes, count, **keywords):
    """Axes one above the other: those given, or those of a new figure."""
    if axes is None:
        from matplotlib import pyplot
        figure, axes = pyplot.subplots(count, squeeze=False, figsize=(9, 2.6 * count), constrained_layout=True, **keywords)
        return figure, list(axes[:, 0])
    axes = [axes] if count == 1 and not hasattr(axes, "__len__") else list(axes)
    if len(axes) != count:
        raise ValueError(f"{len(axes)} axes, must be {count}")
    return axes[0].figure, axes


def _estimates(axes, course, values):
    for axis, name, title in zip(axes, ("damping_to_mass", "stiffness_to_mass"),
                                 ("damping/mass [1/s]", "stiffness/mass [1/s²]")):
        middle, spread = getattr(course, name), 1.96 * getattr(course, f"{name}_stddev")
        valid = course.valid
        axis.fill_between(course.time, middle - spread, middle + spread, where=valid, alpha=0.25, linewidth=0)
        axis.plot(course.time, middle, linewidth=0.6, color="0.6")
        axis.plot(course.time, [m if v else float("nan") for m, v in zip(middle, valid)], label="estimate")
        for estimator in ("la", "ls"):
            axis.plot(course.time, getattr(course, f"{estimator}_{name}"), linewidth=0.6, label=estimator)
        for label, value in values(name):
            axis.axhline(value, linestyle="--", color="k", linewidth=0.8, label=label)
        shown = [*middle[valid], *(value for _, value in values(name))]  # not what an estimate is while it settles
        if shown:
            margin = 0.25 * max(max(shown) - min(shown), 0.2 * abs(shown[0]))
            axis.set_ylim(min(shown) - margin, max(shown) + margin)
        axis.set_ylabel(title)
        axis.legend(loc="best", fontsize="small")


def _plot_identification(self, axes=None):
    """Damping and stiffness over time with their 95 % band; returns the figure. axes: two, to draw into."""
    figure, axes = _axes(axes, 2, sharex=True)
    _estimates(axes, self.course,
               lambda name: [("whole drive", getattr(self.estimate, name))] if self.estimate.valid else [])
    axes[-1].set_xlabel("time [s]")
    return figure


def _plot_health(self, axes=None):
    """Level, damping and stiffness over time; returns the figure. axes: three, to draw into."""
    figure, axes = _axes(axes, 3, sharex=True)
    levels = ["STALE", "OK", "WARN", "ERROR"]  # what nobody can tell is no worse than an error
    moments = [*self.events, self.end]
    axes[0].step([each.time for each in moments], [levels.index(each.level) for each in moments], where="post", color="k")
    axes[0].set_ylim(-0.5, 3.5)
    axes[0].set_yticks(range(4))
    axes[0].set_yticklabels(levels)
    healthy = self.baseline

    def values(name):
        return [] if getattr(healthy, name) is None else [("healthy", getattr(healthy, name))]

    _estimates(axes[1:], self.course, values)
    axes[-1].set_xlabel("time [s]")
    return figure


def _plot_comparison(self, axes=None):
    """Measured beside predicted over the worst ten seconds, and the missing force over travel and rate.

    Returns the figure. axes: three, to draw into.
    """
    figure, axes = _axes(axes, 3)
    segment = max(self.segments, key=lambda each: len(each.measured))
    first, last = _worst_stretch(segment)
    time = segment.time[first:last]
    axes[0].plot(time, segment.measured[first:last], label="measured", color="k", linewidth=0.8)
    axes[0].plot(time, segment.predicted[first:last], label="model", color="tab:orange", linewidth=0.8)
    axes[0].set(xlabel="time [s]", ylabel="body [m/s²]")
    axes[0].legend(loc="best", fontsize="small")
    for axis, view, label, scale in ((axes[1], self.views.travel, "travel [mm]", 1e3),
                                     (axes[2], self.views.travel_rate, "travel rate [m/s]", 1.0)):
        middle = 0.5 * scale * (view.from_ + view.to)
        axis.errorbar(middle, view.mean, 3 * view.standard_error, fmt=".-", linewidth=0.8)
        axis.axhline(0, color="0.6", linewidth=0.8)
        axis.set(xlabel=label, ylabel="missing force\n[m/s²]")
    return figure


def _worst_stretch(segment, seconds=10.0):
    import numpy as np
    length = min(len(segment.measured), max(2, int(seconds / segment.period)))
    error = np.concatenate([[0.0], np.cumsum((segment.measured - segment.predicted) ** 2)])
    first = int((error[length:] - error[:-length]).argmax())
    return first, first + length


def _plot_diagnosis(self, axes=None):
    """Held-out error of the model with each candidate alone; returns the figure. axes: one, to draw into."""
    figure, (axis,) = _axes(axes, 1)
    best = [each for each in self.ranking if not each.failure][:8]
    names = ["as it is", *(" + ".join(each.effects) for each in best)]
    errors = [self.base.held_out_rmse, *(each.held_out_rmse for each in best)]
    if self.extended is not None and len(self.selected) > 1:
        names.append("with " + " and ".join(self.selected))
        errors.append(self.extended.held_out_rmse)
    chosen = {*self.selected, names[-1]} if len(self.selected) > 1 else set(self.selected)
    axis.barh(names, errors, color=["tab:green" if name in chosen else "0.7" for name in names])
    axis.axvline(self.noise_floor, color="k", linestyle="--", linewidth=0.8)
    axis.invert_yaxis()
    axis.set(xlabel="held-out rmse [m/s²]; dashed: noise floor, about", title=self.summary)
    return figure


def _plot_curves(self, axes=None):
    """Forces of damper and spring, rebound to the left, with their 90 % bands; returns the figure.

    axes: two, to draw into.
    """
    figure, axes = _axes(axes, 2)
    for axis, curve, variable, label in ((axes[0], self.damper_curve, "velocity", "travel rate [m/s]"),
                                         (axes[1], self.spring_curve, "travel", "travel [m]")):
        middle, spread = curve["force"], 1.645 * curve["stddev"]
        axis.fill_between(curve[variable], middle - spread, middle + spread, alpha=0.25, linewidth=0)
        axis.plot(curve[variable], middle)
        axis.set(xlabel=label, ylabel="force/mass [m/s²]")
    return figure


def _plot_simulation(self, axes=None):
    """Readings and travel over time; returns the figure. axes: two, to draw into."""
    figure, axes = _axes(axes, 2, sharex=True)
    axes[0].plot(self.stamps_wheel, self.wheel, linewidth=0.5, label="wheel")
    axes[0].plot(self.stamps_body, self.body, linewidth=0.5, label="body")
    axes[0].set_ylabel("reading [m/s²]")
    axes[0].legend(loc="best", fontsize="small")
    axes[1].plot(self.time, 1e3 * self.travel, linewidth=0.5)
    axes[1].set(xlabel="time [s]", ylabel="travel [mm]")
    return figure


def install():
    """Gives the compiled classes their plot()."""
    for cls, plot in ((_core.Identification, _plot_identification), (_core.Health, _plot_health),
                      (_core.Comparison, _plot_comparison), (_core.Diagnosis, _plot_diagnosis),
                      (_core.Simulation, _plot_simulation)):
        cls.plot = plot
    _core.Diagnosis.plot_curves = _plot_curves
