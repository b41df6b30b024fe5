"""The layouts for rqt, PlotJuggler and Foxglove: well-formed, and every topic and field that they show exists."""
import ast
import collections
import json
import pathlib
import re
import xml.etree.ElementTree as ElementTree

import pytest

from terminal import Terminal

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
CONFIG = REPOSITORY / "config"
PERSPECTIVE = json.loads((CONFIG / "rqt_suspension.perspective").read_text())
LAYOUT = ElementTree.parse(CONFIG / "plotjuggler_layout.xml").getroot()
FOXGLOVE = json.loads((CONFIG / "foxglove_layout.json").read_text())
WIDGETS = {"rqt_plot/Plot": "DataPlotWidget", "rqt_runtime_monitor/RuntimeMonitor": "RuntimeMonitorWidget",
           "rqt_reconfigure/Param": "_plugincontainer_top_widget"}  # as the plugins name them
NUMBERS = r"(?:float64|byte|bool|uint8)"


def topics_of_the_monitor():
    """Message type by name of the topic, as the nodelet has them advertised."""
    source = (REPOSITORY / "src" / "ros" / "live_strut.cpp").read_text()
    return {topic: message for message, topic in re.findall(r'advertise<(\w+)>\("(\w+)"', source)}


def numeric_fields(message):
    lines = (REPOSITORY / "msg" / f"{message}.msg").read_text().splitlines()
    return {match[1] for match in (re.match(rf"{NUMBERS}\s+(\w+)\s*(?:#.*)?$", line) for line in lines) if match}


def plugins():
    return ast.literal_eval(PERSPECTIVE["groups"]["pluginmanager"]["keys"]["running-plugins"]["repr"])


def settings_of(plugin, number):
    name = f"plugin__{plugin.replace('/', '__')}__{number}"
    return PERSPECTIVE["groups"]["pluginmanager"]["groups"][name]["groups"]["plugin"]["keys"]


def of_qt(value):
    """What Qt has written."""
    assert value["type"] == "repr(QByteArray.hex)"
    return bytes.fromhex(re.fullmatch(r"QtCore\.QByteArray\(b'([0-9a-f]+)'\)", value["repr(QByteArray.hex)"])[1])


def rqt_curves():
    return [topic for number in plugins()["rqt_plot/Plot"]
            for topic in ast.literal_eval(settings_of("rqt_plot/Plot", number)["topics"]["repr"])]


def plotjuggler_curves():
    return [curve.get("name") for curve in LAYOUT.iter("curve")]


def foxglove_panels(kind):
    return {name: panel for name, panel in FOXGLOVE["configById"].items() if name.startswith(f"{kind}!")}


def foxglove_curves():
    """As rqt writes them: there the field begins with a dot."""
    return [path["value"].replace(".", "/") for panel in foxglove_panels("Plot").values() for path in panel["paths"]]


CURVES = [*rqt_curves(), *plotjuggler_curves(), *foxglove_curves()]


@pytest.mark.parametrize("curve", CURVES)
def test_curve_is_a_number_that_is_published(curve):
    node, topic, field = curve.strip("/").split("/")
    messages = {"monitor": topics_of_the_monitor(), "simulator": {"truth": "SimulationTruth"}}
    assert field in numeric_fields(messages[node][topic])


def test_all_that_is_in_view_comes_from_a_running_system(tmp_path, port):
    """The curves, and what else is looked at: /diagnostics, without an aggregator, tables, and the settings."""
    terminal = Terminal(tmp_path, port)
    fields = collections.defaultdict(set)
    for curve in CURVES:
        topic, _, field = curve.strip("/").rpartition("/")
        fields[topic].add(field)
    with terminal.start("roslaunch suspension_health_monitor paper.launch duration:=3600", "launch.txt") as launched:
        terminal.wait_for_master()
        terminal.wait_for_words("launch.txt", "/monitor: STALE", launched)
        for topic, its in fields.items():
            message = terminal.run(f"timeout 120 rostopic echo -n 1 /{topic}")
            assert its <= set(re.findall(r"^(\w+): \S", message, re.MULTILINE)), topic
        for table in foxglove_panels("Table").values():
            assert terminal.run(f"timeout 120 rostopic echo -n 1 {table['topicPath']}")
        for topic in {"/diagnostics", *(panel["topicToRender"] for panel in foxglove_panels("DiagnosticSummary").values())}:
            assert "monitor: Health" in terminal.run(f"timeout 120 rostopic echo -n 3 {topic}")
        assert "memory" in terminal.run("timeout 120 rosrun dynamic_reconfigure dynparam get /monitor")


def test_perspective_has_the_settings_of_every_running_plugin_and_no_others():
    running = {f"plugin__{plugin.replace('/', '__')}__{number}"
               for plugin, numbers in plugins().items() for number in numbers}
    assert running == set(PERSPECTIVE["groups"]["pluginmanager"]["groups"])
    assert set(plugins()) == set(WIDGETS)


@pytest.fixture
def rqt(monkeypatch):
    """A window of Qt as rqt has it once it has started the plugins: {plugin: its docks}, laid out by the perspective."""
    monkeypatch.setenv("QT_QPA_PLATFORM", "offscreen")
    widgets = pytest.importorskip("PyQt5.QtWidgets", reason="Qt is not installed (Debian: python3-pyqt5)")
    from PyQt5.QtCore import Qt
    application = widgets.QApplication([])
    window = widgets.QMainWindow()
    window.setDockNestingEnabled(True)
    docks = {}
    for plugin, numbers in plugins().items():
        docks[plugin] = [widgets.QDockWidget(window) for _ in numbers]
        for number, dock in zip(numbers, docks[plugin]):
            dock.setObjectName(f"{plugin.replace('/', '__')}__{number}__{WIDGETS[plugin]}")
            window.addDockWidget(Qt.BottomDockWidgetArea, dock)
    window.resize(1500, 950)
    assert window.restoreState(of_qt(PERSPECTIVE["groups"]["mainwindow"]["keys"]["state"]))
    window.show()
    application.processEvents()
    yield window, docks


def test_rqt_has_the_plots_one_above_the_other_and_beside_them_tabs(rqt):
    window, docks = rqt
    (monitor,), (settings,) = docks["rqt_runtime_monitor/RuntimeMonitor"], docks["rqt_reconfigure/Param"]
    plots = [dock.geometry() for dock in docks["rqt_plot/Plot"]]
    for upper, lower in zip(plots, plots[1:]):
        assert upper.bottom() < lower.top() and (upper.left(), upper.right()) == (lower.left(), lower.right())
        assert abs(upper.height() - lower.height()) <= 2
    assert window.tabifiedDockWidgets(monitor) == [settings]
    assert not monitor.visibleRegion().isEmpty() and settings.visibleRegion().isEmpty(), "the monitor is in front"
    assert plots[0].right() < monitor.geometry().left() and monitor.width() < plots[0].width()
    assert monitor.height() > plots[0].height() + plots[1].height()


def test_every_value_of_the_perspective_can_be_read_back():
    def check(group):
        assert set(group) == {"groups", "keys"}
        for value in group["keys"].values():
            if value["type"] == "repr":
                ast.literal_eval(value["repr"])
            else:
                assert of_qt(value)
        for child in group["groups"].values():
            check(child)
    check(PERSPECTIVE)


def test_plotjuggler_splitters_have_as_many_sizes_and_plots_as_they_say():
    splitters = list(LAYOUT.iter("DockSplitter"))
    assert splitters
    for splitter in splitters:
        count = int(splitter.get("count"))
        sizes = [float(size) for size in splitter.get("sizes").split(";")]
        assert len(sizes) == count == len(splitter.findall("DockArea/plot"))
        assert sum(sizes) == pytest.approx(1.0, abs=1e-4)


def panels_of(layout):
    return [layout] if isinstance(layout, str) else [*panels_of(layout["first"]), *panels_of(layout["second"])]


def test_foxglove_shows_every_panel_once():
    shown = panels_of(FOXGLOVE["layout"])
    assert sorted(shown) == sorted(FOXGLOVE["configById"])
    assert {name.partition("!")[0] for name in shown} == {"Plot", "DiagnosticSummary", "Table"}
    assert all(plot["legendDisplay"] == "left" for plot in foxglove_panels("Plot").values()), "beside the curves"
