"""Models, laws and healthy struts: as objects, as dicts, or in files."""
import contextlib
import os
import tempfile
from typing import Any

from . import _core
from ._plain import Restored
from ._recording import is_path
from ._settings import files, flattened


def library(effects_file: Any = None) -> _core.EffectLibrary:
    """The catalogue, and the laws of a file."""
    return _core.EffectLibrary() if effects_file is None else files().read_effects(os.fspath(effects_file))


def to_model(model: Any, effects_file: Any = None) -> Any:
    """A StrutModel of one, a dict of settings or a file; None: of None."""
    known = library(effects_file)
    if is_path(model):
        return files().read_model(os.fspath(model), known)
    if isinstance(model, Restored):
        model = model.settings
    if model is None or isinstance(model, _core.StrutModel):
        return model
    if not isinstance(model, dict):
        raise ValueError(f"model = {model!r}, must be a StrutModel, a dict of settings or the path of a model file")
    return _core.to_model(flattened(model), known)


def healthy_strut(baseline: Any) -> Any:
    """A Baseline, and the file that it was read from; None and no file: of None."""
    if baseline is None or isinstance(baseline, _core.Baseline):
        return baseline, ""
    if not is_path(baseline):
        raise ValueError(f"baseline = {baseline!r}, must be a Baseline or the path of a file with one")
    file = os.fspath(baseline)
    return files().read_baseline(file), file


@contextlib.contextmanager
def model_file(model, effects_file):
    """The path of a file with the model, as the code of the command line reads it, or None; a path is one already."""
    if model is None or is_path(model):
        yield None if model is None else os.fspath(model)
        return
    with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
        file.write(to_model(model, effects_file).yaml())
        file.flush()
        yield file.name
