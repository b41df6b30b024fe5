"""What results look like: a line in a terminal, a table in a notebook."""
import html
import math

from . import _core

_COLOURS = {"OK": "#2e7d32", "WARN": "#b26a00", "ERROR": "#c62828", "STALE": "#616161"}


class EffectList(list):
    """Effects, shown as a table in a notebook."""

    def _repr_html_(self):
        return _table(("name", "law", "coefficients", "shapes", "what a workshop would find"), [
            (each.name, each.law, _units(each.coefficients), _units(each.shapes), each.finding) for each in self])


def _units(numbers):
    return ", ".join(f"{name} [{unit}]" for name, unit in numbers)


def _number(value, digits=4):
    return "-" if value is None or math.isnan(value) else f"{value:.{digits}g}"


def _plus_minus(value, stddev):
    return f"{_number(value)} ± {_number(stddev, 2)}"


def _table(head, rows, caption=""):
    cells = "".join(f"<th style='text-align:left'>{html.escape(each)}</th>" for each in head)
    body = "".join("<tr>" + "".join(f"<td style='text-align:left'>{_escaped(each)}</td>" for each in row) + "</tr>"
                   for row in rows)
    title = f"<caption style='text-align:left'>{_escaped(caption)}</caption>" if caption else ""
    return f"<table>{title}<thead><tr>{cells}</tr></thead><tbody>{body}</tbody></table>"


class _Markup(str):
    """Text that is HTML already."""


def _escaped(text):
    return text if isinstance(text, _Markup) else html.escape(str(text))


def _level(level):
    return _Markup(f"<b style='color:{_COLOURS[level]}'>{level}</b>")


def _paragraphs(*texts):
    return "".join(f"<p>{_escaped(text)}</p>" for text in texts if text)


# Estimates ---------------------------------------------------------------------------------------------------------

def _estimate(self):
    doubt = "" if self.valid else f", not valid: {self.reason}"
    return f"b1 {_plus_minus(self.damping_to_mass, self.damping_to_mass_stddev)} 1/s, " \
           f"b0 {_plus_minus(self.stiffness_to_mass, self.stiffness_to_mass_stddev)} 1/s^2{doubt}"


_ESTIMATE_HEAD = ("", "damping/mass b1 [1/s]", "stiffness/mass b0 [1/s²]", "natural frequency [Hz]", "damping ratio",
                  "valid")


def _estimate_row(name, estimate):
    return (name, _plus_minus(estimate.damping_to_mass, estimate.damping_to_mass_stddev),
            _plus_minus(estimate.stiffness_to_mass, estimate.stiffness_to_mass_stddev),
            _number(estimate.natural_frequency), _number(estimate.damping_ratio),
            "yes" if estimate.valid else f"no: {estimate.reason}")


def _identification(self):
    return f"<Identification: {_estimate(self.estimate)}; {self.rows} rows, T {self.sample_period:.6g} s, " \
           f"horizon {self.horizon_samples} samples>"


def _identification_html(self):
    rows = [_estimate_row(name, getattr(self, name)) for name in ("estimate", "la", "ls")]
    caption = f"{self.samples} samples of {self.sample_period:.6g} s, horizon {self.horizon_samples} samples, " \
              f"{self.gaps} gaps, {sum(self.rejected.values())} readings kept out"
    return _table(_ESTIMATE_HEAD, rows, caption) + _paragraphs(self.change, *self.warnings)


# Health ------------------------------------------------------------------------------------------------------------

def _health(self):
    return f"<Health: at the end {self.end.level}, {self.end.message}; judged by {self.reference}>"


def _health_html(self):
    events = [(f"{event.time:.2f}", _level(event.level), event.message) for event in self.events]
    ends = [_estimate_row(name, getattr(self, name)) for name in ("estimate", "la", "ls")]
    end = _Markup(f"At the end {_level(self.end.level)}: {html.escape(self.end.message)}")
    return _paragraphs(end, f"Judged by {self.reference}.") + _table(("time [s]", "level", "reason"), events) \
        + _table(_ESTIMATE_HEAD, ends)


# Models ------------------------------------------------------------------------------------------------------------

def _model(self):
    return f"<StrutModel: {', '.join(f'{each.name} {_number(each.value)} {each.unit}' for each in self.numbers)}>"


def _model_table(model, stddev=()):
    spread = [_number(each, 2) for each in stddev] + [""] * (len(model.numbers) - len(stddev))
    return _table(("number", "value", "±", "unit"), [
        (each.name, _number(each.value, 5), each_spread, each.unit) for each, each_spread in zip(model.numbers, spread)])


def _comparison(self):
    return f"<Comparison: rmse {_number(self.free_run.rmse)} m/s^2, fit {_number(self.free_run.fit_percent)} %, " \
           f"{100 * self.structured_share:.0f} % of the error is not noise>"


def _comparison_html(self):
    rows = [("free run, from the wheel alone", _number(self.free_run.rmse), _number(self.free_run.fit_percent)),
            ("the same on blocks held out", _number(self.held_out_rmse), "")]
    if self.one_step is not None:
        rows.append(("one step", _number(self.one_step.rmse), _number(self.one_step.fit_percent)))
    rows.append(("noise floor, about", _number(self.noise_floor), ""))
    failures = "".join(f"<li>{html.escape(region.sentence)}</li>" for region in self.where)
    return _table(("error", "rmse [m/s²]", "fit [%]"), rows) + f"<p>Where it fails, worst first:</p><ol>{failures}</ol>" \
        + _model_table(self.model, self.stddev)


def _diagnosis(self):
    return f"<Diagnosis: {self.verdict}, {self.summary}>"


def _diagnosis_html(self):
    groups = [f"These drives cannot tell apart: {', '.join(group)}." for group in self.indistinguishable]
    rows = [(" + ".join(each.effects), "-", "-", f"no: {each.failure}") if each.failure else
            (" + ".join(each.effects), _number(each.held_out_rmse), f"{each.error_removed_percent:.1f}",
             "yes" if each.significant else "no") for each in self.ranking[:8]]
    rows.insert(0, ("the model as it is", _number(self.base.held_out_rmse), "", ""))
    stddev = self.final_fit.stddev if self.final_fit is not None else ()
    return _paragraphs(_Markup(f"<b>{html.escape(self.summary)}</b>"), self.remainder, self.change, *groups,
                       self.suggested_drive) \
        + _table(("added alone", "held-out rmse [m/s²]", "error removed [%]", "significant"), rows) \
        + _model_table(self.model, stddev)


def _simulation(self):
    return f"<Simulation: {len(self.body)} readings of the body, {len(self.wheel)} of the wheel, {self.time[-1]:.6g} s>"


def _simulation_html(self):
    sensors = [("body", self.body), ("wheel carrier", self.wheel), *([("road", self.road)] if len(self.road) else [])]
    return _table(("sensor", "readings", "mean [m/s²]", "standard deviation [m/s²]"), [
        (name, len(readings), _number(readings.mean()), _number(readings.std())) for name, readings in sensors],
        f"{self.time[-1]:.6g} s, simulated; plot() draws them")


def install():
    """Gives the compiled classes their looks."""
    for cls, in_line, in_notebook in (
            (_core.Identification, _identification, _identification_html), (_core.Health, _health, _health_html),
            (_core.Comparison, _comparison, _comparison_html), (_core.Diagnosis, _diagnosis, _diagnosis_html),
            (_core.StrutModel, _model, _model_table), (_core.Simulation, _simulation, _simulation_html)):
        cls.__repr__, cls._repr_html_ = in_line, in_notebook
    _core.StrutEstimate.__repr__ = lambda self: f"<{type(self).__name__}: {_estimate(self)}>"
    _core.PredictionError.__repr__ = \
        lambda self: f"<rmse {_number(self.rmse)} m/s^2, fit {_number(self.fit_percent)} %>"
    _core.Effect.__repr__ = lambda self: f"<Effect {self.name}: {self.law}>"
    _core.HealthMoment.__repr__ = lambda self: f"<{self.time:.2f} s {self.level}: {self.message}>"
    _core.FailureRegion.__repr__ = lambda self: f"<{self.sentence}>"
    _core.HealthReport.__repr__ = lambda self: f"<{self.level}: {self.message}>"
    _core.MonitorReport.__repr__ = lambda self: f"<MonitorReport: {self.health!r}, {_estimate(self.estimate)}>"
    _core.Baseline.__repr__ = lambda self: f"<Baseline: b1 {self.damping_to_mass}, b0 {self.stiffness_to_mass}>"
    _core.RankedModel.__repr__ = lambda self: f"<{' + '.join(self.effects)}: {_number(self.held_out_rmse)} m/s^2>"
