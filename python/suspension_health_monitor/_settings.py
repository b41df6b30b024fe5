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
                         f" (cmake -S src/core), or ROS is not there: {error}") from error


def array_keywords(options, config, arguments):
    """The options of a monitor of arrays, over those of a file, which may have those of messages, too."""
    keywords = _core.monitor_keywords(options, arguments)
    if config is None:
        return keywords
    settings = files().read_settings(os.fspath(config))
    return keywords.with_defaults(_core.monitor_keywords(settings, []).without_messages())


def simulator_keywords(options, of_vehicle):
    config = options.pop("config", None)
    arguments = ["output", "effect", "effects_file", "progress", "config"]
    keywords = _core.simulator_keywords(options, of_vehicle, arguments)
    if config is None:
        return keywords
    return keywords.with_defaults(_core.simulator_keywords(files().read_settings(os.fspath(config)), of_vehicle, []))
