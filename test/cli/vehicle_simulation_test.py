"""simulate --vehicle-model: topics, vehicle file, and refusals."""
import numpy as np
import pytest
import rosbag
import yaml

TRICYCLE = """
mass: 100
pitch_inertia: 20
roll_inertia: 10
iso_class: B
speed: 3
struts:
  front: {x: 0.8, y: 0, damping: 150, stiffness: 5000, wheel_mass: 3, tyre_stiffness: 30000}
  left: {x: -0.4, y: 0.5, damping: 150, stiffness: 5000, wheel_mass: 3, tyre_stiffness: 30000,
         effects: {quadratic_damping: {coefficient: 2}}}
  right: {x: -0.4, y: -0.5, damping: 150, stiffness: 5000, wheel_mass: 3, tyre_stiffness: 30000}
body_imu: {x: 0.1, y: 0.2, z: 0.3, yaw: 1.5707963267948966}
known_forces:
  tow_bar: {x: -0.6, rms: 50}
"""
SHORT = ["--duration", "5", "--rate", "50"]


def series(bag, topic, value):
    return np.array([value(message) for _, message, _ in rosbag.Bag(str(bag)).read_messages(topics=[topic])])


def vertical(message):
    return message.linear_acceleration.z


def test_named_vehicle_has_its_topics_and_its_file(program, tmp_path):
    bag, path = tmp_path / "drive.bag", tmp_path / "vehicle.yaml"
    told = program.succeed("simulate", "--vehicle-model", "sedan", *SHORT, "-o", bag, "--vehicle-file", path,
                           "--effect", "rear_left/bump_stop=40,g=0.01")
    assert "sedan, 5 s at 50 Hz, class C at 15 m/s, coherent tracks, seed 1" in told
    assert max(map(len, told.splitlines()[1:])) <= 120
    vehicle = yaml.safe_load(path.read_text())
    assert set(vehicle["struts"]) == {"front_left", "front_right", "rear_left", "rear_right"}
    topics = rosbag.Bag(str(bag)).get_type_and_topic_info().topics
    named = {topic for strut in vehicle["struts"].values() for topic in (strut["sprung_imu"], strut["unsprung_imu"])}
    assert named | {vehicle["body_imu"]} == {name for name, info in topics.items() if info.msg_type == "sensor_msgs/Imu"}
    assert all(topics[name].message_count == 251 for name in named)
    for name in vehicle["struts"]:
        strut = vehicle["struts"][name]
        truth = series(bag, f"/simulator/{name}/truth", lambda m: (m.sprung_acceleration, m.unsprung_acceleration))
        for column, side in enumerate(("sprung_imu", "unsprung_imu")):
            noise = series(bag, strut[side], vertical) - 9.81 - truth[:, column]
            assert 0.025 < noise.std() < 0.035 and abs(noise.mean()) < 0.01
    _, truth, _ = next(rosbag.Bag(str(bag)).read_messages(topics=["/simulator/rear_left/truth"]))
    assert (truth.effect_names, list(truth.effect_coefficients)) == (["bump_stop"], [40.0])
    row = next(line for line in told.splitlines() if line.startswith("rear_left")).split()
    assert float(row[1]) == pytest.approx(truth.damping_to_mass, rel=1e-3)
    assert float(row[2]) == pytest.approx(truth.stiffness_to_mass, rel=1e-3)


def test_coupling_and_forces_of_the_truth_move_the_strut_tops(program, tmp_path):
    bag = tmp_path / "drive.bag"
    program.succeed("simulate", "--vehicle-model", "ugv", *SHORT, "-o", bag,
                    "--set", "anti_roll_bars/front_left/front_right=300")
    truth = [message for _, message, _ in rosbag.Bag(str(bag)).read_messages(topics=["/simulator/truth"])]
    struts = truth[0].struts
    coupling = np.array(truth[0].coupling).reshape(4, 4)
    assert np.diag(coupling) == pytest.approx(1)
    tops = np.array([series(bag, f"/simulator/{name}/truth", lambda m: m.sprung_acceleration) for name in struts])
    forces = np.array([message.forces for message in truth]).T
    # z'' = A F with A = coupling diag(own): four numbers explain all samples.
    columns = np.concatenate([(coupling[:, [j]] * forces[j]).reshape(-1, 1) for j in range(4)], axis=1)
    own, residual, _, _ = np.linalg.lstsq(columns, tops.reshape(-1), rcond=None)
    assert residual[0] < 1e-12 * np.sum(tops ** 2) and np.all(own > 0)


def test_vehicle_of_a_file(program, tmp_path):
    model, bag, path = tmp_path / "tricycle.yaml", tmp_path / "drive.bag", tmp_path / "vehicle.yaml"
    model.write_text(TRICYCLE)
    program.succeed("simulate", "--vehicle-model", model, *SHORT, "-o", bag, "--vehicle-file", path,
                    "--set", "sprung_imus=front", "--set", "noise=0", "--set", "gyro_noise=0")
    vehicle = yaml.safe_load(path.read_text())
    assert [name for name, strut in vehicle["struts"].items() if "sprung_imu" in strut] == ["front"]
    # The IMU's x axis points to the left.
    assert vehicle["struts"]["left"]["position"] == pytest.approx([0.3, 0.5, -0.3])
    assert vehicle["known_forces"] == {"tow_bar": {"topic": "/tow_bar/wrench", "field": "force.z"}}
    known = series(bag, "/simulator/truth", lambda m: m.known_forces[0])
    assert series(bag, "/tow_bar/wrench", lambda m: m.wrench.force.z) == pytest.approx(known)
    assert 20 < known.std() < 80
    topics = rosbag.Bag(str(bag)).get_type_and_topic_info().topics
    assert "/front/sprung/imu" in topics and "/left/sprung/imu" not in topics
    rates = series(bag, "/simulator/truth", lambda m: (m.roll_rate, m.pitch_rate))
    gyro = series(bag, "/imu/data", lambda m: (m.angular_velocity.x, m.angular_velocity.y))
    assert gyro == pytest.approx(np.stack([rates[:, 1], -rates[:, 0]], axis=1), abs=1e-12)
    assert rates.std() > 1e-3


def test_a_folder_called_like_a_model_does_not_hide_the_model(program, tmp_path):
    (tmp_path / "ugv").mkdir()
    told = program("simulate", "--vehicle-model", "ugv", *SHORT, "-o", "drive.bag", cwd=tmp_path)
    assert (told.returncode, told.stderr) == (0, "") and told.stdout.startswith("drive.bag: ugv, ")


def test_same_seed_same_bag_another_another(program, tmp_path):
    for name, seed in (("a", 3), ("b", 3), ("c", 4)):
        program.succeed("simulate", "--vehicle-model", "half_sedan", *SHORT, "--seed", seed, "-o", tmp_path / name)
    contents = [series(tmp_path / name, "/rear/unsprung/imu", vertical) for name in "abc"]
    assert np.array_equal(contents[0], contents[1]) and not np.array_equal(contents[0], contents[2])


@pytest.mark.parametrize("arguments, words", [
    (["--vehicle-model", "tank"], ["tank", "sedan, ugv, truck, half_sedan", "YAML file"]),
    (["--vehicle-model", "none/such.yaml"], ["none/such.yaml", "YAML file"]),
    (["--vehicle-model", "sedan", "--scenario", "iso_road"], ["--scenario", "--vehicle-model"]),
    (["--vehicle-model", "sedan", "--vehicle", "ugv"], ["--vehicle", "--vehicle-model"]),
    (["--vehicle-file", "{folder}/vehicle.yaml"], ["--vehicle-file", "--vehicle-model"]),
    (["--vehicle-model", "sedan", "--vehicle-file", "{folder}/drive.bag"], ["--vehicle-file", "file of its own"]),
    (["--vehicle-model", "sedan", "--set", "tracks=same"], ["tracks", "same", "coherent, identical, independent"]),
    (["--vehicle-model", "sedan", "--set", "track=same"], ["track", "nearest", "tracks"]),
    (["--vehicle-model", "sedan", "--set", "sprung_imus=rear"], ["sprung_imus", "rear", "rear_left"]),
    (["--vehicle-model", "sedan", "--set", "struts/rear/damping=3"], ["rear", "front_left", "rear_right"]),
    (["--vehicle-model", "sedan", "--set", "struts/rear_left/damping=-3"], ["struts/rear_left: damping = -3", "in [0"]),
    (["--vehicle-model", "sedan", "--effect", "quadratic_damping=1"], ["quadratic_damping=1", "STRUT/NAME"]),
    (["--vehicle-model", "sedan", "--effect", "rear_left/fooo=1"], ["rear_left", "fooo", "bump_stop"]),
    (["--vehicle-model", "sedan", "--effect", "rear_left/quadratic_damping=-900"], ["quadratic_damping = -900", "unstable"]),
])
def test_wrong_use_is_refused(program, tmp_path, arguments, words):
    filled = [argument.format(folder=tmp_path) for argument in arguments]
    program.refuse(2, ["simulate", *filled, "--duration", "60", "-o", tmp_path / "drive.bag"], words, tmp_path)
