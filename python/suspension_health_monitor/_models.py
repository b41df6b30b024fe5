"""Models, laws and healthy struts: as objects, as dicts, or in files."""
import contextlib
import os
import tempfile
from typing import Any

from . import _core
from ._recording import is_path
from ._settings import files


def library(effects_file: Any = None) -> _core.EffectLibrary:
    """The catalogue, and the laws of a file."""
    return _core.EffectLibrary() if effects_file is None else files().read_effects(os.fspath(effects_file))


def to_model(model: Any, effects_file: Any = None) -> Any:
    """A StrutModel of one, a dict of settings or a file; None: of None."""
    known = library(effects_file)
    return files().read_model(os.fspath(model), known) if is_path(model) else _core.to_model(model, known)


def to_baseline(baseline: Any) -> Any:
    """A Baseline of one or of a file; None: of None."""
    return files().read_baseline(os.fspath(baseline)) if is_path(baseline) else baseline


@contextlib.contextmanager
def _written(value, text):
    """The path of a file that holds a value, or None; a path is one already."""
    if value is None or is_path(value):
        yield None if value is None else os.fspath(value)
        return
    with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
        file.write(text(value))
        file.flush()
        yield file.name


def model_file(model, effects_file):
    """A model as the code of the command line reads it."""
    return _written(model, lambda value: to_model(value, effects_file).yaml())


def baseline_file(baseline):
    """A healthy strut, likewise."""
    def text(value):
        names = ("damping_to_mass", "stiffness_to_mass", "damping_to_mass_stddev", "stiffness_to_mass_stddev")
        values = {name: getattr(value, name) for name in names}
        return "".join(f"{name}: {each!r}\n" for name, each in values.items() if each is not None)
    return _written(baseline, text)
