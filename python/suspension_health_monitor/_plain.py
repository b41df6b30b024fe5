"""Results as plain values: to keep, and to send to another process, which the compiled classes themselves cannot be."""
import functools
import types
from typing import Any

from . import _core

_NO_RESULTS = (_core.UnusableList, _core.Readings, _core.EffectLibrary, _core.StrutMonitor, _core.VehicleMonitor)
_RESULTS = {name: each for name, each in vars(_core).items() if isinstance(each, type) and each not in _NO_RESULTS}


def _reduce(self):
    return _restored, (type(self).__name__, _attributes(self))


class Restored:
    """A result that was sent or kept by pickle: the same attributes, shown and drawn alike."""

    __reduce__ = _reduce


def to_dict(result: Any) -> Any:
    """A result as plain values: dicts by attribute, lists, numbers, texts, None and NumPy arrays.

    :param result: of any function or monitor of this module, a part of it, or a list or dict of such.
    """
    if isinstance(result, (Restored, *_RESULTS.values())):
        return {name: to_dict(value) for name, value in _attributes(result).items() if not name.startswith("_")}
    if isinstance(result, dict):
        return {name: to_dict(value) for name, value in result.items()}
    if isinstance(result, (list, tuple)):
        return [to_dict(value) for value in result]
    return result


def _attributes(result):
    if isinstance(result, Restored):
        return vars(result)
    attributes = {name: getattr(result, name) for name, each in vars(type(result)).items() if isinstance(each, property)}
    return {**attributes, "_yaml": result.yaml()} if isinstance(result, _core.StrutModel) else attributes


def _restored(name, attributes):
    result = _restored_class(name)()
    vars(result).update(attributes)
    return result


@functools.lru_cache(maxsize=None)
def _restored_class(name):
    cls = _RESULTS[name]
    methods = {method: each for method, each in vars(cls).items() if isinstance(each, types.FunctionType)}
    if hasattr(cls, "__len__"):
        methods["__len__"] = lambda self: len(self.count)
    if hasattr(cls, "yaml"):
        methods["yaml"] = lambda self: self._yaml
    return type(name, (Restored,), methods)


def install():
    """Lets the compiled classes be sent. What they have been given to show and draw themselves goes with them."""
    for cls in _RESULTS.values():
        if cls is not _core.Baseline:  # which is sent as what it is
            cls.__reduce__ = _reduce
