"""Options by name, and what needs the package's own files: they are read by the part that was built with ROS."""
import importlib
import os

from . import _core


def files():
    """The compiled part that reads bags and YAML files."""
    try:
        return importlib.import_module("._bags", __package__)
    except ImportError as error:
        raise ValueError("bags and YAML files are read by the module that is built with ROS; this one was built without"
                         f" (pip install), or ROS is not there: {error}") from error


def flattened(settings, group=""):
    """What a dict names, as an option file has it: names of groups with / before those in them; None is left out."""
    flat = {}
    for key, value in settings.items():
        name = f"{group}{key}"
        if value is None:
            continue
        inner = flattened(value, name + "/") if isinstance(value, dict) else {name: _plain(name, value)}
        for each, its in inner.items():
            if each in flat:
                raise ValueError(f"{each} is given twice, must be given once")
            flat[each] = its
    return flat


def _plain(name, value):
    """A value that an option may have: of a number of NumPy the number, of a list of texts one text with commas."""
    if getattr(value, "ndim", None) == 0 and hasattr(value, "item"):
        value = value.item()
    if isinstance(value, int) and abs(value) >= 2**31:
        return float(value)
    if isinstance(value, (bool, int, float, str)):
        return value
    if hasattr(value, "__fspath__"):
        return os.fspath(value)
    if not isinstance(value, (list, tuple)):
        raise ValueError(f"{name} = {value!r}, must be true or false, a number or a text")
    if not value:
        raise ValueError(f"{name} = [], must be a value or left out")
    return ", ".join(value) if all(isinstance(each, str) for each in value) else _core.UnusableList(repr(value))


def array_keywords(options, config, arguments):
    """The options of a monitor of arrays, over those of a file, which may have those of messages, too."""
    keywords = _core.monitor_keywords(flattened(options), arguments)
    if config is None:
        return keywords
    settings = files().read_settings(os.fspath(config))
    return {**_core.without_messages(_core.monitor_keywords(settings, [])), **keywords}


def assignments(keywords):
    """NAME=VALUE each, as --set takes them."""
    def text(value):
        if isinstance(value, bool):
            return str(value).lower()
        return f"{value:.17g}" if isinstance(value, float) else str(value)
    return [f"{name}={text(value)}" for name, value in keywords.items()]


def simulator_keywords(options, of_vehicle):
    config = options.pop("config", None)
    settings = {} if config is None else files().read_settings(os.fspath(config))
    if of_vehicle:  # who makes the vehicle knows its options
        return {**settings, **flattened(options)}
    arguments = ["output", "effect", "effects_file", "progress", "config"]
    keywords = _core.simulator_keywords(flattened(options), arguments)
    return {**_core.simulator_keywords(settings, []), **keywords}
